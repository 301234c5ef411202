#include "formulas/lump_noise.fx.h"
#include "formulas/soil_texture.fx.h"
#include "formulas/wooded_horizon.fx.h"
#include "stage/stage_block.glsl"

// What is seen where there is no mesh.
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 color;

// Distant hills and trees in front of them, both down to the ground.
vec3 withHills(vec3 sky, vec3 d)
{
    float level = max(length(d.xz), 1e-6);
    vec2 along = d.xz / level;
    float elevation = d.y / level;
    float p = nearTrees.w;
    vec3 behind = mix(sky, farHills.rgb, fxShareBelow(fxFarHills(along.x, along.y, p), elevation, p));
    return mix(behind, nearTrees.rgb, fxShareBelow(fxNearTrees(along.x, along.y, p), elevation, p));
}

void main()
{
    vec2 size = vec2(rayDirectionX.w, rayDirectionY.w);
    vec2 uv = gl_FragCoord.xy / size;
    vec2 ndc = uv * 2.0 - 1.0;
    vec3 d = normalize(rayDirection.xyz + ndc.x * rayDirectionX.xyz + ndc.y * rayDirectionY.xyz);
    if (meshOffset.w < 0.5) {
        vec3 sky = mix(background.rgb, horizon.rgb, pow(1.0 - max(d.y, 0.0), 4.0));
        color = vec4(farHills.w > 0.5 ? withHills(sky, d) : sky, 1.0);
    } else if (meshOffset.w < 1.5) {
        color = vec4(texture(picture, uv).rgb * background.w, 1.0);
    } else {
        vec2 angle = vec2(atan(d.x, -d.z) * 0.159154943 + 0.5, asin(clamp(d.y, -1.0, 1.0)) * 0.318309886 + 0.5);
        color = vec4(textureLod(picture, angle, 0.0).rgb * background.w, 1.0);
    }
}
