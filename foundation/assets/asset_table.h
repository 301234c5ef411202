/// @file asset_table.h
/// Images and meshes by id. Presets name them, particles store their ids, and views draw them.
///
/// Assets never change and live as long as their table. Equal content gets the same id, so a texture that a
/// hundred presets use is stored once. Threads: any. Additions are serialized by a mutex; reading takes no
/// lock.
#pragma once

#include "foundation/result/status.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <span>
#include <vector>

namespace fx::base {

/// Names an asset of one table; > 0, and small enough to be exact as a float. 0: none.
using AssetId = uint32_t;

/// Four bytes a texel, rows from the top, color not multiplied by the opacity.
struct ImageAsset
{
    int width = 0;      ///< [texel] >= 1
    int height = 0;     ///< [texel] >= 1
    bool isSrgb = true; ///< color is encoded by the sRGB curve (opacity never is); false: linear
    std::pmr::vector<uint8_t> rgba;
};

/// A corner of a triangle.
struct MeshVertex
{
    glm::vec3 position; ///< [1] of the particle's radius
    glm::vec3 normal;   ///< unit
    glm::vec2 texture;  ///< [1] from the image's lower left
};

/// Triangles, counterclockwise seen from outside.
struct MeshAsset
{
    std::pmr::vector<MeshVertex> vertices;
    std::pmr::vector<uint32_t> indices; ///< three a triangle
    float reach = 0.0f;                 ///< [1] distance of the farthest vertex from the origin
};

class AssetTable
{
public:
    static constexpr uint32_t kMaxAssets = 4096;
    static constexpr int kLargestSide = 8192; ///< [texel]

    explicit AssetTable(std::pmr::memory_resource* memory) : memory_(memory), owned_(memory) {}

    /// @return the id; InvalidArgument for sizes that do not fit each other; Capacity
    Result<AssetId> addImage(int width, int height, bool isSrgb, std::span<const uint8_t> rgba);
    /// @return the id; InvalidArgument without a triangle, with an index beyond the vertices or a value that
    ///         is not finite; Capacity
    Result<AssetId> addMesh(std::span<const MeshVertex> vertices, std::span<const uint32_t> indices);

    /// Null when `id` is no image (mesh) of this table.
    const ImageAsset* image(AssetId id) const;
    const MeshAsset* mesh(AssetId id) const;

    uint32_t size() const { return size_.load(std::memory_order_acquire); }   ///< ids 1 to size() exist
    uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); } ///< [byte] of all content

private:
    struct Entry
    {
        uint64_t hash = 0;
        std::unique_ptr<ImageAsset> image;
        std::unique_ptr<MeshAsset> mesh;
    };

    const Entry* entry(AssetId id) const;
    template <class Same>
    AssetId find(uint64_t hash, const Same& same) const;
    Result<AssetId> publish(Entry entry, uint64_t bytes);

    std::pmr::memory_resource* memory_;
    std::mutex adding_; ///< guards owned_
    std::pmr::vector<std::unique_ptr<Entry>> owned_;
    std::array<std::atomic<const Entry*>, kMaxAssets> byId_{};
    std::atomic<uint32_t> size_{0};
    std::atomic<uint64_t> bytes_{0};
};

} // namespace fx::base
