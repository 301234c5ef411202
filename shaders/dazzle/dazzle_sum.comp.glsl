#include "dazzle/dazzle_shared.glsl"

// Exact sums of overflow and headroom over tiles of 16 x 16 pixels; each of the 64 threads takes 4 pixels of a row.
layout(local_size_x = 64) in;

layout(binding = 0) uniform sampler2D picture;
layout(std430, binding = 0) writeonly buffer TileBuffer
{
    DazzleTile tiles[];
};

shared uvec2 partial[6][64]; // overflow of red, green, blue; headroom of red, green, blue
shared uint replacedBy[64];

void addPixel(ivec2 at, inout uvec2 sums[6], inout uint replaced)
{
    uvec4 bits = floatBitsToUint(texelFetch(picture, at, 0));
    for (int channel = 0; channel < 3; ++channel) {
        uvec2 quanta = quantaOf(sanitizedBits(bits[channel], replaced));
        sums[channel] = add64(sums[channel], overflowOf(quanta));
        sums[3 + channel].x += headroomOf(quanta); // 4 pixels stay below 2^27
    }
}

void main()
{
    uint thread = gl_LocalInvocationIndex;
    ivec2 first = ivec2(gl_WorkGroupID.xy) * 16 + ivec2((thread & 3u) * 4u, thread >> 2);
    uvec2 sums[6] = uvec2[6](uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u), uvec2(0u));
    uint replaced = 0u;
    for (int x = 0; x < 4; ++x) {
        ivec2 at = first + ivec2(x, 0);
        if (all(lessThan(at, imageSize)))
            addPixel(at, sums, replaced);
    }
    for (int k = 0; k < 6; ++k)
        partial[k][thread] = sums[k];
    replacedBy[thread] = replaced;
    memoryBarrierShared();
    barrier();

    uint tile = gl_WorkGroupID.y * uint(tileGrid.x) + gl_WorkGroupID.x;
    if (thread < 6u) {
        uvec2 sum = uvec2(0u);
        for (int k = 0; k < 64; ++k)
            sum = add64(sum, partial[thread][k]);
        if (thread < 3u)
            tiles[tile].overflow[thread] = sum;
        else
            tiles[tile].headroom[thread - 3u] = sum;
    } else if (thread == 6u) {
        uint sum = 0u;
        for (int k = 0; k < 64; ++k)
            sum += replacedBy[k];
        tiles[tile].replaced = sum;
    }
}
