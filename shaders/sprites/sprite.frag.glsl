#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_texture.glsl"
#include "shared/particle_output.glsl"

in vec3 fragmentPlace;
in vec2 fragmentTexture;
flat in vec4 fragmentColor;
in vec3 fragmentScattered;
flat in float fragmentFrame;

void main()
{
    vec4 texel;
    if (atlas.w > 0.5) {
        texel = frameTexel(fragmentTexture, fragmentFrame);
    } else {
        vec2 fromCenter = 2.0 * fragmentTexture - 1.0;
        float inside = max(1.0 - dot(fromCenter, fromCenter), 0.0);
        texel = vec4(1.0, 1.0, 1.0, inside * inside);
    }
    writeParticle((fragmentColor.rgb + fragmentScattered) * texel.rgb, fragmentColor.a * texel.a, fragmentPlace);
}
