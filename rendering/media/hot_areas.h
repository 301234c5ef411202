/// @file hot_areas.h
/// Areas of the picture that may show hot gas, for heat shimmer.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/heat_shimmer_pass.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// [pixel] side of the tiles that areas are made of.
inline constexpr uint32_t kHotTile = 16;

class HotAreas
{
public:
    explicit HotAreas(std::pmr::memory_resource* memory) : counts_(memory), areas_(memory) {}

    /// Finds all tiles that blobs with heat may reach, as rows of neighbors: every pixel in which such a blob
    /// leaves heat is in exactly one area. Takes a few nanoseconds a blob and a tile. Allocates nothing when
    /// an earlier picture was as large and as hot.
    void find(std::span<const BlobInstance> blobs, const CameraView& camera, int width, int height);
    void clear() { areas_.clear(); }

    /// Areas of the last find().
    std::span<const HotArea> areas() const { return areas_; }

private:
    void count(const CameraGeometry& camera, const BlobInstance& blob, bool isFlipped);
    void collect();

    uint32_t width_ = 0, height_ = 0;  ///< [pixel]
    uint32_t columns_ = 0, rows_ = 0;  ///< [tile]
    std::pmr::vector<int32_t> counts_; ///< of blobs that begin and end at a tile; their sums are those on it
    std::pmr::vector<HotArea> areas_;
};

} // namespace fx::render
