/// @file tile_candidates.h
/// Candidate balls of all rays of a tile. A large tile traverses the tree; its parts filter the list of the
/// large tile; each ray tests the list of its part. Lists are in the order of the tree.
#pragma once

#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"
#include "rendering/reference/trace/ray_hits.h"

#include <array>
#include <vector>

namespace fx::render {

/// Columns of candidates; padded beyond size() with entries that no ray hits. Keeps its memory.
class TileCandidates
{
public:
    /// All balls of `tree` that reach into `frustum`.
    void collect(const BallTree& tree, const TileFrustum& frustum);
    /// Those of `from` that reach into `frustum`.
    void narrow(const TileCandidates& from, const TileFrustum& frustum);

    /// Replaces `out` by the candidates that `ray` meets between the parameters `begin` and `end`.
    ///
    /// A ball is met when the distance of its center from the ray, taken from the vector across the ray, is
    /// less than its radius, and it is not left before `begin` nor entered behind `end`. In double
    /// throughout, the same bits for every instruction set. [any thread]
    void hits(const TraceRay& ray, double begin, double end, RayHits& out) const;

    size_t size() const { return size_; }
    const uint32_t* places() const { return place_.data(); }

    // For the loops in tile_candidates.cpp.
    enum Column
    {
        X, ///< [m] relative to the tree's origin
        Y,
        Z,
        Radius, ///< [m]
        Columns
    };
    const double* column(Column column) const { return columns_[column].data(); }
    double* editColumn(Column column) { return columns_[column].data(); }
    uint32_t* editPlaces() { return place_.data(); }
    void reserve(size_t size);
    void close(size_t size);

private:
    size_t size_ = 0;
    std::array<std::vector<double>, Columns> columns_;
    std::vector<uint32_t> place_;
};

} // namespace fx::render
