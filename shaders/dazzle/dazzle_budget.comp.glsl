#include "dazzle/dazzle_shared.glsl"

// One workgroup: totals of all tiles, temporal adaptation, sensor law, and from them how much glare each quantum of
// headroom receives. Three threads finish, one a channel.
layout(local_size_x = 256) in;

layout(std430, binding = 0) buffer TileBuffer
{
    DazzleTile tiles[];
};
layout(std430, binding = 1) buffer HistoryBuffer
{
    double adapted[3];   // [1] mean overflow per pixel in units of white that the sensor has adapted to
    double frameMean[3]; // [1] the same of the last frame alone
    uint valid;
    uint replacedValues;
};
layout(std430, binding = 2) writeonly buffer BudgetBuffer
{
    DazzleBudget budgets[3];
};

shared uvec3 overflowOfChunk[3][256]; // 96-bit integers, low word first
shared uvec2 headroomOfChunk[3][256];
shared uint replacedInChunk[256];

uvec3 add96(uvec3 a, uvec3 b)
{
    uint carry0;
    uint carry1;
    uint carry2;
    uint low = uaddCarry(a.x, b.x, carry0);
    uint middle = uaddCarry(a.y, b.y, carry1);
    middle = uaddCarry(middle, carry0, carry2);
    return uvec3(low, middle, a.z + b.z + carry1 + carry2);
}

const double kWord = 4294967296.0LF; // 2^32

double toDouble(uvec3 a)
{
    precise double high = double(a.z) * kWord + double(a.y);
    precise double all = high * kWord + double(a.x);
    return all;
}

// ceil(budget * 2^64 / headroom) for budget < headroom < 2^63.
uvec2 shareOf(uvec2 budget, uvec2 headroom)
{
    uvec2 remainder = budget;
    uvec2 share = uvec2(0u);
    for (int bit = 0; bit < 64; ++bit) {
        remainder = uvec2(remainder.x << 1, (remainder.y << 1) | (remainder.x >> 31));
        share = uvec2(share.x << 1, (share.y << 1) | (share.x >> 31));
        if (!less64(remainder, headroom)) {
            remainder = subtract64(remainder, headroom);
            share.x |= 1u;
        }
    }
    return remainder == uvec2(0u) ? share : add64(share, uvec2(1u, 0u));
}

// State of adaptation after this frame, whose mean overflow is `frame`.
double adapt(double state, double frame)
{
    double keep = frame > state ? keepRise : keepFall;
    bool usable = resetHistory == 0u && valid == 1u && state >= 0.0LF && state < 1e30LF;
    if (!usable || keep == 0.0LF)
        return frame;
    precise double next = frame + (state - frame) * keep;
    return next;
}

// Doubles by their bits: NVIDIA's compiler (580) rounds the elements of a constant array of doubles to float, and reads some
// decimal literals one unit in the last place off.
const uvec2 kPerLn2 = uvec2(0x652B82FEu, 0x3FF71547u);  // 1.4426950408889634
const uvec2 kLn2High = uvec2(0xFEE00000u, 0x3FE62E42u); // 6.93147180369123816490e-01
const uvec2 kLn2Low = uvec2(0x35793C76u, 0x3DEA39EFu);  // 1.90821492927058770002e-10
const uvec2 kOverFactorial[12] = uvec2[12](
    uvec2(0x13A86D09u, 0x3DE61246u),
    uvec2(0xEFF8D898u, 0x3E21EED8u),
    uvec2(0x67F544E4u, 0x3E5AE645u),
    uvec2(0xB7789F5Cu, 0x3E927E4Fu),
    uvec2(0xA556C734u, 0x3EC71DE3u),
    uvec2(0x1A01A01Au, 0x3EFA01A0u),
    uvec2(0x1A01A01Au, 0x3F2A01A0u),
    uvec2(0x16C16C17u, 0x3F56C16Cu),
    uvec2(0x11111111u, 0x3F811111u),
    uvec2(0x55555555u, 0x3FA55555u),
    uvec2(0x55555555u, 0x3FC55555u),
    uvec2(0x00000000u, 0x3FE00000u)); // 1 / 13!, ... 1 / 2!

// exp(-x) for x >= 0 from additions and multiplications, which every GPU rounds alike; explained, with the same text, in
// rendering/reference/dazzle/dazzle_reference.cpp.
double expOfMinus(double x)
{
    if (!(x < 700.0LF))
        return 0.0LF;
    precise double n = floor(x * packDouble2x32(kPerLn2) + 0.5LF);
    precise double r = (n * packDouble2x32(kLn2High) - x) + n * packDouble2x32(kLn2Low);
    precise double sum = 0.0LF;
    for (int k = 0; k < 12; ++k)
        sum = sum * r + packDouble2x32(kOverFactorial[k]);
    sum = (sum * r + 1.0LF) * r + 1.0LF;
    precise double scaled = sum * packDouble2x32(uvec2(0u, uint(1023 - int(n)) << 20));
    return scaled;
}

// Formula sensor-law (1): A + B exp(-C over)
double gainOf(double over)
{
    precise double gain = double(sensorLaw.x) + double(sensorLaw.y) * expOfMinus(double(sensorLaw.z) * over);
    return gain;
}

// [quantum] of glare that is wanted, cut to the headroom.
uvec2 budgetOf(double state, double frame, uvec3 overflow, uvec2 headroom)
{
    if (state == frame && sensorLaw.x == 1.0 && sensorLaw.y == 0.0) // the overflow itself, as an integer
        return overflow.z != 0u || less64(headroom, overflow.xy) ? headroom : overflow.xy;
    precise double wanted = floor(state * gainOf(state) * capacity);
    if (!(wanted < toDouble(uvec3(headroom, 0u))))
        return headroom;
    precise double high = floor(wanted / kWord);
    precise double low = wanted - high * kWord;
    return uvec2(uint(low), uint(high));
}

void finishChannel(uint channel)
{
    uvec3 overflow = uvec3(0u);
    uvec2 headroom = uvec2(0u);
    for (int k = 0; k < 256; ++k) {
        overflow = add96(overflow, overflowOfChunk[channel][k]);
        uvec2 own = headroomOfChunk[channel][k];
        headroomOfChunk[channel][k] = headroom; // of all chunks before
        headroom = add64(headroom, own);
    }
    precise double frame = toDouble(overflow) * perCapacity;
    double state = adapt(adapted[channel], frame);
    uvec2 budget = budgetOf(state, frame, overflow, headroom);
    bool saturated = budget == headroom;
    budgets[channel].share = saturated ? uvec2(0u) : shareOf(budget, headroom);
    budgets[channel].saturated = saturated ? 1u : 0u;
    adapted[channel] = state;
    frameMean[channel] = frame;
}

void main()
{
    uint thread = gl_LocalInvocationIndex;
    uint count = uint(tileGrid.x * tileGrid.y);
    uint chunk = (count + 255u) / 256u;
    uint first = min(thread * chunk, count);
    uint last = min(first + chunk, count);

    uint replaced = 0u;
    for (uint channel = 0u; channel < 3u; ++channel) {
        uvec3 overflow = uvec3(0u);
        uvec2 headroom = uvec2(0u);
        for (uint tile = first; tile < last; ++tile) {
            overflow = add96(overflow, uvec3(tiles[tile].overflow[channel], 0u));
            headroom = add64(headroom, tiles[tile].headroom[channel]);
        }
        overflowOfChunk[channel][thread] = overflow;
        headroomOfChunk[channel][thread] = headroom;
    }
    for (uint tile = first; tile < last; ++tile)
        replaced += tiles[tile].replaced;
    replacedInChunk[thread] = replaced;
    memoryBarrierShared();
    barrier();

    if (thread < 3u)
        finishChannel(thread);
    memoryBarrierShared();
    barrier();

    if (thread == 0u) {
        uint sum = 0u;
        for (int k = 0; k < 256; ++k)
            sum += replacedInChunk[k];
        replacedValues = sum;
        valid = 1u;
    }
    for (uint channel = 0u; channel < 3u; ++channel) {
        uvec2 before = headroomOfChunk[channel][thread];
        for (uint tile = first; tile < last; ++tile) {
            uvec2 own = tiles[tile].headroom[channel];
            tiles[tile].headroom[channel] = before;
            before = add64(before, own);
        }
    }
}
