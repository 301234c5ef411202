// A stable sort of (key, row) by four bits of the key at a time, least first, for orders of many particles: after eight passes all
// keys rise and equal keys keep their rows' order. Three dispatches a pass.
//
// FX_STAGE 0: how many pairs of a block have each digit; 1: from where on they go, one group for all blocks; 2: there they go.
layout(local_size_x = 256) in;

layout(std430, binding = 0) readonly buffer PairsBefore { uvec2 pairsBefore[]; }; // key, row
layout(std430, binding = 1) writeonly buffer PairsAfter { uvec2 pairsAfter[]; };
layout(std430, binding = 2) buffer DigitCounts { uint counts[]; }; // digit by digit, block by block
layout(std140, binding = 0) uniform Radix
{
    uvec4 sizes; // x blocks; y place of the digit's lowest bit
};

const uint kThreads = 256u;
const uint kOwn = 4u;       // pairs of a thread, which follow each other
const uint kBlock = 1024u;  // pairs of a group
const uint kDigits = 16u;

uint digitOf(uint key) { return (key >> sizes.y) & (kDigits - 1u); }

#if FX_STAGE == 1

shared uint sums[kThreads];

// Turns all counts into sums of those before them.
void main()
{
    uint i = gl_LocalInvocationIndex;
    uint all = kDigits * sizes.x;
    uint own = (all + kThreads - 1u) / kThreads;
    uint begin = min(i * own, all);
    uint end = min(begin + own, all);
    uint sum = 0u;
    for (uint k = begin; k < end; ++k)
        sum += counts[k];
    sums[i] = sum;
    for (uint apart = 1u; apart < kThreads; apart <<= 1) {
        memoryBarrierShared();
        barrier();
        uint before = i >= apart ? sums[i - apart] : 0u;
        memoryBarrierShared();
        barrier();
        sums[i] += before;
    }
    uint at = sums[i] - sum;
    for (uint k = begin; k < end; ++k) {
        uint count = counts[k];
        counts[k] = at;
        at += count;
    }
}

#else

shared uint places[kDigits * kThreads]; // how many pairs of each thread have a digit; digit by digit
shared uint lineSums[kThreads];         // of sixteen of them

// How many of a thread's pairs have each digit, eight bits each.
uvec4 countOwn(uint first)
{
    uvec4 folded = uvec4(0u);
    for (uint k = 0u; k < kOwn; ++k) {
        uint digit = digitOf(pairsBefore[first + k].x);
        folded[digit >> 2] += 1u << ((digit & 3u) * 8u);
    }
    return folded;
}

void main()
{
    uint i = gl_LocalInvocationIndex;
    uint block = gl_WorkGroupID.x;
    uint first = block * kBlock + i * kOwn;
    uvec4 folded = countOwn(first);
    for (uint digit = 0u; digit < kDigits; ++digit)
        places[digit * kThreads + i] = (folded[digit >> 2] >> ((digit & 3u) * 8u)) & 255u;
    memoryBarrierShared();
    barrier();
    // Each digit's counts are summed by sixteen threads that each take sixteen threads' counts.
    uint line = i * kDigits;
    uint sum = 0u;
    for (uint k = 0u; k < kDigits; ++k) {
        uint count = places[line + k];
        places[line + k] = sum; // of those before it in its line
        sum += count;
    }
    lineSums[i] = sum;
    memoryBarrierShared();
    barrier();
    uint before = 0u; // of the lines before it that have the same digit
    for (uint k = i & ~(kDigits - 1u); k < i; ++k)
        before += lineSums[k];
#if FX_STAGE == 0
    if ((i & (kDigits - 1u)) == kDigits - 1u)
        counts[(i / kDigits) * sizes.x + block] = before + sum;
#else
    memoryBarrierShared();
    barrier();
    for (uint k = 0u; k < kDigits; ++k)
        places[line + k] += before;
    memoryBarrierShared();
    barrier();
    for (uint k = 0u; k < kOwn; ++k) {
        uvec2 pair = pairsBefore[first + k];
        uint digit = digitOf(pair.x);
        uint place = places[digit * kThreads + i]++; // unique to this thread
        pairsAfter[counts[digit * sizes.x + block] + place] = pair;
    }
#endif
}

#endif
