/// @file gl_asset_cache.h
/// Cache of GL objects for the images and meshes of an asset table. An object is created when a frame first
/// uses the object.
///
/// An image becomes a texture array with one layer for each frame of its atlas, so that texture filtering
/// does not mix neighboring frames. The array has all mip levels. Threads: [GL thread].
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/result/status.h"
#include "rendering/gl/gl_buffer.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// A texture array on the GPU, with one layer per frame of an image atlas.
struct GlAtlas
{
    uint32_t texture = 0; ///< GL_TEXTURE_2D_ARRAY
    int width = 1;        ///< [texel] width of one frame
    int height = 1;
    int frames = 1;
};

/// A mesh on the GPU: a storage buffer with vertices (8 floats each), followed by indices.
struct GlMesh
{
    uint32_t buffer = 0;
    uint64_t bytes = 0;
    uint32_t firstIndex = 0; ///< [word] offset of the first index, in words of 4 bytes
    uint32_t indexCount = 0;
    float reach = 0.0f;
};

class GlAssetCache
{
public:
    GlAssetCache(GlDevice& device, std::pmr::memory_resource* memory)
        : device_(device), atlases_(memory), meshes_(memory)
    {}
    ~GlAssetCache();
    GlAssetCache(const GlAssetCache&) = delete;
    GlAssetCache& operator=(const GlAssetCache&) = delete;

    /// Returns the texture array of image `id`. The image has `columns` x `rows` frames, row by row from the
    /// upper left. If no image has this id, the result has one white texel.
    /// @return OutOfMemory, InvalidArgument (more frames than the context's arrays have layers)
    base::Result<GlAtlas> atlas(const base::AssetTable* table, base::AssetId id, int columns, int rows);
    /// Returns the buffer of mesh `id`.
    /// @return OutOfMemory, NotFound if no mesh has this id
    base::Result<GlMesh> mesh(const base::AssetTable* table, base::AssetId id);

    /// Deletes all objects; the next use of an object creates it again.
    void release();
    uint64_t bytes() const { return bytes_; } ///< [byte] size of all objects

private:
    struct Atlas
    {
        base::AssetId id;
        int columns, rows;
        GlAtlas atlas;
    };
    struct Mesh
    {
        base::AssetId id;
        GlBuffer buffer;
        GlMesh mesh;
    };

    base::Result<GlAtlas> makeAtlas(const base::ImageAsset& image, int columns, int rows);

    GlDevice& device_;
    std::pmr::vector<Atlas> atlases_;
    std::pmr::vector<Mesh> meshes_;
    uint64_t bytes_ = 0;
};

} // namespace fx::render
