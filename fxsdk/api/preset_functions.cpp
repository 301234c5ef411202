// The functions of fx_preset.h, and the one of fx_reload.h that loads.
#include "foundation/result/nearest_name.h"
#include "fxsdk/api/check.h"
#include "fxsdk/api/context.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/preset_loading.h"
#include "fxsdk/api/text.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_reload.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <string>

namespace {

using fx::base::Code;
using fx::base::Result;
using fx::base::Status;

constexpr double kMaxWork = 1e18; ///< [unit] largest reported value

Status checkLoad(const FxContext* context, const void* text, const char* textName,
                 const FxPresetId* outPreset)
{
    fx::api::Checks check;
    check.notNull(context, "context");
    check.notNull(text, textName);
    check.notNull(outPreset, "outPreset");
    return check.status();
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
        if (std::string_view(path).starts_with(fx::api::kLibraryPrefix))
            return fx::api::loadLibraryPreset(*context, path, nullptr, *outPreset);
        return fx::api::loadPreset(*context, {path, {}, false}, nullptr, *outPreset);
    });
}

FxResult fxLoadPresetText(FxContext* context, const char* text, size_t length, const char* displayName,
                          FxPresetId* outPreset)
{
    return fx::api::guarded("fxLoadPresetText", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkLoad(context, text, "text", outPreset); !status)
            return status;
        if (Status status = fx::api::checkPresetLength(length); !status)
            return status;
        return fx::api::loadPresetText(*context, {text, length}, displayName ? displayName : "preset text",
                                       *outPreset);
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
        if (Status status = fx::api::checkPresetLength(length); !status)
            return status;
        return fx::api::loadPreset(*context, {path, {text, length}, true}, nullptr, *outPreset);
    });
}

FxResult fxLoadPresetLibrary(FxContext* context, const char* name, FxPresetId* outPreset)
{
    return fx::api::guarded("fxLoadPresetLibrary", fx::api::logOf(context), [&]() -> Status {
        if (Status status = checkLoad(context, name, "name", outPreset); !status)
            return status;
        std::string full(name);
        if (!full.starts_with(fx::api::kLibraryPrefix))
            full.insert(0, fx::api::kLibraryPrefix);
        return fx::api::loadLibraryPreset(*context, full, nullptr, *outPreset);
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
        context->noticePresets();
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

FxResult fxGetPresetPreview(FxContext* context, FxPresetId preset, FxPresetPreview* ioPreview)
{
    return fx::api::guarded("fxGetPresetPreview", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        const Result<std::shared_ptr<const fx::sim::EffectDef>> effect = context->findPreset(preset);
        if (!effect)
            return effect.status();
        const fx::sim::PreviewDef& preview = (*effect)->preview;
        FxPresetPreview out{};
        out.exposureEv100 = preview.exposureEv100;
        out.groundAlbedo = preview.groundAlbedo;
        out.time = preview.seconds;
        out.hasCamera = preview.hasCamera ? 1 : 0;
        out.fovY = glm::radians(preview.fovYDegrees);
        for (int k = 0; k < 3; ++k) {
            out.sunIlluminance[k] = preview.sunIlluminance[k];
            out.skyLuminance[k] = preview.skyLuminance[k];
        }
        context->world.writeDirection(preview.sunDirection, out.sunDirection);
        context->world.writePosition(preview.cameraPosition, out.cameraPosition);
        context->world.writePosition(preview.cameraTarget, out.cameraTarget);
        return fx::api::writeStruct(out, ioPreview, "ioPreview");
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
