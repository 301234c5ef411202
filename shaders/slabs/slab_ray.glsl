// The ray of a texel. Needs shared/view_block.glsl.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none

struct SlabRay
{
    vec3 origin;          // [m] relative to the eye
    vec3 direction;       // unit
    float t0, t1;         // [m] where the part of the ray that is drawn begins and ends
    vec2 open;            // [m] where the visible ray begins and ends, of all depths
    float lengthPerDepth; // [1] length along the ray over depth along the axis of the view
    uint cards;           // number of the first node of shared/card_nodes.glsl, counted from 1; 0: none
};

SlabRay slabRay()
{
    SlabRay ray;
    viewRay(gl_FragCoord.xy, ray.origin, ray.direction, ray.lengthPerDepth);
    ray.open = vec2(rayOriginX.w * ray.lengthPerDepth, texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r);
    vec2 part = drawnPart(ray.open, ray.lengthPerDepth);
    ray.t0 = part.x;
    ray.t1 = part.y;
    ray.cards = 0u;
    return ray;
}
