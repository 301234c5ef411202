#include "shared/particle_block.glsl"
#include "shared/view_block.glsl"
#include "shared/particle_fetch.glsl"
#include "shared/particle_place.glsl"

// One mesh a particle, as large as its radius.
layout(std430, binding = 3) readonly buffer MeshWords { float meshWords[]; }; // 8 a vertex, then the indices

out vec3 fragmentPlace;
out vec3 fragmentNormal;
out vec2 fragmentTexture;
flat out vec4 fragmentColor;
flat out vec4 fragmentBall; // xyz center; w radius [m] of the ball that stands for it in light
flat out float fragmentFrame;

void main()
{
    Particle p = fetchParticle(rowOfRank(rows.z + gl_InstanceID));
    vec2 levelFactors = factorsOfRank(rows.z + gl_InstanceID);
    p.radius *= levelFactors.x;
    int at = 8 * int(floatBitsToUint(meshWords[rows.w + gl_VertexID]));
    vec3 position = vec3(meshWords[at], meshWords[at + 1], meshWords[at + 2]);
    vec3 normal = vec3(meshWords[at + 3], meshWords[at + 4], meshWords[at + 5]);
    float c = cos(p.angle);
    float s = sin(p.angle);
    mat3 spin = mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c); // the angle turns it about its own vertical
    vec3 turned = rotated(p.orientation, spin * position);
    fragmentPlace = p.center + rotated(placeRotation, turned) * p.radius;
    fragmentNormal = rotated(placeRotation, rotated(p.orientation, spin * normal));
    fragmentTexture = vec2(meshWords[at + 6], meshWords[at + 7]);
    fragmentColor = vec4(p.color.rgb, opacityOf(p.color.a, levelFactors));
    fragmentBall = vec4(p.center, p.radius);
    fragmentFrame = p.frame;
    gl_Position = p.alive && levelFactors.x > 0.0 ? clipOf(fragmentPlace) : clippedAway();
}
