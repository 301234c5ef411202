/// @file path_sampler.h
/// The random numbers of one path. The numbers are stratified over the samples of a pixel, and are a pure
/// function of pixel, sample and dimension. Therefore a picture does not depend on the order of paths or the
/// number of threads.
#pragma once

#include <array>
#include <cstdint>

namespace fx::render {

/// @formula owen-scrambled-sobol
/// Pairs of numbers in [0, 1) whose first 2^k samples are stratified in every elementary interval of area
/// 2^-k.
///
/// symbol   unit   meaning
///   s      1      number of the sample, with the highest bit first
///   h      1      hash of seed, pixel and dimension
///   x, y   1      the pair
/// @derivation
///   i = scramble(s, h): another order of samples in each dimension, so that they are not correlated  (1)
///   x = scramble(reverse(i)), y = scramble(Pascal's matrix times i, modulo 2): the first two Sobol
///   dimensions                                                                                       (2)
///   scramble is a hash whose bit k depends only on bits above k: a nested uniform permutation         (3)
/// @source    [Bur20] Burley, "Practical hash-based Owen scrambling", JCGT 9(4), for (1) to (3)
/// @deviation dimensions after the first 64 pairs are philox4x32-10 numbers, because such long paths do not
///            benefit from stratification
/// @valid     up to 2^32 samples per pixel
/// @accuracy  32 bits; over all seeds, pairs are uniformly distributed, so that means are unbiased
/// @tests     tests/rendering/reference/path/test_path_sampler.cpp
class PathSampler
{
public:
    PathSampler(uint64_t seed, uint32_t pixel, uint32_t sample) : seed_(seed), pixel_(pixel), sample_(sample)
    {}

    std::array<double, 2> pair(); ///< two random numbers in [0, 1)
    /// A random number in [0, 1) without stratification. Use this function for frequent decisions, such as
    /// null collisions.
    double number();

private:
    uint64_t seed_;
    uint32_t pixel_, sample_;
    uint32_t pairs_ = 0, numbers_ = 0;
    std::array<uint32_t, 4> words_{};
    uint32_t left_ = 0; ///< number of unused numbers in `words_`
};

} // namespace fx::render
