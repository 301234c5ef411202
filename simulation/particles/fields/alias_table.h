/// @file alias_table.h
/// Selects one of many items at random, by their weights, in constant time.
///
/// @formula alias-method
/// A table with one row per item; the two entries of each row distribute the weights evenly over the rows.
///
/// symbol   unit   meaning
///   n        1      number of items
///   pi       1      weight of item i over the sum of weights
///   qi       1      share of row i that selects item i, 0..1
///   ai       1      the item that the rest of row i selects
///   u, c     1      uniform numbers in [0, 1)
/// @derivation
///   A row holds 1 / n of the probability. Rows with n pi < 1 are filled up from items with n pi > 1, whose
///   weight is reduced by the same amount, until all rows are full                                      (1)
///   A draw selects row i = floor(n u), then item i if c < qi, otherwise item ai               (2)
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

/// Draws items with probabilities proportional to their weights. Objects are immutable. [any thread]
class AliasTable
{
public:
    AliasTable() = default;
    explicit AliasTable(std::span<const double> weights);

    uint32_t size() const { return uint32_t(rows_.size()); }
    /// Draws an item with a probability proportional to its weight.
    /// @param u uniform in [0, 1), with 48 random bits for large tables
    /// @param coin uniform in [0, 1)
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
        float keep;     ///< [1] probability q
        uint32_t alias; ///< index a of the alternative item
    };
    std::vector<Row> rows_;
};

} // namespace fx::sim
