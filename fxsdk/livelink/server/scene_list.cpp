#include "fxsdk/livelink/server/scene_list.h"

#include "fxsdk/fx_preset.h"
#include "fxsdk/fx_reload.h"
#include "fxsdk/livelink/server/preset_worker.h"

#include <algorithm>

namespace fx::link {

namespace {

using Json = nlohmann::json;

const char* stateName(uint32_t state)
{
    switch (state) {
    case FX_INSTANCE_DORMANT:
        return "dormant";
    case FX_INSTANCE_ACTIVE:
        return "active";
    case FX_INSTANCE_FINISHED:
        return "finished";
    case FX_INSTANCE_WAKING:
        return "waking";
    case FX_INSTANCE_RESTING:
        return "resting";
    case FX_INSTANCE_HIDDEN:
        return "hidden";
    default:
        return "unknown";
    }
}

std::vector<FxInstanceId> instancesOf(FxScene* scene)
{
    uint32_t count = 0;
    if (fxScene_GetInstances(scene, nullptr, 0, &count) != FX_OK)
        return {};
    std::vector<FxInstanceId> ids(count);
    if (count > 0 && fxScene_GetInstances(scene, ids.data(), count, &count) != FX_OK)
        return {};
    ids.resize(count);
    return ids;
}

Json describe(FxContext* context, FxPresetId id)
{
    FxPresetInfo info{};
    info.structSize = sizeof info;
    const bool isLoaded = fxGetPresetInfo(context, id, &info) == FX_OK;
    return {{"source", sourceOf(context, id)},
            {"name", isLoaded ? info.name : ""},
            {"capacity", isLoaded ? info.capacity : 0},
            {"instances", 0}};
}

} // namespace

Json sceneList(uint64_t id, FxContext* context, const std::vector<FxPresetId>& presets,
               std::span<FxScene* const> scenes)
{
    Json list{{"type", "list"}, {"id", id}, {"presets", Json::array()}, {"instances", Json::array()}};
    for (size_t i = 0; i < std::min(presets.size(), kListedPresets); ++i)
        list["presets"].push_back(describe(context, presets[i]));
    uint64_t count = 0;
    for (size_t scene = 0; scene < scenes.size(); ++scene) {
        const std::vector<FxInstanceId> instances = instancesOf(scenes[scene]);
        count += instances.size();
        for (const FxInstanceId instance : instances) {
            FxInstanceInfo info{};
            info.structSize = sizeof info;
            if (list["instances"].size() >= kListedInstances ||
                fxScene_GetInstanceInfo(scenes[scene], instance, &info) != FX_OK)
                break;
            const auto found = std::find_if(presets.begin(), presets.end(), [&](FxPresetId preset) {
                return preset.bits == info.preset.bits;
            });
            const auto index = size_t(found - presets.begin());
            const bool isListed = index < list["presets"].size();
            if (isListed)
                list["presets"][index]["instances"] = list["presets"][index]["instances"].get<uint64_t>() + 1;
            list["instances"].push_back({{"scene", scene},
                                         {"preset", isListed ? Json(index) : Json()},
                                         {"state", stateName(info.state)},
                                         {"seconds", info.localSeconds},
                                         {"particles", info.particles},
                                         {"position", info.position}});
        }
    }
    list["instanceCount"] = count;
    return list;
}

} // namespace fx::link
