// The light in the cells of illumination networks. Needs field/field_glow.glsl for the grids. In textures all grids lie above each other
// along z, in blocks that hold the widest of them, beside each other along x. NetworkBlock: xy size of a block [texel]; z number of grids.
//
// Moments of light and of sources: 3 blocks, one a color, each texel with the harmonics of bands 0 and 1.
// Medium: 2 blocks. rgb extinction without the forward peak [1/m]; rgb albedo without it, a factor of band 1 of what is left.

// Harmonics 1, y, z, x of a unit direction, as rendering/network/network_basis.h
vec4 networkHarmonics(vec3 d)
{
    return vec4(0.28209479177387814, 0.48860251190291992 * d.yzx);
}

const int kNetworkDirections = 26;
const int kNetworkColumns = 7; // blocks of rays beside each other along x; along y there are 4

// The step to the neighbor number i of 26.
ivec3 networkStep(int i)
{
    int n = i < 13 ? i : i + 1;
    return ivec3(n % 3, n / 3 % 3, n / 9) - 1;
}

// Where the light of a direction lies in its texture.
ivec3 networkRayCorner(int i, ivec2 block)
{
    return ivec3(block * ivec2(i % kNetworkColumns, i / kNetworkColumns), 0);
}
