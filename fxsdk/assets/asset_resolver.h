/// @file asset_resolver.h
/// Finds what presets and scenes name: other presets, images, meshes. The one place that turns a name into
/// bytes.
///
/// A name is `library:NAME` (compiled into the library), or relative to the folder of the file that uses it.
/// It is never absolute, never climbs out of the folder, not even through a symbolic link. Threads: any;
/// reading one resolver from several threads is safe when the host's hook is.
#pragma once

#include "foundation/result/embedded_text.h"
#include "foundation/result/status.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace fx::asset {

/// The host's own storage (an archive, a data base), asked before the folder.
struct ReadHook
{
    void* user = nullptr;
    /// Hands the asset's bytes to `deliver` in one call and returns 0; returns 1 when there is no such asset,
    /// 2 when it has more than `maxBytes`, and anything else when it cannot be read. `name` ends with a zero.
    int (*read)(void* user, const char* name, uint64_t maxBytes,
                void (*deliver)(void* sink, const void* data, size_t size), void* sink) = nullptr;
};

class AssetResolver
{
public:
    /// @param folder  where relative names begin; empty: there are no files, only the library and the hook
    /// @param library texts known as library:NAME, by file name NAME.fx.json, or NAME when it has a dot;
    ///                must outlive the resolver
    AssetResolver(std::string folder, std::span<const base::EmbeddedText> library, const ReadHook& hook = {})
        : folder_(std::move(folder)), library_(library), hook_(hook)
    {}

    /// The bytes behind `name`.
    /// @param maxBytes refused with TooLarge above this, before anything is read
    /// @return InvalidArgument for a name that is not allowed, NotFound, TooLarge, Io
    base::Result<std::string> read(std::string_view name, uint64_t maxBytes) const;

    /// The file behind `name`, every link followed. Empty when there is none: the name is not allowed or is
    /// one of the library, nothing is there, or a hook is asked first.
    std::string fileOf(std::string_view name) const;

    const std::string& folder() const { return folder_; }

private:
    base::Result<std::string> readLibrary(std::string_view name, uint64_t maxBytes) const;
    base::Result<std::string> readHook(const std::string& name, uint64_t maxBytes) const;
    base::Result<std::string> find(const std::string& name) const;

    std::string folder_;
    std::span<const base::EmbeddedText> library_;
    ReadHook hook_;
};

/// Ok when `name` may name an asset; otherwise InvalidArgument and the reason.
base::Status checkAssetName(std::string_view name);

} // namespace fx::asset
