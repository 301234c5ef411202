#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_texture.glsl"
#include "shared/particle_place.glsl"
#include "shared/particle_light.glsl"
#include "shared/particle_output.glsl"

in vec3 fragmentPlace;
in vec3 fragmentNormal;
in vec2 fragmentTexture;
flat in vec4 fragmentColor;
flat in vec4 fragmentBall;
flat in float fragmentFrame;

void main()
{
    vec4 texel = vec4(1.0);
    if (atlas.w > 0.5)
        texel = frameTexel(fragmentTexture, fragmentFrame);
    vec3 normal = normalize(fragmentNormal);
    if (dot(normal, lookAt(fragmentPlace)) > 0.0)
        normal = -normal; // both sides are matt
    vec3 white = vec3(shine.x);
    if (shine.y > 0.0)
        white += shine.y * scatteredBySurface(fragmentBall, fragmentPlace, normal);
    writeParticle(fragmentColor.rgb * texel.rgb * white, fragmentColor.a * texel.a, fragmentPlace);
}
