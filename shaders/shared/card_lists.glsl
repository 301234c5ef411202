// A fragment of a card, to the list of its texel instead of to a target. Needs shared/view_block.glsl.
#include "shared/card_nodes.glsl"
#ifdef FX_MARKS
#include "shared/output_marks.glsl"
layout(std430, binding = 7) writeonly buffer CardMarks { CardMark cardMarks[]; };
#endif
layout(location = 0) out vec4 cardFragments; // of each texel, added up

// @param light of the card, not premultiplied [exposed]
// @param cover opacity, or 0 where it only adds; alpha then says how much of the light
void addCard(vec3 light, float alpha, float cover, float distanceAlong, float thickness, float layer)
{
    cardFragments = vec4(1.0, 0.0, 0.0, 0.0);
    uint node = atomicAdd(cardCount, 1u);
    if (node >= uint(cardNodes.length()))
        return;
    float depth = -log(1.0 - min(cover, 0.999));
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 size = ivec2(rayDirectionX.w, rayDirectionY.w);
    cardHeads[cardTileAt(texel, size)] = 1u;
    uint next = atomicExchange(cardHeads[cardHeadAt(texel, size)], node + 1u);
    cardNodes[node].light = vec4(light * (cover > 0.0 ? depth : alpha), layer);
    cardNodes[node].body = vec4(distanceAlong, depth, thickness, uintBitsToFloat(next));
#ifdef FX_MARKS
    cardMarks[node] = CardMark(vec4(fragmentVelocity, alpha), markInstance);
#endif
}
