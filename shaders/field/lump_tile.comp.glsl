#include "formulas/lump_noise.fx.h"

// The periodic cube of lumps, once for each context: the same numbers as rendering/field_detail/lump_tile.cpp.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(r32f, binding = 0) uniform writeonly image3D tile;

const int kCells = 8; // along a side
const float kMean = 0.54464, kDeviation = 0.13360;

// 0..1 for a cell or corner of the lattice. purpose 1: azimuth, 2: height of a gradient, 7 to 9: place of a feature point
float latticeNumber(ivec3 cell, uint purpose)
{
    uvec3 c = uvec3(cell + kCells) % uint(kCells);
    uint h = c.x * 0x8DA6B343u ^ c.y * 0xD8163841u ^ c.z * 0xCB1AB31Fu ^ purpose * 0x9E3779B9u;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    return float((h ^ h >> 15) >> 8) * exp2(-24.0);
}

vec3 fade(vec3 t)
{
    t = abs(t);
    return 1.0 - t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

float gradientNoise(ivec3 cell, vec3 p)
{
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        ivec3 corner = cell + ivec3(k & 1, k >> 1 & 1, k >> 2);
        vec3 d = p - vec3(corner);
        float azimuth = 6.2831853 * latticeNumber(corner, 1u);
        float height = 2.0 * latticeNumber(corner, 2u) - 1.0;
        float flatPart = sqrt(max(1.0 - height * height, 0.0));
        vec3 weight = fade(d);
        sum += weight.x * weight.y * weight.z * dot(d, vec3(flatPart * cos(azimuth), flatPart * sin(azimuth), height));
    }
    return sum;
}

float nearestFeature(ivec3 cell, vec3 p)
{
    float least = 9.0;
    for (int k = 0; k < 27; ++k) {
        ivec3 other = cell + ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        vec3 d = vec3(other) + vec3(latticeNumber(other, 7u), latticeNumber(other, 8u), latticeNumber(other, 9u)) - p;
        least = min(least, dot(d, d));
    }
    return least;
}

void main()
{
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    vec3 p = vec3(texel) * (float(kCells) / float(imageSize(tile).x));
    ivec3 cell = ivec3(floor(p));
    float lump = fxLump(nearestFeature(cell, p), gradientNoise(cell, p));
    imageStore(tile, texel, vec4((lump - kMean) / kDeviation));
}
