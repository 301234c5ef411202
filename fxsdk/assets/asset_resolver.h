/// @file asset_resolver.h
/// Resolves all names of assets (presets, images, meshes) that presets and scenes contain.
///
/// A name is `library:NAME` (compiled into the library), or relative to the folder of the file that uses
/// it. A name is never absolute and never leads out of the folder, not even through a symbolic link.
/// Threads: any. Several threads may read from one resolver if the host's hook is thread-safe.
#pragma once

#include "foundation/result/embedded_text.h"
#include "foundation/result/status.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace fx::asset {

/// The host's own storage, such as an archive or a database. The resolver searches the storage before the
/// folder.
struct ReadHook
{
    void* user = nullptr;
    /// Passes the asset's bytes to `deliver` in one call and returns 0. Returns 1 when the asset does not
    /// exist, 2 when the asset has more than `maxBytes`, and any other number when the asset cannot be read.
    /// `name` ends with a zero.
    int (*read)(void* user, const char* name, uint64_t maxBytes,
                void (*deliver)(void* sink, const void* data, size_t size), void* sink) = nullptr;
};

class AssetResolver
{
public:
    /// Creates a resolver, which finds assets in the library, through the hook, or in a folder.
    /// @param folder folder that names are relative to; empty: no files, only the library and the hook
    /// @param library embedded texts, which must outlive the resolver. library:NAME is the text NAME.fx.json,
    ///          or the text NAME when NAME contains a dot
    AssetResolver(std::string folder, std::span<const base::EmbeddedText> library, const ReadHook& hook = {})
        : folder_(std::move(folder)), library_(library), hook_(hook)
    {}

    /// The same resolver with another library.
    AssetResolver withLibrary(std::span<const base::EmbeddedText> library) const
    {
        return {folder_, library, hook_};
    }

    /// Reads the bytes of the asset `name`.
    /// @param maxBytes [byte] larger assets give TooLarge before anything is read
    /// @return InvalidArgument for a name that is not allowed, NotFound, TooLarge, Io
    base::Result<std::string> read(std::string_view name, uint64_t maxBytes) const;

    /// Path of the file of `name` with all links resolved. The path is empty in four cases: the name is not
    /// allowed; the name belongs to the library; the file does not exist; a hook is set.
    std::string fileOf(std::string_view name) const;

    const std::string& folder() const { return folder_; }
    /// True if a copy of the resolver can read for as long as the process runs; false with a hook, which is
    /// the host's.
    bool isLasting() const { return !hook_.read; }

private:
    base::Result<std::string> readLibrary(std::string_view name, uint64_t maxBytes) const;
    base::Result<std::string> readHook(const std::string& name, uint64_t maxBytes) const;
    base::Result<std::string> find(const std::string& name) const;

    std::string folder_;
    std::span<const base::EmbeddedText> library_;
    ReadHook hook_;
};

/// Ok if `name` is a valid name of an asset; otherwise InvalidArgument with the reason.
base::Status checkAssetName(std::string_view name);

} // namespace fx::asset
