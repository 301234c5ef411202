// Fragments of cards that are to be summed up, in one list a texel. Bound as CardLists in rendering/passes/media_source.h.
struct CardNode
{
    vec4 light; // rgb its source times its optical depth, or what it adds [exposed]; w layer
    vec4 body;  // x distance along the ray [m]; y optical depth, 0: it only adds; z thickness [m]; w bits of the next node's
                // number, counted from 1, 0: none
};
layout(std430, binding = 4) buffer CardHeads
{
    uint cardCount;       // nodes that were asked for; more than there are: the rest is left out
    uint cardReserved[3];
    uint cardHeads[];     // 1 for each tile of 16 x 16 texels that has a card, row by row; then the first node of each texel
};
layout(std430, binding = 5) buffer CardNodes { CardNode cardNodes[]; };

ivec2 cardTiles(ivec2 size) { return (size + 15) / 16; }
int cardTileAt(ivec2 texel, ivec2 size)
{
    return texel.y / 16 * cardTiles(size).x + texel.x / 16;
}
int cardHeadAt(ivec2 texel, ivec2 size)
{
    ivec2 tiles = cardTiles(size);
    return tiles.x * tiles.y + texel.y * size.x + texel.x;
}
