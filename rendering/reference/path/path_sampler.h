/// @file path_sampler.h
/// The random numbers of one path: stratified over the samples of a pixel, and a pure function of pixel,
/// sample and dimension, so that neither order nor thread count can change a picture.
#pragma once

#include <array>
#include <cstdint>

namespace fx::render {

/// @formula owen-scrambled-sobol
/// Pairs of numbers in [0, 1) whose first 2^k samples are stratified in every elementary interval of area
/// 2^-k.
///
/// symbol   unit   meaning
///   s      1      number of the sample, in bits from the highest
///   h      1      hash of seed, pixel and dimension
///   x, y   1      the pair
/// @derivation
///   i = scramble(s, h): the order of samples differs between dimensions, or they would be correlated (1) x =
///   scramble(reverse(i)), y = scramble(i by Pascal's matrix modulo 2): the first two Sobol dimensions (2)
///   scramble: a hash whose bit k depends on bits above k only, which is a nested uniform permutation (3)
/// @source    [Bur20] Burley, "Practical hash-based Owen scrambling", JCGT 9(4), for (1) to (3)
/// @deviation dimensions beyond the first 64 pairs come from philox4x32-10 alone: paths so long gain nothing
/// by strata
/// @valid     up to 2^32 samples a pixel
/// @accuracy  32 bits; every pair is uniform over the seeds, so that means of paths are unbiased
/// @tests     tests/rendering/reference/path/test_path_sampler.cpp
class PathSampler
{
public:
    PathSampler(uint64_t seed, uint32_t pixel, uint32_t sample) : seed_(seed), pixel_(pixel), sample_(sample)
    {}

    std::array<double, 2> pair(); ///< each in [0, 1)
    /// In [0, 1), not stratified: for frequent decisions, such as those of null collisions.
    double number();

private:
    uint64_t seed_;
    uint32_t pixel_, sample_;
    uint32_t pairs_ = 0, numbers_ = 0;
    std::array<uint32_t, 4> words_{};
    uint32_t left_ = 0; ///< of `words_`
};

} // namespace fx::render
