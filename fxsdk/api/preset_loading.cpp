#include "fxsdk/api/preset_loading.h"

#include "fxsdk/api/check.h"
#include "fxsdk/presets/preset_loader.h"

#include <utility>

namespace fx::api {

namespace {

using base::Code;
using base::Result;
using base::Status;
using preset::LoadedPreset;

/// Adapts the host's asset hook to the resolver.
int readThroughHook(void* user, const char* name, uint64_t maxBytes,
                    void (*deliver)(void* sink, const void* data, size_t size), void* sink)
{
    const FxAssetHook& hook = *static_cast<const FxAssetHook*>(user);
    size_t size = 0;
    const void* data = hook.open(hook.user, name, &size);
    if (!data)
        return 1;
    struct Closer
    {
        const FxAssetHook& hook;
        const void* data;
        size_t size;
        ~Closer() { hook.close(hook.user, data, size); }
    } closer{hook, data, size};
    if (size > maxBytes)
        return 2;
    deliver(sink, data, size);
    return 0;
}

/// Removes the assets of a load that does not succeed. No other load adds assets meanwhile.
class NewAssets
{
public:
    explicit NewAssets(base::AssetTable& table) : table_(table), before_(table.size()) {}
    ~NewAssets()
    {
        if (!isKept)
            table_.truncate(before_);
    }
    NewAssets(const NewAssets&) = delete;
    NewAssets& operator=(const NewAssets&) = delete;

    bool isKept = false;

private:
    base::AssetTable& table_;
    const uint32_t before_;
};

/// Loads a preset under the context's lock and enters what `load` returns into its table.
template <class Load>
Status loadInto(FxContext& context, std::string source, asset::LoadMonitor* monitor, FxPresetId& outPreset,
                Load&& load)
{
    const SharedCaller::Scope loading(context.loading);
    if (!loading.status())
        return loading.status();
    NewAssets assets(context.assets);
    Result<LoadedPreset> loaded = load();
    if (!loaded)
        return loaded.status();
    if (monitor)
        monitor->check();
    for (const preset::Diagnostic& warning : loaded->warnings)
        logMessage(context, FX_LOG_WARNING, preset::toString(warning).c_str());

    const SharedCaller::Scope tables(context.tables);
    if (!tables.status())
        return tables.status();
    const scene::LocalId id = context.presets.add({std::move(loaded->effect), std::move(source)});
    if (id == 0)
        return {Code::Capacity, "no more presets can be loaded"};
    outPreset.bits = context.ids.encode(id, kPresetIdType);
    assets.isKept = true;
    return {};
}

/// Images and meshes of all presets live in the context.
preset::PresetAssets assetsOf(FxContext& context, asset::LoadMonitor* monitor)
{
    const bool isLenient = (context.def.flags & FX_CONTEXT_PLACEHOLDERS) != 0;
    return {&context.assets,
            isLenient ? asset::MissingAsset::ShowsPlaceholder : asset::MissingAsset::IsAnError, monitor};
}

Result<LoadedPreset> loadFile(FxContext& context, const std::string& path, asset::LoadMonitor* monitor)
{
    FxAssetHook hook = context.def.assets;
    if (hook.open && asset::checkAssetName(path).ok() && !path.starts_with(kLibraryPrefix)) {
        const asset::AssetResolver resolver("", preset::libraryFiles(), {&hook, &readThroughHook});
        Result<LoadedPreset> loaded = preset::loadPresetAsset(
            path, resolver, nullptr, assetsOf(context, monitor), context.techniques.presets);
        if (loaded.ok() || loaded.status().code() != Code::NotFound)
            return loaded;
    }
    return preset::loadPresetFile(path, nullptr, assetsOf(context, monitor), context.techniques.presets);
}

/// Loads a text with the files that loadFile() finds for a preset at `path`.
Result<LoadedPreset> loadTextAt(FxContext& context, const PresetSource& source, asset::LoadMonitor* monitor)
{
    FxAssetHook hook = context.def.assets;
    const std::string& path = source.path;
    const bool isInLibrary = path.starts_with(kLibraryPrefix);
    const bool isHooked = hook.open && !isInLibrary && asset::checkAssetName(path).ok();
    const std::string folder = isInLibrary ? std::string() : preset::folderOf(path);
    const std::string root = isInLibrary ? std::string() : folder.empty() || isHooked ? "." : folder;
    const asset::AssetResolver resolver(root, preset::libraryFiles(),
                                        isHooked ? asset::ReadHook{&hook, &readThroughHook}
                                                 : asset::ReadHook{});
    return preset::loadPresetText(source.text, path, nullptr, &resolver, assetsOf(context, monitor),
                                  isHooked ? folder : std::string(), context.techniques.presets);
}

} // namespace

Status checkPresetLength(size_t length)
{
    if (length == 0)
        return invalid("length is 0");
    if (length > preset::kPresetBytes)
        return {Code::TooLarge, "length is " + std::to_string(length) + "; a preset has at most " +
                                    std::to_string(preset::kPresetBytes) + " bytes"};
    return {};
}

Status loadPreset(FxContext& context, const PresetSource& source, asset::LoadMonitor* monitor,
                  FxPresetId& outPreset)
{
    return loadInto(context, source.path, monitor, outPreset, [&] {
        return source.hasText ? loadTextAt(context, source, monitor)
                              : loadFile(context, source.path, monitor);
    });
}

Status loadLibraryPreset(FxContext& context, const std::string& name, asset::LoadMonitor* monitor,
                         FxPresetId& outPreset)
{
    return loadInto(context, name, monitor, outPreset, [&] {
        const asset::AssetResolver library("", preset::libraryFiles());
        return preset::loadPresetAsset(name, library, nullptr, assetsOf(context, monitor),
                                       context.techniques.presets);
    });
}

Status loadPresetText(FxContext& context, std::string_view text, const std::string& name,
                      FxPresetId& outPreset)
{
    return loadInto(context, name, nullptr, outPreset, [&] {
        return preset::loadPresetText(text, name, nullptr, nullptr, assetsOf(context, nullptr), {},
                                      context.techniques.presets);
    });
}

} // namespace fx::api
