/// @file asset_loader.h
/// Names in presets to ids in the asset table: reads PNG images and OBJ meshes through the resolver.
#pragma once

#include "foundation/assets/asset_table.h"
#include "fxsdk/assets/asset_resolver.h"

#include <string>
#include <string_view>

namespace fx::asset {

constexpr uint64_t kMostImageBytes = uint64_t(64) << 20; ///< [byte] of a PNG file
constexpr uint64_t kMostMeshBytes = uint64_t(32) << 20;  ///< [byte] of an OBJ file

/// How numbers in an image are meant.
enum class ImageUse
{
    Color,   ///< sRGB
    Numbers, ///< motion vectors, masks: as they are
};

/// What to do about an asset that is missing or damaged.
enum class MissingAsset
{
    IsAnError,
    ShowsPlaceholder, ///< a magenta and black checkerboard, a tetrahedron; motion vectors of nothing
};

/// Loads into one table. Threads: any; equal to those of the resolver.
class AssetLoader
{
public:
    AssetLoader(const AssetResolver& resolver, base::AssetTable& table, MissingAsset missing)
        : resolver_(resolver), table_(table), missing_(missing)
    {}

    /// @param columns, rows frames that the image must divide into, >= 1
    /// @param outWarning gets why a placeholder stands in; untouched otherwise
    /// @return NotFound, TooLarge, Parse, Schema (it does not divide), naming the asset and what to do
    base::Result<base::AssetId> image(std::string_view name, ImageUse use, int columns, int rows,
                                      std::string& outWarning) const;
    base::Result<base::AssetId> mesh(std::string_view name, std::string& outWarning) const;

private:
    base::Result<base::AssetId> readImage(std::string_view name, ImageUse use, int columns, int rows) const;
    base::Result<base::AssetId> readMesh(std::string_view name) const;

    const AssetResolver& resolver_;
    base::AssetTable& table_;
    MissingAsset missing_;
};

/// Ids of the placeholders, which are made when they are first asked for.
base::Result<base::AssetId> placeholderImage(base::AssetTable& table, ImageUse use);
base::Result<base::AssetId> placeholderMesh(base::AssetTable& table);

} // namespace fx::asset
