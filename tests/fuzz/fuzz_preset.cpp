// Presets (*.fx.json): loaded through the C API, and what loads is played for some frames.
#include "fxsdk/presets/preset_loader.h"
#include "tests/fuzz/fuzz_host.h"

#include <string>

namespace fx::fuzz {

namespace {

constexpr double kFrame = 1.0 / 60.0; ///< [s]
constexpr int kFrames = 4;
constexpr uint64_t kMaxCapacity = 4096; ///< particles of a preset that is played
constexpr uint64_t kMaxWork = 40'000;   ///< work units of playing it, a fraction of a second in a slow build

/// State hash after some frames with the loops of the host cut and ordered in one way.
uint64_t play(std::string_view text, bool reversesLoops)
{
    FuzzHost host;
    host.reversesLoops = reversesLoops;
    const FxContextDef def = host.contextDef();
    FxContext* context = nullptr;
    require(checked(fxCreateContext(&def, &context)) == FX_OK, "a context can be created");
    FxInstanceDef instance = fxDefaultInstanceDef();
    require(checked(fxLoadPresetText(context, text.data(), text.size(), "again", &instance.preset)) == FX_OK,
            "a preset that loaded once loads again", fxGetLastErrorMessage());
    FxScene* scene = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    require(checked(fxCreateScene(context, &sceneDef, &scene)) == FX_OK, "a scene can be created");
    FxInstanceId id{};
    require(checked(fxScene_CreateInstance(scene, &instance, &id)) == FX_OK, "a loaded preset can be placed",
            fxGetLastErrorMessage());
    for (int frame = 0; frame < kFrames; ++frame)
        require(checked(fxScene_Update(scene, kFrame)) == FX_OK, "a placed preset can be updated");
    uint64_t hash = 0;
    require(checked(fxScene_GetStateHash(scene, &hash)) == FX_OK, "a state has a hash");
    require(checked(fxDestroyContext(context)) == FX_OK, "a context can be destroyed");
    require(host.blocks() == 0, "a destroyed context holds no memory");
    return hash;
}

/// Whether the preset is played; a heavy one takes longer than an input may.
bool isLight(FxContext* context, FxPresetId preset)
{
    FxPresetInfo info{};
    info.structSize = sizeof info;
    require(checked(fxGetPresetInfo(context, preset, &info)) == FX_OK, "a loaded preset has properties");
    return info.capacity <= kMaxCapacity && info.solverCount <= 8 && info.startWork <= kMaxWork &&
           info.stepWork <= (kMaxWork - info.startWork) / kFrames;
}

} // namespace

void runInput(std::span<const uint8_t> input)
{
    const std::string_view text = textOf(input);
    FuzzHost host;
    const FxContextDef def = host.contextDef();
    FxContext* context = nullptr;
    require(checked(fxCreateContext(&def, &context)) == FX_OK, "a context can be created");
    FxPresetId preset{};
    const FxResult result = checked(fxLoadPresetText(context, text.data(), text.size(), "input", &preset));
    require((result == FX_OK) == (preset.bits != 0), "only a loaded preset has an id");
    const bool plays = result == FX_OK && isLight(context, preset);
    require(checked(fxDestroyContext(context)) == FX_OK, "a context can be destroyed");
    require(host.blocks() == 0, "a destroyed context holds no memory");
    if (plays)
        require(play(text, false) == play(text, true),
                "the cut and the order of loops do not change a state");
}

std::vector<std::string> seeds()
{
    std::vector<std::string> all(smallPresets().begin(), smallPresets().end());
    for (const base::EmbeddedText& preset : preset::presetLibrary())
        all.emplace_back(preset.text);
    all.push_back("");
    all.push_back("{\"version\": 1, \"emitters\": [");
    return all;
}

} // namespace fx::fuzz
