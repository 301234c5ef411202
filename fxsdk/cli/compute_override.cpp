#include "fxsdk/cli/compute_override.h"

#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/api_status.h"
#include "fxsdk/presets/preset_loader.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <string_view>

namespace fx::cli {
namespace {

constexpr const char* kReplaced = "replaced.fx.json"; ///< what the library asks the hook for

std::string withCompute(const std::string& text, const std::string& compute)
{
    nlohmann::ordered_json preset = nlohmann::ordered_json::parse(text); // it has been loaded once before
    if (preset.contains("emitters"))
        for (nlohmann::ordered_json& emitter : preset["emitters"])
            emitter["compute"] = compute;
    return preset.dump();
}

FxResult loadAsItIs(FxContext* context, const scene_file::ScenePreset& preset, FxPresetId& out)
{
    return preset.file.empty()
               ? fxLoadPresetText(context, preset.text.data(), preset.text.size(), preset.name.c_str(), &out)
               : fxLoadPresetFile(context, preset.file.c_str(), &out);
}

std::string_view obstacleIfAsked(const sim::EmitterDef& emitter)
{
    sim::EmitterDef asked = emitter;
    asked.compute = sim::ComputeOn::Gpu;
    return sim::gpuObstacle(asked);
}

} // namespace

std::string gpuObstacleOf(const scene_file::SceneFile& scene)
{
    for (const scene_file::ScenePreset& preset : scene.presets)
        for (const sim::EmitterDef* const emitter : sim::emittersOf(*preset.effect)) {
            const std::string_view why = emitter ? obstacleIfAsked(*emitter) : "it is no emitter";
            if (!why.empty())
                return preset.name + (emitter ? ", emitter " + emitter->name : std::string()) + ": " +
                       std::string(why);
        }
    return {};
}

FxAssetHook ComputeOverride::hook()
{
    if (compute_.empty())
        return {};
    return {this, &open, &close};
}

/// Files beside the preset come through here as well.
const void* ComputeOverride::open(void* user, const char* name, size_t* outSize)
{
    const auto& self = *static_cast<const ComputeOverride*>(user);
    auto bytes = std::string_view(name) == kReplaced
                     ? base::Result<std::string>(self.text_)
                     : asset::readFile(self.folder_ + name, scene_file::kImageBytes);
    if (!bytes.ok())
        return nullptr;
    *outSize = bytes->size();
    auto copy = std::make_unique_for_overwrite<char[]>(bytes->size() + 1); // never null
    std::copy(bytes->begin(), bytes->end(), copy.get());
    return copy.release();
}

void ComputeOverride::close(void*, const void* data, size_t)
{
    delete[] static_cast<const char*>(data);
}

base::Result<FxPresetId> ComputeOverride::load(FxContext* context, const scene_file::ScenePreset& preset)
{
    FxPresetId id = {};
    FxResult result = FX_OK;
    if (compute_.empty())
        result = loadAsItIs(context, preset, id);
    else {
        text_ = withCompute(preset.text, compute_);
        folder_ = preset::folderOf(preset.file);
        result = preset.file.empty()
                     ? fxLoadPresetText(context, text_.data(), text_.size(), preset.name.c_str(), &id)
                     : fxLoadPresetFile(context, kReplaced, &id);
    }
    if (result != FX_OK)
        return toStatus(result);
    return id;
}

} // namespace fx::cli
