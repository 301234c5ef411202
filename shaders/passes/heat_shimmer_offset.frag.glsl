#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/heat_stream.fx.h"
#include "shared/view_block.glsl"

// By how many pixels one hot blob displaces what lies far behind it; blobs are added up.
flat in vec4 blobCenterRadius;
flat in vec2 blobHeatSeed; // [K], [0, 1)

layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray, +inf for none
layout(location = 0) out vec4 heat;                  // xy [pixel], z weight [1], w weight * distance [m]

void main()
{
    vec3 origin;
    vec3 direction;
    float lengthPerDepth;
    viewRay(gl_FragCoord.xy, origin, direction, lengthPerDepth);
    float radius = blobCenterRadius.w;
    vec3 toCenter = blobCenterRadius.xyz - origin;
    float tc = dot(toCenter, direction);
    vec3 across = tc * direction - toCenter;
    float h = length(across);
    float whole = fxKernelOpticalDepth(radius * radius, radius, h, tc, tc - radius, tc + radius);
    float t0 = rayOriginX.w * lengthPerDepth;
    float t1 = texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r;
    float visible = fxKernelOpticalDepth(radius * radius, radius, h, tc, t0, t1);
    if (!(visible > 0.0 && whole > 0.0))
        discard;

    vec3 horizontal = normalize(right.xyz - dot(right.xyz, direction) * direction);
    vec3 vertical = cross(horizontal, direction);
    vec2 p = vec2(dot(across, horizontal), dot(across, vertical)) / radius;
    float phase = pass.x;
    vec2 curl = vec2(fxHeatStreamY(p.x, p.y, phase, blobHeatSeed.y), -fxHeatStreamX(p.x, p.y, phase, blobHeatSeed.y));
    vec2 pixelsPerSlope = 0.5 * vec2(rayDirectionX.w * right.w, rayDirectionY.w * up.w * rayOriginY.w);
    float lever = rayOrigin.w > 0.5 ? radius : 1.0; // parallel rays have no slope: the scene stands one radius behind
    float share = visible / whole;

    float weight = share * fxHeatShare(blobHeatSeed.x) * fxHeatColumn(dot(p, p));
    vec2 offset = share * fxHeatRefraction(blobHeatSeed.x) * lever * pixelsPerSlope * curl;
    heat = vec4(offset, weight, weight * max(tc, t0));
}
