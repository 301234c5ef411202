#include "rendering/gl/gl_asset_cache.h"

#include "foundation/assets/mip_levels.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_unpack_scope.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace fx::render {

namespace {

constexpr int kMaxFrames = 2048; ///< layers that every OpenGL 4.5 offers

/// One frame of an atlas, cut out, lowest row first as GL counts.
void cutFrame(const base::ImageAsset& image, int x0, int y0, int width, int height, std::vector<uint8_t>& out)
{
    out.resize(size_t(width) * size_t(height) * 4);
    for (int y = 0; y < height; ++y) {
        const size_t row = size_t(y0 + height - 1 - y);
        std::memcpy(&out[size_t(y) * size_t(width) * 4],
                    &image.rgba[(row * size_t(image.width) + size_t(x0)) * 4], size_t(width) * 4);
    }
}

} // namespace

GlAssetCache::~GlAssetCache()
{
    release();
}

void GlAssetCache::release()
{
    for (const Atlas& held : atlases_)
        device_.gl.DeleteTextures(1, &held.atlas.texture);
    atlases_.clear();
    meshes_.clear();
    bytes_ = 0;
}

base::Result<GlAtlas> GlAssetCache::atlas(const base::AssetTable* table, base::AssetId id, int columns,
                                          int rows)
{
    const base::ImageAsset* image = table ? table->image(id) : nullptr;
    if (!image)
        id = 0;
    for (const Atlas& held : atlases_)
        if (held.id == id && held.columns == columns && held.rows == rows)
            return held.atlas;
    const base::ImageAsset white{1, 1, false, std::pmr::vector<uint8_t>(4, 255)};
    const bool fits = image && columns >= 1 && rows >= 1 && columns <= image->width && rows <= image->height;
    base::Result<GlAtlas> made =
        fits ? makeAtlas(*image, columns, rows) : makeAtlas(image ? *image : white, 1, 1);
    if (made)
        atlases_.push_back({id, columns, rows, *made});
    return made;
}

base::Result<GlAtlas> GlAssetCache::makeAtlas(const base::ImageAsset& image, int columns, int rows)
{
    GlAtlas atlas{0, image.width / columns, image.height / rows, columns * rows};
    const std::string what = "texture of " + std::to_string(image.width) + "x" +
                             std::to_string(image.height) + " texels in " + std::to_string(atlas.frames) +
                             " frames";
    if (atlas.frames > kMaxFrames)
        return base::Status(base::Code::InvalidArgument, what + ": at most 2048 frames are possible");
    GlFunctions& gl = device_.gl;
    (void)device_.takeError("the host's own calls");
    const int levels = base::mipLevelCount(atlas.width, atlas.height);
    gl.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &atlas.texture);
    gl.TextureStorage3D(atlas.texture, levels, image.isSrgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, atlas.width,
                        atlas.height, atlas.frames);
    if (base::Status status = device_.takeError(what); !status) {
        gl.DeleteTextures(1, &atlas.texture);
        return status;
    }
    uint64_t bytes = 0;
    const GlUnpackScope unpack(gl);
    std::vector<uint8_t> texels;
    std::vector<uint8_t> smaller;
    for (int frame = 0; frame < atlas.frames; ++frame) {
        cutFrame(image, frame % columns * atlas.width, frame / columns * atlas.height, atlas.width,
                 atlas.height, texels);
        int width = atlas.width;
        int height = atlas.height;
        for (int level = 0; level < levels; ++level) {
            gl.TextureSubImage3D(atlas.texture, level, 0, 0, frame, width, height, 1, GL_RGBA,
                                 GL_UNSIGNED_BYTE, texels.data());
            bytes += texels.size();
            base::halveImage(texels, width, height, image.isSrgb, smaller);
            texels.swap(smaller);
            width = std::max(width / 2, 1);
            height = std::max(height / 2, 1);
        }
    }
    if (base::Status status = device_.takeError(what); !status) {
        gl.DeleteTextures(1, &atlas.texture);
        return status;
    }
    bytes_ += bytes;
    gl.ObjectLabel(GL_TEXTURE, atlas.texture, -1, "particle frames");
    return atlas;
}

base::Result<GlMesh> GlAssetCache::mesh(const base::AssetTable* table, base::AssetId id)
{
    for (const Mesh& held : meshes_)
        if (held.id == id)
            return held.mesh;
    const base::MeshAsset* asset = table ? table->mesh(id) : nullptr;
    if (!asset)
        return base::Status(base::Code::NotFound,
                            "mesh " + std::to_string(id) + " is not in the asset table");
    const size_t vertexBytes = asset->vertices.size() * sizeof(base::MeshVertex);
    const size_t indexBytes = asset->indices.size() * sizeof(uint32_t);
    base::Result<GlBuffer> buffer = GlBuffer::create(device_, vertexBytes + indexBytes, "particle mesh");
    if (!buffer)
        return buffer.status();
    device_.gl.NamedBufferSubData(buffer->name(), 0, GLsizeiptr(vertexBytes), asset->vertices.data());
    device_.gl.NamedBufferSubData(buffer->name(), GLintptr(vertexBytes), GLsizeiptr(indexBytes),
                                  asset->indices.data());
    const GlMesh mesh{buffer->name(), buffer->bytes(), uint32_t(vertexBytes / 4),
                      uint32_t(asset->indices.size()), asset->reach};
    bytes_ += buffer->bytes();
    meshes_.push_back({id, std::move(*buffer), mesh});
    return mesh;
}

} // namespace fx::render
