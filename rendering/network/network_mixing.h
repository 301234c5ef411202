/// @file network_mixing.h
/// Acceleration of a fixed-point iteration by its last steps.
#pragma once

#include <deque>
#include <span>
#include <vector>

namespace fx::render {

/// @formula network-mixing
/// The mix of the last steps of an iteration whose change is least.
///
/// symbol   unit   meaning
///   x_n, G_n  any   a step's input and output
///   F_n       any   G_n - x_n
///   c_i       1     share of an earlier difference
/// @derivation
///   With dF_i = F_(i+1) - F_i and dG_i = G_(i+1) - G_i of the last steps, were the iteration affine
///       x = G_n - sum of c_i dG_i changes by F_n - sum of c_i dF_i                              (1)
///   The c_i make the sum of squares of (1), weighted by `weight`, least: a system of at most 4 equations.
///   Its diagonal is enlarged by 1e-8, so that steps which do not differ are harmless               (2)
/// @source    [WN11] Walker and Ni, algorithm of Anderson mixing
/// @deviation (2)
/// @valid     vectors of one length
/// @accuracy  sums in double precision and in a fixed order
/// @tests     tests/rendering/network/test_network_mixing.cpp
///
/// Threads: one at a time.
class NetworkMixing
{
public:
    void clear();
    /// @param depth differences that are kept, 0..4  @param weight one for each element of a part of the
    /// vectors, which consist of equal parts
    void remember(std::span<const float> input, std::span<const float> output, std::span<const float> weight,
                  int depth);
    /// Whether `output` is that of the last step.
    bool continues(std::span<const float> output) const;
    bool isReady() const { return !earlier_.empty(); }
    /// Replaces the output of the last step by the mix. Does nothing after the first step.
    void mix(std::span<float> io) const;

private:
    double product(const std::vector<float>& a, const std::vector<float>& b) const;

    struct Difference
    {
        std::vector<float> change, output;
    };
    std::deque<Difference> earlier_;
    std::vector<float> change_, output_; ///< of the last step
    std::vector<float> weight_;
};

} // namespace fx::render
