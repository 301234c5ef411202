// The order in which computed particles are drawn: a bitonic sort of (key, row), which no two rows share, so that there is
// exactly one order. Keys as in rendering/draw_order/depth_keys.h; empty rows come last and are not drawn.
//
// FX_STAGE 0: keys, sorted within blocks of 1024; 1: one step over distances of 1024 and more; 2: all steps within blocks;
// 3: rows in order, and the arguments of the draw; 4: keys alone, for gpu_particle_radix.comp.glsl.
layout(local_size_x = 512) in;

layout(std430, binding = 0) readonly buffer ComputedRows { float rowValues[]; };
layout(std430, binding = 1) buffer Pairs { uvec2 pairs[]; }; // key, row
layout(std430, binding = 2) writeonly buffer DrawOrder { uint drawOrder[]; };
layout(std430, binding = 3) writeonly buffer DrawArguments { uint drawArguments[4]; };
layout(std140, binding = 0) uniform Order
{
    vec4 eye;       // [m] in the group's axes, or the unit vector along which distances are; w: 1 for the latter
    vec4 scale;     // x [1], y [m]: distance * x + y is sorted by; z: 1 to sort by age; w: 1 for the least first
    ivec4 columnAt; // places of x, y, z, radius in the rows
    ivec4 sizes;    // x place of the age; y rows; z pairs, a power of two; w vertices of an instance
    uvec4 span;     // x length of the sequences that are merged; y distance of what is compared
};

const uint kAbsent = 0xFFFFFFFFu;
const uint kBlock = 1024u;

shared uvec2 block[kBlock];

bool isBehind(uvec2 a, uvec2 b) { return a.x > b.x || (a.x == b.x && a.y > b.y); }

uint keyOf(uint row)
{
    int i = int(row);
    if (i >= sizes.y || !(rowValues[columnAt.w + i] > 0.0))
        return kAbsent;
    float value = rowValues[sizes.x + i];
    if (scale.z < 0.5) {
        precise vec3 p = vec3(rowValues[columnAt.x + i], rowValues[columnAt.y + i], rowValues[columnAt.z + i]);
        precise vec3 d = p - eye.xyz;
        precise float along = p.x * eye.x + p.y * eye.y + p.z * eye.z;
        precise float squared = d.x * d.x + d.y * d.y + d.z * d.z;
        float length1 = eye.w > 0.5 ? along : sqrt(squared);
        precise float far = length1 * scale.x + scale.y;
        value = far;
    }
    uint bits = floatBitsToUint(value);
    uint flip = scale.w > 0.5 ? 0u : kAbsent;
    uint key = bits ^ (uint(int(bits) >> 31) | 0x80000000u) ^ flip;
    return (bits & 0x7FFFFFFFu) > 0x7F800000u ? kAbsent : key;
}

// Both steps of a bitonic network: `at` is the lower of two places, `length1` that of the sequences that become one.
void order(inout uvec2 a, inout uvec2 b, uint at, uint length1)
{
    bool rises = (at & length1) == 0u;
    if (isBehind(a, b) == rises) {
        uvec2 other = a;
        a = b;
        b = other;
    }
}

// The lower of the two places that thread `i` compares.
uint lowerOf(uint i, uint apart) { return (i / apart) * apart * 2u + i % apart; }

void mergeBlock(uint first, uint length1, uint apart)
{
    uint i = gl_LocalInvocationIndex;
    for (; apart > 0u; apart >>= 1) {
        uint low = lowerOf(i, apart);
        order(block[low], block[low + apart], first + low, length1);
        memoryBarrierShared();
        barrier();
    }
}

void main()
{
    uint i = gl_LocalInvocationIndex;
    uint first = gl_WorkGroupID.x * kBlock;
#if FX_STAGE == 4
    for (uint k = first + i; k < first + kBlock; k += 512u)
        pairs[k] = uvec2(keyOf(k), k);
#elif FX_STAGE == 0 || FX_STAGE == 2
    for (uint k = i; k < kBlock; k += 512u)
#if FX_STAGE == 0
        block[k] = uvec2(keyOf(first + k), first + k);
#else
        block[k] = pairs[first + k];
#endif
    memoryBarrierShared();
    barrier();
#if FX_STAGE == 0
    for (uint length1 = 2u; length1 <= kBlock; length1 <<= 1)
        mergeBlock(first, length1, length1 >> 1);
#else
    mergeBlock(first, span.x, kBlock >> 1);
#endif
    for (uint k = i; k < kBlock; k += 512u)
        pairs[first + k] = block[k];
#elif FX_STAGE == 1
    uint low = lowerOf(gl_GlobalInvocationID.x, span.y);
    uvec2 a = pairs[low];
    uvec2 b = pairs[low + span.y];
    order(a, b, low, span.x);
    pairs[low] = a;
    pairs[low + span.y] = b;
#else
    for (uint k = first + i; k < first + kBlock; k += 512u) {
        uvec2 pair = pairs[k];
        if (int(k) < sizes.y)
            drawOrder[k] = pair.y;
        bool isLast = int(k) + 1 == sizes.z || pairs[k + 1u].x == kAbsent;
        if (pair.x != kAbsent && isLast)
            drawArguments[1] = k + 1u;
        if (k == 0u) {
            drawArguments[0] = uint(sizes.w);
            drawArguments[2] = 0u;
            drawArguments[3] = 0u;
            if (pair.x == kAbsent)
                drawArguments[1] = 0u;
        }
    }
#endif
}
