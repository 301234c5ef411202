/// @file asset_table.h
/// Assets (images, meshes and volumes) by id. Presets name assets, particles store their ids, and views draw
/// the assets.
///
/// Assets never change and live as long as their table, except for those of a load that has failed. Equal
/// content gets the same id, so a texture that a hundred presets use is stored once. Threads: any thread may
/// add and read. A mutex serializes additions; reading takes no lock.
#pragma once

#include "foundation/assets/volume_levels.h"
#include "foundation/assets/voxel_volume.h"
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

/// Id of an asset in its table, from 1 to kMaxAssets, so that a float represents the id exactly. 0 means no
/// asset.
using AssetId = uint32_t;

/// An image with four bytes per texel: red, green, blue, opacity. The top row comes first. Color is not
/// premultiplied by opacity.
struct ImageAsset
{
    int width = 0;      ///< [texel] >= 1
    int height = 0;     ///< [texel] >= 1
    bool isSrgb = true; ///< true: colors are sRGB-encoded; false: colors are linear. Opacity is always linear
    std::pmr::vector<uint8_t> rgba;
};

/// A corner of a triangle.
struct MeshVertex
{
    glm::vec3 position; ///< [1] position in units of the particle's radius
    glm::vec3 normal;   ///< unit vector
    glm::vec2 texture;  ///< [1] texture coordinates; (0, 0) is the lower left corner of the image
};

/// An indexed triangle mesh. The vertices of a triangle are counterclockwise, seen from outside.
struct MeshAsset
{
    std::pmr::vector<MeshVertex> vertices;
    std::pmr::vector<uint32_t> indices; ///< indices of vertices, three for each triangle
    float reach = 0.0f;                 ///< [1] distance of the farthest vertex from the origin
};

class VolumeSequence;

class AssetTable
{
public:
    static constexpr uint32_t kMaxAssets = 4096;
    static constexpr int kLargestSide = 8192; ///< [texel]

    explicit AssetTable(std::pmr::memory_resource* memory) : memory_(memory), owned_(memory) {}

    /// Adds an image. If the table already has an equal image, its id is returned.
    /// @param rgba width * height * 4 bytes; width and height 1 to kLargestSide
    /// @return the id; InvalidArgument for other sizes; Capacity if the table is full
    Result<AssetId> addImage(int width, int height, bool isSrgb, std::span<const uint8_t> rgba);
    /// Adds a mesh. If the table already has an equal mesh, its id is returned.
    /// @return the id; InvalidArgument without a triangle, with an index that is too large or with a value
    ///         that is not finite; Capacity if the table is full
    Result<AssetId> addMesh(std::span<const MeshVertex> vertices, std::span<const uint32_t> indices);
    /// Adds a volume. If the table already has a volume with this hash, its id is returned.
    /// @param hash hash of the content  @return the id; Capacity if the table is full
    /// @param coarser its coarser levels; null: views draw it from its own voxels at any distance
    Result<AssetId> addVolume(std::shared_ptr<const VoxelVolume> volume, uint64_t hash,
                              CoarserLevels coarser = nullptr);
    /// Adds a sequence of volumes, likewise. Its frames come and go, and are not part of bytes().
    Result<AssetId> addSequence(std::shared_ptr<VolumeSequence> sequence, uint64_t hash);

    /// Removes the newest assets, so that `count` are left. Nothing may use the ids of the others.
    void truncate(uint32_t count);

    /// The image (or mesh, or volume) of `id`; null if this table has no image (or mesh, or volume) with this
    /// id.
    const ImageAsset* image(AssetId id) const;
    const MeshAsset* mesh(AssetId id) const;
    std::shared_ptr<const VoxelVolume> volume(AssetId id) const;
    CoarserLevels coarserLevels(AssetId id) const; ///< of a volume, likewise
    /// Null if this table has no sequence with this id.
    std::shared_ptr<VolumeSequence> sequence(AssetId id) const;

    /// Number of assets; their ids are 1 to size().
    uint32_t size() const { return size_.load(std::memory_order_acquire); }
    /// [byte] size of all images, meshes and volumes with their coarser levels
    uint64_t bytes() const { return bytes_.load(std::memory_order_relaxed); }

private:
    struct Entry
    {
        uint64_t hash = 0;
        uint64_t bytes = 0; ///< part of bytes()
        std::unique_ptr<ImageAsset> image;
        std::unique_ptr<MeshAsset> mesh;
        std::shared_ptr<const VoxelVolume> volume;
        CoarserLevels coarser;
        std::shared_ptr<VolumeSequence> sequence;
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
