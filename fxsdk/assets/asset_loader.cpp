#include "fxsdk/assets/asset_loader.h"

#include "foundation/math/hash.h"
#include "fxsdk/assets/obj_reader.h"
#include "fxsdk/assets/png_reader.h"
#include "fxsdk/assets/volume_file.h"
#include "rendering/volumes/volume_levels.h"

#include <glm/geometric.hpp>

#include <array>
#include <vector>

namespace fx::asset {

namespace {

base::Status inAsset(std::string_view name, const base::Status& why)
{
    return {why.code(), "asset \"" + std::string(name) + "\": " + why.message()};
}

std::span<const uint8_t> asBytes(const std::string& text)
{
    return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

} // namespace

base::Result<base::AssetId> placeholderImage(base::AssetTable& table, ImageUse use)
{
    constexpr int kSide = 16;
    constexpr int kSquare = 4;
    std::vector<uint8_t> rgba;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const bool bright = (x / kSquare + y / kSquare) % 2 == 0;
            const uint8_t color = bright ? uint8_t(255) : uint8_t(0);
            if (use == ImageUse::Color)
                rgba.insert(rgba.end(), {color, 0, color, 255});
            else
                rgba.insert(rgba.end(), {128, 128, 0, 255});
        }
    return table.addImage(kSide, kSide, use == ImageUse::Color, rgba);
}

base::Result<base::AssetId> placeholderMesh(base::AssetTable& table)
{
    constexpr std::array<glm::vec3, 4> kCorners{glm::vec3(1, 1, 1), glm::vec3(1, -1, -1),
                                                glm::vec3(-1, 1, -1), glm::vec3(-1, -1, 1)};
    constexpr std::array<std::array<size_t, 3>, 4> kFaces{{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
    std::vector<base::MeshVertex> vertices;
    std::vector<uint32_t> indices;
    for (const auto& face : kFaces) {
        const glm::vec3 normal = glm::normalize(kCorners[face[0]] + kCorners[face[1]] + kCorners[face[2]]);
        for (const size_t corner : face) {
            indices.push_back(uint32_t(vertices.size()));
            vertices.push_back({glm::normalize(kCorners[corner]), normal, glm::vec2(0.0f)});
        }
    }
    return table.addMesh(vertices, indices);
}

/// The name for the resolver.
std::string AssetLoader::nameIn(std::string_view name) const
{
    const bool isRelative = checkAssetName(name) && !name.starts_with("library:");
    return (isRelative ? folder_ : std::string()) + std::string(name);
}

base::Result<std::string> AssetLoader::read(std::string_view name, uint64_t maxBytes)
{
    if (monitor_)
        monitor_->beginFile(name);
    base::Result<std::string> bytes = resolver_.read(nameIn(name), maxBytes);
    if (bytes)
        contentHash_ = base::hashWord(contentHash_, base::hashBytes(0, bytes->data(), bytes->size()));
    return bytes;
}

base::Result<base::AssetId> AssetLoader::readImage(std::string_view name, ImageUse use, int columns, int rows)
{
    const base::Result<std::string> bytes = read(name, kMaxImageBytes);
    if (!bytes)
        return bytes.status();
    const base::Result<PngPicture> picture = readPng(asBytes(*bytes));
    if (!picture)
        return inAsset(name, picture.status());
    if (columns < 1 || rows < 1 || picture->width % columns != 0 || picture->height % rows != 0)
        return inAsset(name,
                       {base::Code::Schema,
                        std::to_string(picture->width) + " x " + std::to_string(picture->height) +
                            " texels do not divide into " + std::to_string(columns) + " x " +
                            std::to_string(rows) + " frames; correct the numbers of frames or the image"});
    return table_.addImage(picture->width, picture->height, use == ImageUse::Color, picture->rgba);
}

base::Result<base::AssetId> AssetLoader::readMesh(std::string_view name)
{
    const base::Result<std::string> text = read(name, kMaxMeshBytes);
    if (!text)
        return text.status();
    const base::Result<ObjMesh> mesh = readObj(*text);
    if (!mesh)
        return inAsset(name, mesh.status());
    return table_.addMesh(mesh->vertices, mesh->indices);
}

base::Result<base::AssetId> AssetLoader::image(std::string_view name, ImageUse use, int columns, int rows,
                                               std::string& outWarning)
{
    base::Result<base::AssetId> id = readImage(name, use, columns, rows);
    if (id || missing_ == MissingAsset::IsAnError || id.status().code() == base::Code::Capacity)
        return id;
    outWarning = id.status().message() + "; a checkerboard stands in";
    return placeholderImage(table_, use);
}

base::Result<base::AssetId> AssetLoader::mesh(std::string_view name, std::string& outWarning)
{
    base::Result<base::AssetId> id = readMesh(name);
    if (id || missing_ == MissingAsset::IsAnError || id.status().code() == base::Code::Capacity)
        return id;
    outWarning = id.status().message() + "; a tetrahedron stands in";
    return placeholderMesh(table_);
}

base::Result<base::AssetId> AssetLoader::volume(std::string_view name)
{
    if (const auto known = volumes_.find(name); known != volumes_.end())
        return known->second;
    const base::Result<std::string> bytes = read(name, kMaxVolumeFileBytes);
    if (!bytes)
        return bytes.status();
    base::Result<base::VoxelVolume> volume = parseVolume(*bytes);
    if (!volume)
        return inAsset(name, volume.status());
    base::CoarserLevels coarser = render::coarserLevels(*volume);
    base::Result<base::AssetId> id =
        table_.addVolume(std::make_shared<const base::VoxelVolume>(std::move(*volume)),
                         base::hashBytes(2, bytes->data(), bytes->size()), std::move(coarser));
    if (id)
        volumes_.emplace(name, *id);
    return id;
}

base::Result<base::AssetId> AssetLoader::sequence(const SequenceFiles& files)
{
    ReadBytes later;
    if (resolver_.isLasting())
        later = [resolver = resolver_, folder = folder_](std::string_view name) {
            return resolver.read(folder + std::string(name), kMaxVolumeFileBytes);
        };
    if (monitor_)
        monitor_->divide(files.count);
    uint64_t hash = 0;
    const auto sequence = readSequence(
        files, [this](std::string_view name) { return read(name, kMaxVolumeFileBytes); }, std::move(later),
        hash);
    if (!sequence)
        return sequence.status();
    return table_.addSequence(*sequence, hash);
}

} // namespace fx::asset
