#include "shared/card_nodes.glsl"

// Empties the lists of cards.
layout(local_size_x = 64) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i == 0u)
        cardCount = 0u;
    if (i < uint(cardHeads.length()))
        cardHeads[i] = 0u;
}
