// The functions of fx_reserve.h.
#include "fxsdk/fx_reserve.h"

#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

#include <algorithm>
#include <string>

namespace {

using fx::base::Status;

constexpr uint32_t kMostReserved = 65'536;

} // namespace

void FxContext::noticePresets()
{
    for (FxScene* const scene : scenes)
        scene->notices.fetch_or(FxScene::kPresetsChanged);
}

Status FxScene::reserve(FxPresetId preset, const std::shared_ptr<const fx::sim::EffectDef>& effect,
                        fx::sim::QualityLevel level, uint32_t count)
{
    const auto isIt = [&](const ReservedPreset& one) { return one.effect == effect && one.level == level; };
    reserved.reserve(reserved.size() + 1); // push_back() must not fail
    if (Status status = scene.reserve(effect, level, count); !status)
        return status;
    std::erase_if(reserved, isIt);
    if (count > 0)
        reserved.push_back({preset, effect, level, count});
    return {};
}

void FxScene::followPresets()
{
    for (size_t i = 0; i < reserved.size();) {
        const ReservedPreset one = reserved[i];
        const auto now = context->findPreset(one.preset);
        if (now && *now == one.effect) {
            ++i;
            continue;
        }
        static_cast<void>(reserve(one.preset, one.effect, one.level, 0)); // frees; nothing to fail
        if (!now)
            continue;
        const Status status = reserve(one.preset, *now, one.level, one.count);
        if (!status)
            fx::api::logMessage(
                *context, FX_LOG_WARNING,
                ("the reservation of a redirected preset has ended: " + std::string(status.message()))
                    .c_str());
    }
}

FxResult fxScene_ReservePreset(FxScene* scene, FxPresetId preset, uint32_t quality, uint32_t count)
{
    return fx::api::insideScene("fxScene_ReservePreset", scene, [&]() -> Status {
        fx::api::Checks check;
        fx::api::checkQuality(check, quality, "quality");
        check.range(count, 0u, std::min(kMostReserved, scene->maxInstances), "count");
        if (!check.status())
            return check.status();
        const auto effect = scene->context->findPreset(preset);
        if (!effect)
            return effect.status();
        return scene->reserve(preset, *effect, fx::api::toQuality(quality, scene->quality), count);
    });
}

FxResult fxScene_GetReservation(FxScene* scene, FxPresetId preset, uint32_t quality,
                                FxReservationInfo* ioInfo)
{
    return fx::api::insideScene("fxScene_GetReservation", scene, [&]() -> Status {
        fx::api::Checks check;
        fx::api::checkQuality(check, quality, "quality");
        if (!check.status())
            return check.status();
        const auto effect = scene->context->findPreset(preset);
        if (!effect)
            return effect.status();
        const fx::sim::QualityLevel level = fx::api::toQuality(quality, scene->quality);
        FxReservationInfo info{};
        if (const auto found = scene->scene.reservation(**effect, level)) {
            info.count = found->count;
            info.available = found->idle;
            info.bytes = found->bytes;
            info.misses = found->misses;
        }
        return fx::api::writeStruct(info, ioInfo, "ioInfo");
    });
}
