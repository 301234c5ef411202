/// @file alias_table.h
/// Draws one of many things of different weight in constant time.
///
/// @formula alias-method
/// A table with one row a thing, whose two entries make the weights even.
///
/// symbol   unit   meaning
///   n        1      number of things
///   pi       1      weight of thing i over the sum of weights
///   qi       1      share of row i that keeps thing i, 0..1
///   ai       1      the thing that takes the rest of row i
///   u, c     1      uniform numbers in [0, 1)
/// @derivation
///   A row holds 1 / n of the probability. Rows with n pi < 1 are filled up by things with n pi > 1, which
///   lose as much, until none is left                                                               (1) The
///   draw is row i = floor(n u), then i when c < qi, else ai                               (2)
/// @source    [VOS91] for the linear-time construction
/// @deviation none
/// @valid     n >= 1; weights that are negative or not finite count as 0; when all are 0 they are equal
/// @accuracy  probabilities within 2^-23 of pi, and within n 2^-48 by the resolution of u
/// @tests     tests/simulation/particles/modules/test_alias_table.cpp
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fx::sim {

/// Immutable. Any thread.
class AliasTable
{
public:
    AliasTable() = default;
    explicit AliasTable(std::span<const double> weights);

    uint32_t size() const { return uint32_t(rows_.size()); }
    /// @param u in [0, 1), with 48 random bits for large tables @param coin in [0, 1)
    uint32_t draw(double u, float coin) const
    {
        const uint32_t last = size() - 1;
        const uint32_t row = uint32_t(u * double(size()));
        const Row& r = rows_[row < last ? row : last];
        return coin < r.keep ? (row < last ? row : last) : r.alias; // (2)
    }

private:
    struct Row
    {
        float keep;     ///< [1] q
        uint32_t alias; ///< a
    };
    std::vector<Row> rows_;
};

} // namespace fx::sim
