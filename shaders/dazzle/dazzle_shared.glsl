// What the three programs of the dazzle share. Layouts asserted in rendering/passes/dazzle_pass.cpp; the same
// arithmetic in C++ is rendering/reference/dazzle/dazzle_reference.cpp.
//
// Light is counted in quanta: whole multiples of 2^quantumExponent, of which `white` is exactly whiteQuanta <= 2^24.
// 64-bit integers are uvec2(low, high).

layout(std140, binding = 0) uniform DazzleBlock
{
    ivec2 imageSize;     // [pixel]
    ivec2 tileGrid;      // [tile] of 16 x 16 pixels
    uint whiteQuanta;    // [quantum]
    int quantumExponent;
    float quantum;       // 2^quantumExponent
    float white;
    float largest;       // values above are cut to this
    uint resetHistory;   // 1: adaptation starts from this frame
    double keepRise;     // [1] share of the old state that remains when glare grows
    double keepFall;     // [1] same when it fades
    double capacity;     // [quantum] pixels * whiteQuanta
    double perCapacity;  // its reciprocal
    vec4 sensorLaw;      // xyz: A, B, C
};

struct DazzleTile
{
    uvec2 overflow[3];   // [quantum] light above white in the tile
    uvec2 headroom[3];   // [quantum] room below white; the budget program turns it into the room of all tiles before
    uint replaced;       // channel values that were not finite, negative or too large
    uint unused;
};

struct DazzleBudget
{
    uvec2 share;         // quanta of glare per quantum of headroom, times 2^64
    uint saturated;      // 1: glare fills every pixel
    uint unused;
};

const uint kInfinity = 0x7F800000u;

// Bits of a value that is finite, not negative and at most `largest`.
uint sanitizedBits(uint bits, inout uint replaced)
{
    uint magnitude = bits & 0x7FFFFFFFu;
    bool isNan = magnitude > kInfinity;
    bool isNegative = bits > 0x80000000u;
    if (isNan || isNegative) {
        ++replaced;
        return 0u;
    }
    if (magnitude == kInfinity) {
        ++replaced;
        return floatBitsToUint(min(65504.0, largest));
    }
    if (magnitude > floatBitsToUint(largest)) {
        ++replaced;
        return floatBitsToUint(largest);
    }
    return bits;
}

// Whole quanta in a sanitized value.
uvec2 quantaOf(uint bits)
{
    int exponent = int((bits >> 23) & 0xFFu);
    uint mantissa = (bits & 0x7FFFFFu) | (exponent > 0 ? 0x800000u : 0u);
    int shift = max(exponent, 1) - 150 - quantumExponent;
    if (shift <= -24)
        return uvec2(0u);
    if (shift <= 0)
        return uvec2(mantissa >> uint(-shift), 0u);
    return uvec2(mantissa << uint(shift), mantissa >> uint(32 - shift)); // shift <= 31, see `largest`
}

uvec2 add64(uvec2 a, uvec2 b)
{
    uint carry;
    uint low = uaddCarry(a.x, b.x, carry);
    return uvec2(low, a.y + b.y + carry);
}

uvec2 subtract64(uvec2 a, uvec2 b)
{
    uint borrow;
    uint low = usubBorrow(a.x, b.x, borrow);
    return uvec2(low, a.y - b.y - borrow);
}

bool less64(uvec2 a, uvec2 b)
{
    return a.y < b.y || (a.y == b.y && a.x < b.x);
}

// [quantum] above white.
uvec2 overflowOf(uvec2 quanta)
{
    return less64(quanta, uvec2(whiteQuanta, 0u)) ? uvec2(0u) : subtract64(quanta, uvec2(whiteQuanta, 0u));
}

// [quantum] below white.
uint headroomOf(uvec2 quanta)
{
    return less64(quanta, uvec2(whiteQuanta, 0u)) ? whiteQuanta - quanta.x : 0u;
}
