#include "formulas/kernel_optical_depth.fx.h"
#include "formulas/detail_noise.fx.h"
#include "formulas/heat_stream.fx.h"
#include "shared/view_block.glsl"
#include "shared/blob_chord.glsl"

// By how many pixels one hot blob displaces what lies far behind it; blobs are added up.
flat in vec4 blobCenterRadius;
flat in vec2 blobHeatSeed; // [K], [0, 1)

layout(location = 0) out vec4 heat;                  // xy [pixel], z weight [1], w weight * distance [m]

void main()
{
    BlobChord chord = chordOf(blobCenterRadius.xyz);
    vec3 direction = chord.direction;
    float radius = blobCenterRadius.w;
    float h = chord.h;
    float tc = chord.tc;
    float t0 = chord.t0;
    float whole = fxKernelOpticalDepth(radius * radius, radius, h, tc, tc - radius, tc + radius);
    float visible = fxKernelOpticalDepth(radius * radius, radius, h, tc, t0, chord.t1);
    if (!(visible > 0.0 && whole > 0.0))
        discard;

    vec3 horizontal = normalize(right.xyz - dot(right.xyz, direction) * direction);
    vec3 vertical = cross(horizontal, direction);
    vec2 p = vec2(dot(chord.across, horizontal), dot(chord.across, vertical)) / radius;
    float phase = pass.x;
    vec2 curl = vec2(fxHeatStreamY(p.x, p.y, phase, blobHeatSeed.y), -fxHeatStreamX(p.x, p.y, phase, blobHeatSeed.y));
    vec2 pixelsPerSlope = 0.5 * vec2(rayDirectionX.w * right.w, rayDirectionY.w * up.w * rayOriginY.w);
    float lever = rayOrigin.w > 0.5 ? radius : 1.0; // parallel rays have no slope: the scene stands one radius behind
    float share = visible / whole;

    float weight = share * fxHeatShare(blobHeatSeed.x) * fxHeatColumn(dot(p, p));
    vec2 offset = share * fxHeatRefraction(blobHeatSeed.x) * lever * pixelsPerSlope * curl;
    heat = vec4(offset, weight, weight * max(tc, t0));
}
