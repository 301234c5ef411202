// The functions of fx_reserve.h.
#include "fxsdk/fx_reserve.h"

#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace {

using fx::base::Status;

constexpr uint32_t kMostReserved = 65'536;

} // namespace

void FxContext::noticePresets()
{
    for (FxScene* const scene : scenes)
        scene->notices.fetch_or(FxScene::kPresetsChanged);
}

uint32_t FxScene::reservedInstances(const fx::sim::EffectDef& effect, fx::sim::QualityLevel level,
                                    uint64_t more) const
{
    for (const ReservedPreset& one : reserved)
        more += one.effect.get() == &effect && one.level == level ? one.count : 0;
    return uint32_t(std::min<uint64_t>(more, maxInstances));
}

Status FxScene::reserve(FxPresetId preset, const std::shared_ptr<const fx::sim::EffectDef>& effect,
                        fx::sim::QualityLevel level, uint32_t count)
{
    reserved.reserve(reserved.size() + 1); // push_back() must not fail
    const auto isOf = [&](const ReservedPreset& one) {
        return one.preset.bits == preset.bits && one.level == level;
    };
    const auto found = std::find_if(reserved.begin(), reserved.end(), [&](const ReservedPreset& one) {
        return isOf(one) && one.effect == effect;
    });
    const uint32_t before = found != reserved.end() ? std::exchange(found->count, 0) : 0;
    const uint32_t all = reservedInstances(*effect, level, count);
    if (found != reserved.end())
        found->count = before;
    if (Status status = scene.reserve(effect, level, all); !status)
        return status;
    if (found != reserved.end())
        reserved.erase(found);
    for (ReservedPreset& one : reserved)
        if (isOf(one))
            one.count = 0; // of the content before a redirection, which followPresets() will end
    if (count > 0)
        reserved.push_back({preset, effect, level, count});
    return {};
}

/// Lets one reservation follow its preset. If memory runs out, the call can be repeated.
/// @return false: the reservation has ended
bool FxScene::followPreset(ReservedPreset& one)
{
    const auto now = context->findPreset(one.preset);
    if (now && *now == one.effect && one.count > 0)
        return true;
    const uint32_t count = std::exchange(one.count, 0);
    const uint32_t others = reservedInstances(*one.effect, one.level);
    one.count = count;
    static_cast<void>(scene.reserve(one.effect, one.level, others)); // fewer never exceed the limit
    if (!now || count == 0)
        return false;
    const Status status = scene.reserve(*now, one.level, reservedInstances(**now, one.level, count));
    if (status)
        one.effect = *now;
    else
        fx::api::logMessage(
            *context, FX_LOG_WARNING,
            ("the reservation of a redirected preset has ended: " + std::string(status.message())).c_str());
    return status.ok();
}

void FxScene::followPresets()
{
    try {
        for (size_t i = 0; i < reserved.size();)
            if (followPreset(reserved[i]))
                ++i;
            else
                reserved.erase(reserved.begin() + std::ptrdiff_t(i));
    } catch (...) {
        notices.fetch_or(kPresetsChanged); // the next update goes on
        throw;
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
