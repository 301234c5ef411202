#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_texture.glsl"
#include "shared/particle_output.glsl"

in vec3 fragmentPlace;
in vec2 fragmentTexture;
in vec4 fragmentColor;

void main()
{
    vec4 texel = vec4(1.0);
    if (atlas.w > 0.5)
        texel = texture(frames, vec3(fragmentTexture, 0.0));
    float alpha = fragmentColor.a * texel.a;
    if (strip.w > 0.0) {
        float inward = clamp((1.0 - abs(2.0 * fragmentTexture.x - 1.0)) / strip.w, 0.0, 1.0);
        alpha *= inward * inward * (3.0 - 2.0 * inward);
    }
    writeParticle(fragmentColor.rgb * texel.rgb, alpha, fragmentPlace);
}
