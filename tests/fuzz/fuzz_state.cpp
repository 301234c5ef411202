// Saved states: bytes behind a header whose check sum is repaired, so that they reach the readers of the
// solvers.
#include "fxsdk/scene/state_envelope.h"
#include "tests/fuzz/fuzz_host.h"

namespace fx::fuzz {

namespace {

using State = std::vector<std::byte>;

constexpr double kFrame = 1.0 / 60.0; ///< [s]

/// A scene with every small preset in it, some shared, some waiting, one gone.
class PlayedScene
{
public:
    PlayedScene()
    {
        const FxContextDef def = host_.contextDef();
        require(checked(fxCreateContext(&def, &context_)) == FX_OK, "a context can be created");
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        require(checked(fxCreateScene(context_, &sceneDef, &scene_)) == FX_OK, "a scene can be created");
        for (const std::string_view text : smallPresets()) {
            FxInstanceDef instance = fxDefaultInstanceDef();
            require(checked(fxLoadPresetText(context_, text.data(), text.size(), "small",
                                             &instance.preset)) == FX_OK,
                    "the small presets are valid", fxGetLastErrorMessage());
            FxInstanceId id{};
            require(checked(fxScene_CreateInstance(scene_, &instance, &id)) == FX_OK,
                    "a small preset can be placed");
            instance.position[0] = 3.0;
            checked(fxScene_CreateInstance(scene_, &instance, &id));
            instance.startTick = FX_TICKS_PER_SECOND;
            checked(fxScene_CreateInstance(scene_, &instance, &id));
        }
        play(20);
        base_ = saved();
    }
    ~PlayedScene() { checked(fxDestroyContext(context_)); }
    PlayedScene(const PlayedScene&) = delete;
    PlayedScene& operator=(const PlayedScene&) = delete;

    const State& base() const { return base_; } ///< as it was saved at first
    FxResult restore(const State& state)
    {
        return checked(fxScene_RestoreState(scene_, state.data(), state.size()));
    }
    void play(int frames)
    {
        for (int frame = 0; frame < frames; ++frame)
            checked(fxScene_Update(scene_, kFrame));
    }
    uint64_t hash()
    {
        uint64_t hash = 0;
        require(checked(fxScene_GetSimulationHash(scene_, &hash)) == FX_OK, "a simulation has a hash");
        return hash;
    }
    State saved()
    {
        size_t size = 0;
        require(checked(fxScene_SaveState(scene_, nullptr, 0, &size)) == FX_OK, "a state has a size");
        State state(size);
        require(checked(fxScene_SaveState(scene_, state.data(), size, &size)) == FX_OK,
                "a scene can be saved");
        return state;
    }

private:
    FuzzHost host_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    State base_;
};

/// One for all inputs, since loading its presets takes longer than an input.
PlayedScene& playedScene()
{
    static PlayedScene scene;
    return scene;
}

} // namespace

void runInput(std::span<const uint8_t> input)
{
    PlayedScene& scene = playedScene();
    require(scene.restore(scene.base()) == FX_OK, "the scene's own state can be restored",
            fxGetLastErrorMessage());
    State state(scene::kStateHeaderBytes + input.size());
    if (!input.empty())
        std::memcpy(state.data() + scene::kStateHeaderBytes, input.data(), input.size());
    scene::writeStateHeader(std::span<const std::byte>(state).subspan(scene::kStateHeaderBytes), FX_VERSION,
                            state.data());
    const uint64_t before = scene.hash();
    if (scene.restore(state) != FX_OK) {
        require(scene.hash() == before, "a refused state changes nothing", fxGetLastErrorMessage());
        return;
    }
    const uint64_t restored = scene.hash();
    const State again = scene.saved();
    scene.play(2);
    require(scene.restore(again) == FX_OK, "a state that was saved can be restored", fxGetLastErrorMessage());
    require(scene.hash() == restored, "a restored state is the one that was saved");
}

std::vector<std::string> seeds()
{
    const PlayedScene& scene = playedScene();
    const auto inside = std::span<const std::byte>(scene.base()).subspan(scene::kStateHeaderBytes);
    const std::string state(reinterpret_cast<const char*>(inside.data()), inside.size());
    return {state, state.substr(0, state.size() / 2), ""};
}

} // namespace fx::fuzz
