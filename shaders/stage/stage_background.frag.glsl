#include "stage/stage_block.glsl"
#include "stage/stage_sky.glsl"

// What is seen where there is no mesh.
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) out vec4 color;

void main()
{
    vec2 size = vec2(rayDirectionX.w, rayDirectionY.w);
    vec2 uv = gl_FragCoord.xy / size;
    vec2 ndc = uv * 2.0 - 1.0;
    vec3 d = normalize(rayDirection.xyz + ndc.x * rayDirectionX.xyz + ndc.y * rayDirectionY.xyz);
    if (meshOffset.w < 0.5) {
        color = vec4(skyAt(d, nearTrees.w), 1.0);
    } else if (meshOffset.w < 1.5) {
        color = vec4(texture(picture, uv).rgb * background.w, 1.0);
    } else {
        vec2 angle = vec2(atan(d.x, -d.z) * 0.159154943 + 0.5, asin(clamp(d.y, -1.0, 1.0)) * 0.318309886 + 0.5);
        color = vec4(textureLod(picture, angle, 0.0).rgb * background.w, 1.0);
    }
}
