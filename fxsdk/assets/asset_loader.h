/// @file asset_loader.h
/// Loads the images, meshes and volumes that one document names, and returns their ids in the asset table.
/// Presets access files only through this class.
#pragma once

#include "foundation/assets/asset_table.h"
#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/load_monitor.h"
#include "fxsdk/assets/sequence_reader.h"

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace fx::asset {

constexpr uint64_t kMaxImageBytes = uint64_t(64) << 20; ///< [byte] maximum size of a PNG file
constexpr uint64_t kMaxMeshBytes = uint64_t(32) << 20;  ///< [byte] maximum size of an OBJ file

/// Meaning of the values of an image.
enum class ImageUse
{
    Color,   ///< sRGB
    Numbers, ///< linear values: motion vectors, masks
};

/// Handling of an asset that is missing or damaged.
enum class MissingAsset
{
    IsAnError,
    ShowsPlaceholder, ///< image: magenta and black checkerboard; mesh: tetrahedron; motion vectors: zero
};

/// Loads the assets of one document into one table. Threads: one thread at a time.
class AssetLoader
{
public:
    /// Creates a loader for the assets of one document.
    /// @param folder folder of the document, relative to the resolver's folder and ending with '/'; empty:
    ///          the resolver's folder
    /// @param monitor receives the names of the files before they are read; null: none
    AssetLoader(const AssetResolver& resolver, base::AssetTable& table, MissingAsset missing,
                std::string folder = {}, LoadMonitor* monitor = nullptr)
        : resolver_(resolver), table_(table), missing_(missing), folder_(std::move(folder)), monitor_(monitor)
    {}

    /// Reads the bytes of the asset `name`, which is relative to the document. @return codes of
    /// AssetResolver::read()
    base::Result<std::string> read(std::string_view name, uint64_t maxBytes);
    /// Hash of all bytes read, in the order of reading; 0 if nothing was read. A volume is read once.
    uint64_t contentHash() const { return contentHash_; }
    const base::AssetTable& table() const { return table_; }
    LoadMonitor* monitor() const { return monitor_; } ///< null: none

    /// Loads an image. @param columns, rows numbers of frames by which the image must be divisible, >= 1
    /// @param outWarning receives the reason for a placeholder; untouched if there is no placeholder
    /// @return NotFound, TooLarge, Parse, Schema (not divisible); the message names the asset and the
    ///         remedy
    base::Result<base::AssetId> image(std::string_view name, ImageUse use, int columns, int rows,
                                      std::string& outWarning);
    base::Result<base::AssetId> mesh(std::string_view name, std::string& outWarning);
    /// Loads a volume (volume_file.h). A volume that the document names again is not read again. A missing or
    /// damaged volume is always an error, because no other medium could stand in.
    base::Result<base::AssetId> volume(std::string_view name);
    /// Loads a sequence of volumes (sequence_reader.h), whose files are read again while it is played, unless
    /// they come through the hook of a host: then all voxels are held.
    base::Result<base::AssetId> sequence(const SequenceFiles& files);

private:
    std::string nameIn(std::string_view name) const;
    base::Result<base::AssetId> readImage(std::string_view name, ImageUse use, int columns, int rows);
    base::Result<base::AssetId> readMesh(std::string_view name);

    const AssetResolver& resolver_;
    base::AssetTable& table_;
    MissingAsset missing_;
    std::string folder_;
    LoadMonitor* monitor_;
    std::map<std::string, base::AssetId, std::less<>> volumes_; ///< by name
    uint64_t contentHash_ = 0;
};

/// Ids of the placeholders, which are created on first use.
base::Result<base::AssetId> placeholderImage(base::AssetTable& table, ImageUse use);
base::Result<base::AssetId> placeholderMesh(base::AssetTable& table);

} // namespace fx::asset
