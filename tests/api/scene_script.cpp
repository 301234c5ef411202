#include "tests/api/scene_script.h"

#include "fxsdk/assets/volume_file.h"
#include "simulation/cloud/ball_list.h"
#include "tests/api/api_fixture.h"
#include "tests/presets/temp_folder.h"

#include <string>

namespace fx::test {

namespace {

/// So few that many instances share their rows.
constexpr const char* kSparks = R"({"version": 1, "name": "sparks", "ground": false, "emitters": [{
    "maxParticles": 16, "shape": "sphere", "size": 0.5, "emission": {"rate": 20}, "lifetime": 0.5,
    "speed": 2, "radius": 0.25, "appearance": {"kind": "sprite"}}]})";

/// So many that loops over them are cut into ranges.
constexpr const char* kSwarm = R"({"version": 1, "name": "swarm", "ground": false, "emitters": [{
    "maxParticles": 12000, "shape": "sphere", "size": 2, "emission": {"bursts": [{"time": 0, "count": 9000}]},
    "lifetime": 3, "radius": 0.05, "forces": {"drag": 0.5, "curlStrength": 1, "curlScale": 2},
    "collisions": [{"shape": "plane", "position": [0, -1, 0], "bounce": 0.5}],
    "appearance": {"kind": "sprite", "order": "depth"}}]})";

/// Views compute it where they can; readers of snapshots get its rows all the same.
constexpr const char* kFlakes = R"({"version": 1, "name": "flakes", "emitters": [{
    "compute": "gpu", "shape": "sphere", "size": 1, "position": [0, 2, 0], "emission": {"rate": 200},
    "lifetime": {"min": 0.3, "max": 0.8}, "radius": 0.03, "maxParticles": 300,
    "forces": {"drag": 2, "curlStrength": 1}, "appearance": {"kind": "sprite", "order": "depth"}}]})";

/// A gas of enough parcels for loops of several ranges, where there are gases.
std::string gasPreset()
{
    const std::string gas = kHasGas ? R"("gas": [{"particles": 400, "dissipation": 0}],)" : "";
    return R"({"version": 1, "name": "gas", "duration": 0.4, )" + gas + R"("emitters": [{"maxParticles": 64,
        "shape": "sphere", "size": 0.5, "emission": {"rate": 40}, "lifetime": 0.3, "radius": 0.25}]})";
}

/// Voxels and balls of four frames, which are read from files, by a thread of their own too.
FxPresetId playedPreset(FxContext* context)
{
    const TempFolder folder;
    for (int frame = 0; frame < 4; ++frame) {
        base::VoxelVolume volume;
        volume.side = 0.25f;
        volume.bricks = {{1 + frame % 2, 1, 1}};
        volume.extinction.assign(base::kVolumeBrickVoxels, 0.5f);
        volume.velocity.assign(base::kVolumeBrickVoxels, glm::vec3(20.0f, 0.0f, 0.0f));
        folder.write("v." + std::to_string(frame) + ".fxvolume", *asset::writeVolume(volume));
        sim::MovingBalls balls(2); // one of them is in every other frame only
        for (size_t i = 0; i < 2; ++i) {
            balls[i].ball.center = {float(frame) * 0.5f, float(i), 0.0f};
            balls[i].ball.crossSection = 1.0f;
            balls[i].velocity.x = 5.0f;
            balls[i].number = i;
        }
        balls.resize(size_t(1 + frame % 2));
        folder.write("b." + std::to_string(frame) + ".fxballs", sim::writeMovingBalls(balls));
    }
    const std::string path = folder.write("played.fx.json", R"({"version": 1, "name": "played",
        "volumes": [{"file": "v.%d.fxvolume", "frames": 4, "framesPerSecond": 10, "end": "loop"}],
        "clouds": [{"file": "b.%d.fxballs", "frames": 4, "framesPerSecond": 10}]})");
    FxPresetId preset{};
    EXPECT_EQ(fxLoadPresetFile(context, path.c_str(), &preset), FX_OK) << fxGetLastErrorMessage();
    return preset;
}

FxPresetId fromLibrary(FxContext* context, const char* name)
{
    FxPresetId preset{};
    EXPECT_EQ(fxLoadPresetLibrary(context, name, &preset), FX_OK) << fxGetLastErrorMessage();
    return preset;
}

} // namespace

SceneScript::SceneScript(FxContext* context, uint32_t number) : context_(context), number_(number)
{
    presets_ = {
        loadText(context, kSparks), fromLibrary(context, "fireworks"),   loadText(context, kSwarm),
        loadText(context, kFlakes), fromLibrary(context, "magic-trail"), loadText(context, gasPreset()),
        playedPreset(context)};
    const FxSceneDef def = fxDefaultSceneDef();
    EXPECT_EQ(fxCreateScene(context, &def, &scene_), FX_OK) << fxGetLastErrorMessage();
    for (int i = 0; i < 5; ++i)
        add(presets_[0]);
    add(presets_[1 + number % 6]);
}

void SceneScript::add(FxPresetId preset)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = preset;
    def.seed = ++nextSeed_ % 4; // some are alike
    def.position[0] = double(nextSeed_ % 7) - 3.0;
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
    instances_.push_back(id);
}

/// The instance keeps the effect, and the views' textures and meshes of it.
void SceneScript::addAndUnload()
{
    const FxPresetId preset = fromLibrary(context_, "debris");
    add(preset);
    ASSERT_EQ(fxUnloadPreset(context_, preset), FX_OK) << fxGetLastErrorMessage();
}

void SceneScript::removeOldest()
{
    ASSERT_EQ(fxScene_DestroyInstance(scene_, instances_.front()), FX_OK) << fxGetLastErrorMessage();
    instances_.erase(instances_.begin());
}

void SceneScript::change(FxInstanceId instance)
{
    const double position[3] = {double(frame_ % 5), 1.0, 0.0};
    const float upright[4] = {0, 0, 0, 1};
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.wind[0] = float(frame_ % 3);
    FxResult result = FX_OK;
    if (frame_ % 3 == 0)
        result = fxScene_SetTransform(scene_, instance, position, upright, 1.0f);
    FxMotion motion = fxDefaultMotion(); // while views show the path
    motion.position[0] = position[0];
    motion.aheadSeconds = 1.0 / 60.0;
    if (frame_ % 6 == 1)
        result = fxScene_SetMotion(scene_, instance, &motion);
    if (frame_ % 4 == 0 && result == FX_OK)
        result = fxScene_SetParameters(scene_, instance, &parameters);
    if (frame_ % 5 == 0 && result == FX_OK)
        result = fxScene_SetVisibilityMask(scene_, instance, frame_ % 2 == 0 ? 1u : 2u);
    if (frame_ % 9 == 0 && result == FX_OK)
        result = fxScene_SetInstanceSpeed(scene_, instance, 1.5f);
    ASSERT_EQ(result, FX_OK) << fxGetLastErrorMessage();
    if (frame_ % 7 == 0) { // refused for those that have ended: what has ended is the same in every run
        result = fxScene_SeekInstance(scene_, instance, 0.2);
        ASSERT_TRUE(result == FX_OK || result == FX_ERROR_INVALID_ARGUMENT) << fxGetLastErrorMessage();
    }
}

/// To one side or everywhere in turn.
void SceneScript::look() const
{
    FxFocus focus = fxDefaultFocus();
    focus.origin[0] = 1.0;
    focus.projection[0] = focus.projection[5] = 1.0f;
    focus.projection[10] = focus.projection[11] = -1.0f;
    focus.projection[14] = -0.2f;
    ASSERT_EQ(fxScene_SetFocus(scene_, &focus, frame_ % 2 == 0 ? 1 : 0), FX_OK) << fxGetLastErrorMessage();
}

void SceneScript::saveAndRestore()
{
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(scene_, nullptr, 0, &size), FX_OK) << fxGetLastErrorMessage();
    state_.resize(size);
    ASSERT_EQ(fxScene_SaveState(scene_, state_.data(), size, &size), FX_OK) << fxGetLastErrorMessage();
    ASSERT_EQ(fxScene_RestoreState(scene_, state_.data(), size), FX_OK) << fxGetLastErrorMessage();
}

void SceneScript::play(int frames)
{
    for (int i = 0; i < frames && !::testing::Test::HasFatalFailure(); ++i, ++frame_) {
        if (frame_ % 5 == 2)
            add(presets_[(number_ + uint32_t(frame_) / 5) % presets_.size()]);
        if (frame_ % 20 == 11)
            addAndUnload();
        if (instances_.size() > kMaxInstances)
            removeOldest();
        change(instances_[uint32_t(frame_) % instances_.size()]);
        if (frame_ % 13 == 0)
            look();
        if (frame_ % 17 == 16)
            saveAndRestore();
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
    }
}

uint64_t SceneScript::stateHash() const
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(scene_, &hash), FX_OK) << fxGetLastErrorMessage();
    return hash;
}

uint64_t SceneScript::simulationHash() const
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetSimulationHash(scene_, &hash), FX_OK) << fxGetLastErrorMessage();
    return hash;
}

} // namespace fx::test
