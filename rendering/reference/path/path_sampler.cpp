#include "rendering/reference/path/path_sampler.h"

#include "foundation/random/philox.h"

namespace fx::render {

namespace {

constexpr uint32_t kStratifiedPairs = 64;
constexpr double kUnit = 0x1.0p-32;

uint32_t reversed(uint32_t x)
{
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00FF00FFu) << 8) | ((x & 0xFF00FF00u) >> 8);
    x = ((x & 0x0F0F0F0Fu) << 4) | ((x & 0xF0F0F0F0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xCCCCCCCCu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xAAAAAAAAu) >> 1);
}

/// Each bit depends on lower ones and the seed only.
uint32_t scrambledUpwards(uint32_t x, uint32_t seed)
{
    x ^= x * 0x3D20ADEAu;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526C56u;
    x ^= x * 0x53A22864u;
    return x;
}

uint32_t scrambled(uint32_t x, uint32_t seed) // (3)
{
    return reversed(scrambledUpwards(reversed(x), seed));
}

/// The second Sobol dimension of a number.
uint32_t sobolSecond(uint32_t number)
{
    uint32_t result = 0;
    for (uint32_t direction = 0x80000000u; number != 0; number >>= 1, direction ^= direction >> 1)
        if (number & 1u)
            result ^= direction;
    return result;
}

} // namespace

std::array<double, 2> PathSampler::pair()
{
    if (pairs_ >= kStratifiedPairs)
        return {number(), number()};
    const base::Random4 seeds = base::philox({pixel_, pairs_++, 0u, 1u}, seed_);
    const uint32_t order = scrambled(sample_, seeds[0]);     // (1)
    const uint32_t x = scrambled(reversed(order), seeds[1]); // (2)
    const uint32_t y = scrambled(sobolSecond(order), seeds[2]);
    return {x * kUnit, y * kUnit};
}

double PathSampler::number()
{
    if (left_ == 0) {
        words_ = base::philox({pixel_, sample_, numbers_++, 2u}, seed_);
        left_ = 4;
    }
    return words_[--left_] * kUnit;
}

} // namespace fx::render
