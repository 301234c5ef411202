// The ray of a texel. Needs shared/view_block.glsl.
layout(binding = 0) uniform sampler2D sceneDistance; // [m] along the ray to the opaque surface, +inf for none

struct SlabRay
{
    vec3 origin;          // [m] relative to the eye
    vec3 direction;       // unit
    vec2 open;            // [m] where the visible ray begins and ends, of all depths
    float t0, t1;         // [m] the same, or of a range that is drawn alone its part
    vec2 drawn;           // [m] what lies between these is drawn, see isCut
    float lengthPerDepth; // [1] length along the ray over depth along the axis of the view
    uint cards;           // number of the first node of shared/card_nodes.glsl, counted from 1; 0: none
};

SlabRay slabRay()
{
    SlabRay ray;
    viewRay(gl_FragCoord.xy, ray.origin, ray.direction, ray.lengthPerDepth);
    ray.open = vec2(rayOriginX.w * ray.lengthPerDepth, texelFetch(sceneDistance, ivec2(gl_FragCoord.xy), 0).r);
    ray.drawn = clipOffset.zw * ray.lengthPerDepth;
    vec2 part = rayDirection.w > 0.5 ? drawnPart(ray.open, ray.lengthPerDepth) : ray.open;
    ray.t0 = part.x;
    ray.t1 = part.y;
    ray.cards = 0u;
    return ray;
}

// A frame that is drawn range by range of depth has the slabs of the whole ray in each range, and draws shares of them. So ranges
// put over each other are the whole picture.
bool isCut(SlabRay ray)
{
    return ray.drawn.x > ray.t0 || ray.drawn.y < ray.t1;
}
