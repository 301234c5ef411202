// The functions of fx_reload.h that replace, redirect and list. fxLoadPresetTextAt is in
// preset_functions.cpp.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_reload.h"

#include <string>

namespace {

using fx::base::Code;
using fx::base::Status;
using Effect = std::shared_ptr<const fx::sim::EffectDef>;

/// The preset with this effect; 0 if it is not loaded.
FxPresetId idOf(FxContext& context, const Effect& effect)
{
    const fx::api::SharedCaller::Scope tables(context.tables);
    FxPresetId found{};
    if (tables.status().ok())
        context.presets.forEach([&](uint32_t index, const fx::api::HeldPreset& one) {
            if (found.bits == 0 && one.effect == effect)
                found.bits = context.ids.encode(context.presets.idAt(index), fx::api::kPresetIdType);
        });
    return found;
}

} // namespace

FxResult fxScene_ReplacePreset(FxScene* scene, FxPresetId oldPreset, FxPresetId newPreset, uint32_t mode,
                               uint32_t* outCount)
{
    return fx::api::insideScene("fxScene_ReplacePreset", scene, [&]() -> Status {
        if (mode != FX_REPLACE_SEEK && mode != FX_REPLACE_RESTART)
            return fx::api::invalid("mode is no FxReplaceMode");
        const auto from = scene->context->findPreset(oldPreset);
        if (!from)
            return {from.status().code(), "oldPreset names no loaded preset of the context of the scene"};
        const auto to = scene->context->findPreset(newPreset);
        if (!to)
            return {to.status().code(), "newPreset names no loaded preset of the context of the scene"};
        const uint32_t count = scene->scene.replace(
            **from, *to,
            mode == FX_REPLACE_SEEK ? fx::scene::Replacement::Seek : fx::scene::Replacement::Restart);
        if (outCount)
            *outCount = count;
        return {};
    });
}

FxResult fxRedirectPreset(FxContext* context, FxPresetId preset, FxPresetId target)
{
    return fx::api::guarded("fxRedirectPreset", fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        const auto effect = context->findPreset(target);
        if (!effect)
            return {effect.status().code(), "target names no loaded preset of this context"};
        Effect before; // ends outside of the lock
        const fx::api::SharedCaller::Scope tables(context->tables);
        if (!tables.status())
            return tables.status();
        fx::api::HeldPreset* const entry =
            context->presets.find(context->ids.decode(preset.bits, fx::api::kPresetIdType));
        if (!entry)
            return {Code::StaleId, "preset names no loaded preset of this context"};
        before = std::move(entry->effect);
        entry->effect = *effect;
        context->noticePresets();
        return {};
    });
}

FxResult fxGetPresets(FxContext* context, FxPresetId* outPresets, uint32_t capacity, uint32_t* outCount)
{
    return fx::api::guarded("fxGetPresets", fx::api::logOf(context), [&]() -> Status {
        fx::api::Checks check;
        check.notNull(context, "context");
        check.notNull(outCount, "outCount");
        if (!check.status())
            return check.status();
        const fx::api::SharedCaller::Scope tables(context->tables);
        if (!tables.status())
            return tables.status();
        const uint32_t count = context->presets.count();
        if (outPresets && capacity < count)
            return {Code::Capacity, "the context has " + std::to_string(count) + " presets"};
        if (outPresets)
            context->presets.forEach([&, next = outPresets](uint32_t index,
                                                            const fx::api::HeldPreset&) mutable {
                (next++)->bits = context->ids.encode(context->presets.idAt(index), fx::api::kPresetIdType);
            });
        *outCount = count;
        return {};
    });
}

FxResult fxGetPresetSource(FxContext* context, FxPresetId preset, char* buffer, size_t capacity,
                           size_t* outSize)
{
    return fx::api::guarded("fxGetPresetSource", fx::api::logOf(context), [&]() -> Status {
        fx::api::Checks check;
        check.notNull(context, "context");
        check.notNull(outSize, "outSize");
        if (!check.status())
            return check.status();
        const fx::api::SharedCaller::Scope tables(context->tables);
        if (!tables.status())
            return tables.status();
        const fx::api::HeldPreset* const held =
            context->presets.find(context->ids.decode(preset.bits, fx::api::kPresetIdType));
        if (!held)
            return {Code::StaleId, "preset names no loaded preset of this context"};
        const std::string& source = held->source;
        const size_t size = source.size() + 1;
        if (buffer && capacity < size)
            return {Code::Capacity, "the source takes " + std::to_string(size) + " bytes, the buffer has " +
                                        std::to_string(capacity)};
        if (buffer)
            std::copy_n(source.c_str(), size, buffer);
        *outSize = size;
        return {};
    });
}

FxResult fxScene_GetInstanceInfo(FxScene* scene, FxInstanceId instance, FxInstanceInfo* ioInfo)
{
    return fx::api::withInstance(
        "fxScene_GetInstanceInfo", scene, instance, [&](fx::scene::LocalId id) -> Status {
            FxInstanceInfo info{};
            info.preset = idOf(*scene->context, scene->scene.effectOf(id));
            scene->context->world.writePosition(scene->scene.placementOf(id).position, info.position);
            info.localSeconds = fx::base::toSeconds(scene->scene.localTime(id));
            info.particles = scene->scene.particles(id);
            info.state = uint32_t(scene->scene.state(id));
            return fx::api::writeStruct(info, ioInfo, "ioInfo");
        });
}
