#include "dazzle/dazzle_shared.glsl"

// Deals the glare to pixels in proportion to their headroom. With c the headroom before a pixel in the order of tiles,
// threads and pixels, and g(c) = floor(c * share / 2^64), a pixel of headroom h gets g(c + h) - g(c): the increments
// telescope, so that their sum is the budget whatever the rounding does, and none exceeds h because share <= 2^64.
layout(local_size_x = 64) in;

layout(binding = 0) uniform sampler2D picture;
layout(binding = 0, rgba32f) uniform writeonly image2D dazzled;
layout(std430, binding = 0) readonly buffer TileBuffer
{
    DazzleTile tiles[];
};
layout(std430, binding = 1) readonly buffer BudgetBuffer
{
    DazzleBudget budgets[3];
};

shared uvec2 before[3][64]; // headroom of a thread's pixels, then of everything before them

// floor(a * b / 2^64)
uvec2 multiplyHigh(uvec2 a, uvec2 b)
{
    uint unusedLow;
    uint high00;
    uint high01;
    uint low01;
    uint high10;
    uint low10;
    uint high11;
    uint low11;
    umulExtended(a.x, b.x, high00, unusedLow);
    umulExtended(a.x, b.y, high01, low01);
    umulExtended(a.y, b.x, high10, low10);
    umulExtended(a.y, b.y, high11, low11);
    uint carry0;
    uint carry1;
    uint middle = uaddCarry(high00, low01, carry0);
    middle = uaddCarry(middle, low10, carry1);
    uvec2 result = add64(uvec2(low11, high11), uvec2(high01, 0u));
    result = add64(result, uvec2(high10, 0u));
    return add64(result, uvec2(carry0 + carry1, 0u));
}

uvec2 dealtBefore(uvec2 headroom, uint channel)
{
    return budgets[channel].saturated == 1u ? headroom : multiplyHigh(headroom, budgets[channel].share);
}

// Output bits of one channel; `io` is the headroom before the pixel and moves on.
uint dealtBits(uint sanitized, uint channel, inout uvec2 io)
{
    uvec2 quanta = quantaOf(sanitized);
    uint headroom = headroomOf(quanta);
    if (headroom == 0u)
        return floatBitsToUint(white);
    uvec2 after = add64(io, uvec2(headroom, 0u));
    uint increment = dealtBefore(after, channel).x - dealtBefore(io, channel).x; // below 2^25: the low words suffice
    io = after;
    if (increment == 0u)
        return sanitized;
    return floatBitsToUint(float(quanta.x + increment) * quantum);
}

void main()
{
    uint thread = gl_LocalInvocationIndex;
    ivec2 first = ivec2(gl_WorkGroupID.xy) * 16 + ivec2((thread & 3u) * 4u, thread >> 2);
    uint tile = gl_WorkGroupID.y * uint(tileGrid.x) + gl_WorkGroupID.x;

    uvec4 bits[4];
    uint replaced = 0u;
    uvec3 headroom = uvec3(0u);
    for (int x = 0; x < 4; ++x) {
        ivec2 at = first + ivec2(x, 0);
        if (any(greaterThanEqual(at, imageSize)))
            continue;
        bits[x] = floatBitsToUint(texelFetch(picture, at, 0));
        for (int channel = 0; channel < 3; ++channel) {
            bits[x][channel] = sanitizedBits(bits[x][channel], replaced);
            headroom[channel] += headroomOf(quantaOf(bits[x][channel]));
        }
    }
    for (int channel = 0; channel < 3; ++channel)
        before[channel][thread] = uvec2(headroom[channel], 0u);
    memoryBarrierShared();
    barrier();

    if (thread < 3u) {
        uvec2 sum = tiles[tile].headroom[thread];
        for (int k = 0; k < 64; ++k) {
            uvec2 own = before[thread][k];
            before[thread][k] = sum;
            sum = add64(sum, own);
        }
    }
    memoryBarrierShared();
    barrier();

    uvec2 position[3] = uvec2[3](before[0][thread], before[1][thread], before[2][thread]);
    for (int x = 0; x < 4; ++x) {
        ivec2 at = first + ivec2(x, 0);
        if (any(greaterThanEqual(at, imageSize)))
            continue;
        for (int channel = 0; channel < 3; ++channel)
            bits[x][channel] = dealtBits(bits[x][channel], uint(channel), position[channel]);
        imageStore(dazzled, at, uintBitsToFloat(bits[x]));
    }
}
