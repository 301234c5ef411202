#include "shared/card_nodes.glsl"
#include "slabs/slab_balls.glsl"
#include "field/field_blocks.glsl"

// Lists of balls, one for each tile of 16 x 16 texels, in the order of the balls; and the tiles that have a ball, a card or a
// field, as a draw of one square each. Where a tile has more balls than its list may have, those with the lowest ranks are listed and
// stand for all of them: ranks are uniform, and stay with the balls. The listed balls with the highest ranks have small weights, so that
// they leave and enter the list smoothly as the number of balls changes. A workgroup is a tile. Layouts are those of rendering/compositions/slabs/slab_passes.h.
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
    uvec4 tiles[];                                 // x number of the tile; y first entry of its list; z entries; w balls that a weight of 1 stands for (float)
};
layout(r32ui, binding = 0) uniform writeonly uimage2D lists; // see slab_balls.glsl

const float kFade = 0.2; // [1] share of the listed ranks over which weights fall from 1 to 0

shared uint total, chosen, weights, first, entries, met[2];
shared vec2 fade; // [1] ranks at which weights begin to fall, and at which they are 0

bool meets(int ball, uvec2 tile)
{
    if (ball >= counts.x)
        return false;
    uvec2 rect = uvec2(rects[3 * ball], rects[3 * ball + 1]);
    uvec2 low = rect & 0xFFFFu;
    uvec2 high = rect >> 16;
    return all(lessThanEqual(low, tile)) && all(lessThanEqual(tile, high));
}

// Weight of a ball in the list, in units of 1 / kWholeEntry; 0: it is not listed.
uint weightOf(int ball, uvec2 tile)
{
    float whole = float(kWholeEntry);
    float rank = meets(ball, tile) ? float(rects[3 * ball + 2]) / 4294967296.0 : 2.0; // of 2^32
    float weight = rank > 1.0 ? 0.0 : fade.x < 1.0 ? whole * (fade.y - rank) / (fade.y - fade.x) : whole;
    return uint(clamp(ceil(weight), 0.0, whole));
}

// As ranks are as good as random, there is room for some more than are meant.
vec2 ranksThatFade()
{
    float room = float(counts.z);
    float end = max(room - 4.0 * sqrt(room), 0.5 * room) / float(max(total, 1u));
    return vec2((1.0 - kFade) * end, end);
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
        total = chosen = weights = 0u;
    barrier();
    uint mine = 0u;
    for (int i = lane; i < counts.x; i += 64)
        mine += meets(i, tile) ? 1u : 0u;
    atomicAdd(total, mine);
    barrier();
    if (lane == 0)
        fade = ranksThatFade();
    barrier();
    bool isThinned = fade.x < 1.0;
    mine = isThinned ? 0u : mine;
    uint weight = kWholeEntry * mine;
    for (int i = lane; i < (isThinned ? counts.x : 0); i += 64) {
        uint own = weightOf(i, tile);
        mine += own > 0u ? 1u : 0u;
        weight += own;
    }
    atomicAdd(chosen, mine);
    atomicAdd(weights, weight);
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
            tiles[atomicAdd(drawTiles, 1u)] = uvec4(number, first, entries, floatBitsToUint(float(total) / max(float(weights) / float(kWholeEntry), 1e-6)));
    }
    barrier();
    uint before = 0u;
    for (int batch = 0; batch < counts.x && before < entries; batch += 64) {
        if (lane < 2)
            met[lane] = 0u;
        barrier();
        uint own = weightOf(batch + lane, tile);
        bool isListed = own > 0u;
        if (isListed)
            atomicOr(met[lane >> 5], 1u << (lane & 31));
        barrier();
        uint place = before + uint(bitCount(met[lane >> 5] & ((1u << (lane & 31)) - 1u)));
        if (lane >= 32)
            place += uint(bitCount(met[0]));
        if (isListed && place < entries)
            imageStore(lists, listTexel(int(first + place)), uvec4(listEntry(uint(batch + lane), own)));
        before += uint(bitCount(met[0]) + bitCount(met[1]));
        barrier();
    }
}
