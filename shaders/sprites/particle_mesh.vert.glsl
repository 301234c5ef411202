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
#ifdef FX_MARKS
out vec3 fragmentVelocity; // [m/s] relative to the world
#endif

// A vector of the mesh, turned as a particle is. The angle turns it about its own vertical.
vec3 spun(vec4 orientation, float angle, vec3 v)
{
    float c = cos(angle);
    float s = sin(angle);
    return rotated(orientation, mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c) * v);
}

void main()
{
    Particle p = fetchParticle(rowOfRank(rows.z + gl_InstanceID));
    vec2 levelFactors = factorsOfRank(rows.z + gl_InstanceID);
    p.radius *= levelFactors.x;
    int at = 8 * int(floatBitsToUint(meshWords[rows.w + gl_VertexID]));
    vec3 position = vec3(meshWords[at], meshWords[at + 1], meshWords[at + 2]);
    vec3 normal = vec3(meshWords[at + 3], meshWords[at + 4], meshWords[at + 5]);
    fragmentPlace = p.center + rotated(placeRotation, spun(p.orientation, p.angle, position)) * p.radius;
    fragmentNormal = rotated(placeRotation, spun(p.orientation, p.angle, normal));
    fragmentTexture = vec2(meshWords[at + 6], meshWords[at + 7]);
    fragmentColor = vec4(p.color.rgb, opacityOf(p.color.a, levelFactors));
    fragmentBall = vec4(p.center, p.radius);
    fragmentFrame = p.frame;
#ifdef FX_MARKS
    vec3 turn = spun(p.oriented[1], p.turned.y, position) - spun(p.oriented[0], p.turned.x, position);
    vec3 offset = spun(p.orientation, p.angle, position) * (p.radius / placePosition.w);
    fragmentVelocity = p.drift + driftAt(vec4(offset, 0.0)) +
                       rotated(placeRotation, turn) * (p.radius / max(moment.y, 1e-6));
#endif
    gl_Position = p.alive && levelFactors.x > 0.0 ? clipOf(fragmentPlace) : clippedAway();
}
