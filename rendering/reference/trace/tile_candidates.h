/// @file tile_candidates.h
/// Candidate balls of all rays of a tile. A large tile traverses the tree. Smaller tiles filter the list of
/// candidates of the large tile. A ray is tested against the list of its tile. Lists are in the order of the
/// tree.
#pragma once

#include "rendering/reference/trace/ball_tree.h"
#include "rendering/reference/trace/ray_grid.h"
#include "rendering/reference/trace/ray_hits.h"

#include <array>
#include <vector>

namespace fx::render {

/// The candidates of a tile, as columns that are padded after size() with entries that no ray hits. The
/// memory is reused for the next tile.
class TileCandidates
{
public:
    /// Collects all balls of `tree` that intersect `frustum`.
    void collect(const BallTree& tree, const TileFrustum& frustum);
    /// Collects the candidates of `from` that intersect `frustum`.
    void narrow(const TileCandidates& from, const TileFrustum& frustum);

    /// Replaces `out` by the candidates that `ray` meets between the parameters `begin` and `end`.
    ///
    /// A ray meets a ball if the distance of the center from the ray is less than the radius, and if the ray
    /// neither leaves the ball before `begin` nor enters it after `end`. See formula ball-chord. All
    /// instruction sets give the same bits. Any thread may call this function.
    void hits(const TraceRay& ray, double begin, double end, RayHits& out) const;

    size_t size() const { return size_; }
    const uint32_t* places() const { return place_.data(); }

    // For tile_candidates.cpp:
    enum Column
    {
        X, ///< [m] position relative to the tree's origin
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
