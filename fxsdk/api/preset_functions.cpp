// The functions of fx_preset.h, and the one of fx_reload.h that loads.
#include "foundation/result/nearest_name.h"
#include "fxsdk/api/check.h"
#include "fxsdk/api/context.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/text.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_reload.h"
#include "fxsdk/presets/preset_loader.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace {

using fx::base::Code;
using fx::base::Result;
using fx::base::Status;
using fx::preset::LoadedPreset;

constexpr std::string_view kLibraryPrefix = "library:";
constexpr double kMaxWork = 1e18; ///< [unit] largest reported value

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

/// Loads a preset under the context's lock and enters what `load` returns into its table.
template <class Load>
Status loadInto(FxContext* context, std::string source, FxPresetId* outPreset, Load&& load)
{
    const fx::api::SharedCaller::Scope loading(context->loading);
    if (!loading.status())
        return loading.status();
    Result<LoadedPreset> loaded = load();
    if (!loaded)
        return loaded.status();
    for (const fx::preset::Diagnostic& warning : loaded->warnings)
        fx::api::logMessage(*context, FX_LOG_WARNING, fx::preset::toString(warning).c_str());

    const fx::api::SharedCaller::Scope tables(context->tables);
    if (!tables.status())
        return tables.status();
    const fx::scene::LocalId id = context->presets.add({std::move(loaded->effect), std::move(source)});
    if (id == 0)
        return {Code::Capacity, "no more presets can be loaded"};
    outPreset->bits = context->ids.encode(id, fx::api::kPresetIdType);
    return {};
}

Status checkLoad(const FxContext* context, const void* text, const char* textName,
                 const FxPresetId* outPreset)
{
    fx::api::Checks check;
    check.notNull(context, "context");
    check.notNull(text, textName);
    check.notNull(outPreset, "outPreset");
    return check.status();
}

/// Images and meshes of all presets live in the context.
fx::preset::PresetAssets assetsOf(FxContext& context)
{
    const bool isLenient = (context.def.flags & FX_CONTEXT_PLACEHOLDERS) != 0;
    return {&context.assets,
            isLenient ? fx::asset::MissingAsset::ShowsPlaceholder : fx::asset::MissingAsset::IsAnError};
}

Result<LoadedPreset> loadFile(FxContext& context, const char* path)
{
    FxAssetHook hook = context.def.assets;
    if (hook.open && fx::asset::checkAssetName(path).ok() &&
        !std::string_view(path).starts_with(kLibraryPrefix)) {
        const fx::asset::AssetResolver resolver("", fx::preset::libraryFiles(), {&hook, &readThroughHook});
        Result<LoadedPreset> loaded = fx::preset::loadPresetAsset(path, resolver, nullptr, assetsOf(context),
                                                                  context.techniques.presets);
        if (loaded.ok() || loaded.status().code() != Code::NotFound)
            return loaded;
    }
    return fx::preset::loadPresetFile(path, nullptr, assetsOf(context), context.techniques.presets);
}

Status checkLength(size_t length)
{
    if (length == 0)
        return fx::api::invalid("length is 0");
    if (length > fx::preset::kPresetBytes)
        return {Code::TooLarge, "length is " + std::to_string(length) + "; a preset has at most " +
                                    std::to_string(fx::preset::kPresetBytes) + " bytes"};
    return {};
}

/// Loads a text with the files that loadFile() finds for a preset at `path`.
Result<LoadedPreset> loadTextAt(FxContext& context, std::string_view text, const std::string& path)
{
    FxAssetHook hook = context.def.assets;
    const bool isInLibrary = path.starts_with(kLibraryPrefix);
    const bool isHooked = hook.open && !isInLibrary && fx::asset::checkAssetName(path).ok();
    const std::string folder = isInLibrary ? std::string() : fx::preset::folderOf(path);
    const std::string root = isInLibrary ? std::string() : folder.empty() || isHooked ? "." : folder;
    const fx::asset::AssetResolver resolver(root, fx::preset::libraryFiles(),
                                            isHooked ? fx::asset::ReadHook{&hook, &readThroughHook}
                                                     : fx::asset::ReadHook{});
    return fx::preset::loadPresetText(text, path, nullptr, &resolver, assetsOf(context),
                                      isHooked ? folder : std::string(), context.techniques.presets);
}

uint64_t capacityOf(const fx::sim::EffectDef& effect)
{
    uint64_t sum = 0;
    for (const auto& solver : effect.solvers)
        sum += solver->capacity();
    return sum;
}

} // namespace

FxResult fxLoadPresetFile(FxContext* context, const char* path, FxPresetId* outPreset)
{
    return fx::api::guarded("fxLoadPresetFile", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkLoad(context, path, "path", outPreset); !status)
            return status;
        return loadInto(context, path, outPreset, [&] { return loadFile(*context, path); });
    });
}

FxResult fxLoadPresetText(FxContext* context, const char* text, size_t length, const char* displayName,
                          FxPresetId* outPreset)
{
    return fx::api::guarded("fxLoadPresetText", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkLoad(context, text, "text", outPreset); !status)
            return status;
        if (Status status = checkLength(length); !status)
            return status;
        const char* const name = displayName ? displayName : "preset text";
        return loadInto(context, name, outPreset, [&] {
            return fx::preset::loadPresetText({text, length}, name, nullptr, nullptr, assetsOf(*context), {},
                                              context->techniques.presets);
        });
    });
}

FxResult fxLoadPresetTextAt(FxContext* context, const char* text, size_t length, const char* path,
                            FxPresetId* outPreset)
{
    return fx::api::guarded("fxLoadPresetTextAt", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkLoad(context, text, "text", outPreset); !status)
            return status;
        if (!path)
            return fx::api::invalid("path is null");
        if (Status status = checkLength(length); !status)
            return status;
        return loadInto(context, path, outPreset, [&] { return loadTextAt(*context, {text, length}, path); });
    });
}

FxResult fxLoadPresetLibrary(FxContext* context, const char* name, FxPresetId* outPreset)
{
    return fx::api::guarded("fxLoadPresetLibrary", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkLoad(context, name, "name", outPreset); !status)
            return status;
        std::string full(name);
        if (!full.starts_with(kLibraryPrefix))
            full.insert(0, kLibraryPrefix);
        return loadInto(context, full, outPreset, [&] {
            const fx::asset::AssetResolver library("", fx::preset::libraryFiles());
            return fx::preset::loadPresetAsset(full, library, nullptr, assetsOf(*context),
                                               context->techniques.presets);
        });
    });
}

FxResult fxUnloadPreset(FxContext* context, FxPresetId preset)
{
    return fx::api::guarded("fxUnloadPreset", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        Result<std::shared_ptr<const fx::sim::EffectDef>> keep = context->findPreset(preset);
        if (!keep)
            return keep.status();
        const fx::api::SharedCaller::Scope tables(
            context->tables); // `keep` makes the preset end outside the lock
        if (!tables.status())
            return tables.status();
        const fx::scene::LocalId id = context->ids.decode(preset.bits, fx::api::kPresetIdType);
        if (!context->presets.find(id))
            return {Code::StaleId, "preset was unloaded by another thread"};
        context->presets.remove(id);
        return {};
    });
}

FxResult fxGetPresetInfo(FxContext* context, FxPresetId preset, FxPresetInfo* ioInfo)
{
    return fx::api::guarded("fxGetPresetInfo", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        const Result<std::shared_ptr<const fx::sim::EffectDef>> effect = context->findPreset(preset);
        if (!effect)
            return effect.status();
        FxPresetInfo info{};
        info.solverCount = uint32_t((*effect)->solvers.size());
        info.durationTicks = (*effect)->duration;
        info.capacity = capacityOf(**effect);
        info.memoryBytes = (*effect)->cost.memory;
        info.stepWork = uint64_t(std::min((*effect)->cost.stepWork, kMaxWork));
        info.startWork = uint64_t(std::min((*effect)->cost.startWork, kMaxWork));
        info.cueCount = uint32_t((*effect)->cues.size());
        fx::api::copyText((*effect)->name, info.name, sizeof info.name);
        return fx::api::writeStruct(info, ioInfo, "ioInfo");
    });
}

FxResult fxGetPresetCue(FxContext* context, FxPresetId preset, uint32_t cue, FxPresetCue* ioCue)
{
    return fx::api::guarded("fxGetPresetCue", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        const Result<std::shared_ptr<const fx::sim::EffectDef>> effect = context->findPreset(preset);
        if (!effect)
            return effect.status();
        if (cue >= (*effect)->cues.size())
            return fx::api::invalid("the preset has " + std::to_string((*effect)->cues.size()) +
                                    " cues, and none of this index");
        FxPresetCue out{};
        out.cue = cue;
        fx::api::copyText((*effect)->cues[cue], out.name, sizeof out.name);
        return fx::api::writeStruct(out, ioCue, "ioCue");
    });
}

FxResult fxFindPresetCue(FxContext* context, FxPresetId preset, const char* name, uint32_t* outCue)
{
    return fx::api::guarded("fxFindPresetCue", fx::api::logOf(context), [&]() -> Status {
        fx::api::Checks check;
        check.notNull(context, "context");
        check.notNull(name, "name");
        check.notNull(outCue, "outCue");
        if (!check.status())
            return check.status();
        const Result<std::shared_ptr<const fx::sim::EffectDef>> effect = context->findPreset(preset);
        if (!effect)
            return effect.status();
        const std::vector<std::string>& cues = (*effect)->cues;
        const auto found = std::find(cues.begin(), cues.end(), name);
        if (found == cues.end())
            return {Code::NotFound,
                    "the preset has no cue \"" + std::string(name) + "\"" + fx::base::didYouMean(name, cues)};
        *outCue = uint32_t(found - cues.begin());
        return {};
    });
}
