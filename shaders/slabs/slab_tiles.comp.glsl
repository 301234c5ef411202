#include "shared/card_nodes.glsl"
#include "slabs/slab_balls.glsl"

// Lists of balls, one for each tile of 16 x 16 texels, in the order of the balls; and the tiles that have a ball or a card,
// as a draw of one square each. A workgroup is a tile. Layouts are those of rendering/compositions/slabs/slab_passes.h.
layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform TileBlock
{
    ivec4 counts; // x balls; y tiles side by side; z most balls of a tile; w 1 when there are cards
};
layout(std430, binding = 1) readonly buffer TileRects { uvec2 rects[]; }; // first and last tile, in halves: x columns, y rows
layout(std430, binding = 2) buffer SlabTiles
{
    uint drawVertices, drawTiles, drawReserved[2]; // arguments of the draw
    uint listed, spilled, slabReserved[2];         // entries of all lists, and what was left out
    uvec4 tiles[];                                 // x number of the tile; y first entry of its list; z entries
};
layout(r32ui, binding = 0) uniform writeonly uimage2D lists; // numbers of balls

shared uint total, first, entries, met[2];

bool meets(int ball, uvec2 tile)
{
    if (ball >= counts.x)
        return false;
    uvec2 rect = rects[ball];
    uvec2 low = rect & 0xFFFFu;
    uvec2 high = rect >> 16;
    return all(lessThanEqual(low, tile)) && all(lessThanEqual(tile, high));
}

void main()
{
    int lane = int(gl_LocalInvocationIndex);
    uvec2 tile = gl_WorkGroupID.xy;
    uint number = tile.y * uint(counts.y) + tile.x;
    if (lane == 0)
        total = 0u;
    barrier();
    uint mine = 0u;
    for (int i = lane; i < counts.x; i += 64)
        mine += meets(i, tile) ? 1u : 0u;
    atomicAdd(total, mine);
    barrier();
    if (lane == 0) {
        entries = min(total, uint(counts.z));
        first = entries > 0u ? atomicAdd(listed, entries) : 0u;
        if (entries < total)
            atomicAdd(spilled, total - entries);
        bool hasCards = counts.w > 0 && cardHeads[number] != 0u;
        if (entries > 0u || hasCards)
            tiles[atomicAdd(drawTiles, 1u)] = uvec4(number, first, entries, 0u);
    }
    barrier();
    uint before = 0u;
    for (int batch = 0; batch < counts.x && before < entries; batch += 64) {
        if (lane < 2)
            met[lane] = 0u;
        barrier();
        bool isMet = meets(batch + lane, tile);
        if (isMet)
            atomicOr(met[lane >> 5], 1u << (lane & 31));
        barrier();
        uint rank = before + uint(bitCount(met[lane >> 5] & ((1u << (lane & 31)) - 1u)));
        if (lane >= 32)
            rank += uint(bitCount(met[0]));
        if (isMet && rank < entries)
            imageStore(lists, listTexel(int(first + rank)), uvec4(batch + lane));
        before += uint(bitCount(met[0]) + bitCount(met[1]));
        barrier();
    }
}
