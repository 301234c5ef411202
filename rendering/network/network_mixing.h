/// @file network_mixing.h
/// Acceleration of a fixed-point iteration: Anderson mixing of its last steps.
#pragma once

#include <deque>
#include <span>
#include <vector>

namespace fx::render {

/// @formula network-mixing
/// The linear combination of the last steps of an iteration with the smallest residual.
///
/// symbol   unit   meaning
///   x_n, G_n  any   input and output of step n
///   F_n       any   residual, G_n - x_n
///   c_i       1     coefficient of an earlier difference
/// @derivation
///   Let dF_i = F_(i+1) - F_i and dG_i = G_(i+1) - G_i. If the iteration is affine, the residual of
///       x = G_n - sum of c_i dG_i  is  F_n - sum of c_i dF_i                                    (1)
///   The c_i minimize the sum of squares of (1), weighted by `weight`: a system of at most 4 equations.
///   The diagonal of its matrix is multiplied by 1 + 1e-8, so that equal steps do no harm        (2)
/// @source    [WN11] Walker and Ni, algorithm of Anderson mixing
/// @deviation (2)
/// @valid     vectors of equal length
/// @accuracy  sums in double precision and in a fixed order
/// @tests     tests/rendering/network/test_network_mixing.cpp
///
/// Threads: one at a time.
class NetworkMixing
{
public:
    void clear();
    /// Stores the input and the output of a step of the iteration. Both vectors consist of parts of equal
    /// length.
    /// @param weight weight of each element of a part
    /// @param depth number of stored differences between steps, 0..4
    void remember(std::span<const float> input, std::span<const float> output, std::span<const float> weight,
                  int depth);
    /// True if `output` equals the output of the last step.
    bool continues(std::span<const float> output) const;
    bool isReady() const { return !earlier_.empty(); }
    /// Replaces the output of the last step by the mixture of the last steps. Does nothing after the first
    /// step.
    void mix(std::span<float> io) const;

private:
    double product(const std::vector<float>& a, const std::vector<float>& b) const;

    struct Difference
    {
        std::vector<float> change, output;
    };
    std::deque<Difference> earlier_;
    std::vector<float> change_, output_; ///< residual and output of the last step
    std::vector<float> weight_;
};

} // namespace fx::render
