/// @file hot_areas.h
/// Finds the areas of the picture that may contain hot gas, for heat shimmer.
#pragma once

#include "rendering/frame/view_block.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/heat_shimmer_pass.h"

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// [pixel] Side of a tile. Areas consist of tiles.
inline constexpr uint32_t kHotTile = 16;

class HotAreas
{
public:
    explicit HotAreas(std::pmr::memory_resource* memory) : counts_(memory), areas_(memory) {}

    /// Finds all tiles that hot blobs may cover. Neighboring tiles of a row form one area. Every pixel to
    /// which a blob adds heat is in exactly one area. The search takes a few nanoseconds per blob and per
    /// tile.
    void find(std::span<const BlobInstance> blobs, const CameraView& camera, int width, int height);
    void clear() { areas_.clear(); }

    /// Results of the last find().
    std::span<const HotArea> areas() const { return areas_; }

private:
    void count(const CameraGeometry& camera, const BlobInstance& blob, bool isFlipped);
    void collect();

    uint32_t width_ = 0, height_ = 0; ///< [pixel]
    uint32_t columns_ = 0, rows_ = 0; ///< [tile]
    /// For each tile: number of blobs that begin at the tile, minus number of blobs that end at the tile. A
    /// prefix sum gives the number of blobs on each tile.
    std::pmr::vector<int32_t> counts_;
    std::pmr::vector<HotArea> areas_;
};

} // namespace fx::render
