#include "shared/card_nodes.glsl"
#include "slabs/slab_balls.glsl"
#include "field/field_blocks.glsl"

// Lists of balls, one for each tile of 16 x 16 texels, in the order of the balls; and the tiles that have a ball, a card or a
// field, as a draw of one square each. Where a tile has more balls than its list may have, those with the lowest ranks are listed and
// stand for all of them: ranks are even, and stay with the balls, so that the choice hardly changes from frame to frame. A workgroup is a tile. Layouts are those of rendering/compositions/slabs/slab_passes.h.
layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform TileBlock
{
    ivec4 counts; // x balls; y tiles side by side; z most balls of a tile; w 1 when there are cards
    vec4 window;  // xy size [texel]; z flip of window y against clip y; w 1 when there are fields
};
layout(std430, binding = 3) readonly buffer FieldTiles { FieldTile fieldTiles[]; };
layout(std430, binding = 1) readonly buffer TileRects { uint rects[]; }; // three a ball: first and last column in halves, rows likewise, rank
layout(std430, binding = 2) buffer SlabTiles
{
    uint drawVertices, drawTiles, drawReserved[2]; // arguments of the draw
    uint listed, spilled, slabReserved[2];         // entries of all lists, and balls that are not in them
    uvec4 tiles[];                                 // x number of the tile; y first entry of its list; z entries; w balls an entry (float)
};
layout(r32ui, binding = 0) uniform writeonly uimage2D lists; // numbers of balls

shared uint total, chosen, most, first, entries, met[2];

bool meets(int ball, uvec2 tile)
{
    if (ball >= counts.x)
        return false;
    uvec2 rect = uvec2(rects[3 * ball], rects[3 * ball + 1]);
    uvec2 low = rect & 0xFFFFu;
    uvec2 high = rect >> 16;
    return all(lessThanEqual(low, tile)) && all(lessThanEqual(tile, high));
}

bool isChosen(int ball, uvec2 tile)
{
    return meets(ball, tile) && rects[3 * ball + 2] <= most;
}

// The largest rank of the balls that are listed. As ranks are as good as random, there is room for some more than are meant.
uint mostRank()
{
    float room = float(counts.z);
    float share = max(room - 4.0 * sqrt(room), 0.5 * room) / float(max(total, 1u));
    return total <= uint(counts.z) ? 0xFFFFFFFFu : uint(share * 4.29496e9); // of 2^32
}

bool hasFields(uvec2 tile)
{
    vec2 low = vec2(16u * tile) / window.xy * 2.0 - 1.0;
    vec2 high = min(vec2(16u * tile + 16u) / window.xy, vec2(1.0)) * 2.0 - 1.0;
    vec2 rows = window.z * vec2(low.y, high.y);
    low.y = min(rows.x, rows.y);
    high.y = max(rows.x, rows.y);
    ivec2 first = clamp(ivec2((0.5 + 0.5 * low) * vec2(kFieldTiles)), ivec2(0), kFieldTiles - 1);
    ivec2 last = clamp(ivec2((0.5 + 0.5 * high) * vec2(kFieldTiles)), ivec2(0), kFieldTiles - 1);
    uint sum = 0u;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x)
            sum += fieldTiles[y * kFieldTiles.x + x].count;
    return sum > 0u;
}

void main()
{
    int lane = int(gl_LocalInvocationIndex);
    uvec2 tile = gl_WorkGroupID.xy;
    uint number = tile.y * uint(counts.y) + tile.x;
    if (lane == 0)
        total = chosen = 0u;
    barrier();
    uint mine = 0u;
    for (int i = lane; i < counts.x; i += 64)
        mine += meets(i, tile) ? 1u : 0u;
    atomicAdd(total, mine);
    barrier();
    if (lane == 0)
        most = mostRank();
    barrier();
    mine = total > uint(counts.z) ? 0u : mine;
    for (int i = lane; i < (total > uint(counts.z) ? counts.x : 0); i += 64)
        mine += isChosen(i, tile) ? 1u : 0u;
    atomicAdd(chosen, mine);
    barrier();
    if (lane == 0) {
        entries = min(chosen, uint(counts.z));
        first = entries > 0u ? atomicAdd(listed, entries) : 0u;
        if (entries < total)
            atomicAdd(spilled, total - entries);
        bool isSeen = entries > 0u;
        if (counts.w > 0)
            isSeen = isSeen || cardHeads[number] != 0u;
        if (window.w > 0.5)
            isSeen = isSeen || hasFields(tile);
        if (isSeen)
            tiles[atomicAdd(drawTiles, 1u)] = uvec4(number, first, entries, floatBitsToUint(float(total) / float(max(entries, 1u))));
    }
    barrier();
    uint before = 0u;
    for (int batch = 0; batch < counts.x && before < entries; batch += 64) {
        if (lane < 2)
            met[lane] = 0u;
        barrier();
        bool isListed = isChosen(batch + lane, tile);
        if (isListed)
            atomicOr(met[lane >> 5], 1u << (lane & 31));
        barrier();
        uint place = before + uint(bitCount(met[lane >> 5] & ((1u << (lane & 31)) - 1u)));
        if (lane >= 32)
            place += uint(bitCount(met[0]));
        if (isListed && place < entries)
            imageStore(lists, listTexel(int(first + place)), uvec4(batch + lane));
        before += uint(bitCount(met[0]) + bitCount(met[1]));
        barrier();
    }
}
