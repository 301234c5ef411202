#include "foundation/snapshot/particle_kind.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace fx::cli {
namespace {

constexpr double kStep = 1.0 / 60.0; // [s]

/// A scene of one instance of a preset with these emitters.
scene_file::SceneFile sceneOf(const std::string& emitters, const std::string& members)
{
    const test::TempFolder folder;
    folder.write("p.fx.json", R"({"version": 1, "ground": false, "emitters": [)" + emitters + "]}");
    auto scene = scene_file::loadSceneFile(folder.write(
        "s.scene.json",
        R"({"version": 1, "camera": {}, "instances": [{"preset": "p.fx.json", )" + members + "}]}"));
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    for (scene_file::ScenePreset& preset : scene->presets)
        preset.file.clear(); // the folder is about to go
    return std::move(*scene);
}

std::unique_ptr<EffectScene> effectsOf(const scene_file::SceneFile& file)
{
    auto effects = EffectScene::create(file, {});
    EXPECT_TRUE(effects.ok()) << effects.status().message();
    return std::move(*effects);
}

struct Particle
{
    glm::dvec3 position; ///< [m] world
    double age;          ///< [s]
};

std::vector<Particle> rowsOf(FxScene* scene, FxSnapshotId id, uint32_t index)
{
    namespace column = base::particle_column;
    FxSnapshotGroup group = {};
    group.structSize = sizeof group;
    EXPECT_EQ(fxScene_GetSnapshotGroup(scene, id, FX_SNAPSHOT_NEWER, index, &group), FX_OK);
    const uint32_t wanted[] = {column::PositionX, column::PositionY, column::PositionZ, column::Age,
                               column::Radius};
    FxSnapshotColumn columns[5] = {};
    for (int c = 0; c < 5; ++c) {
        columns[c].structSize = sizeof columns[c];
        EXPECT_EQ(fxScene_GetSnapshotColumn(scene, id, FX_SNAPSHOT_NEWER, index, wanted[c], &columns[c]),
                  FX_OK);
    }
    const glm::dquat turn(group.rotation[3], group.rotation[0], group.rotation[1], group.rotation[2]);
    const glm::dvec3 origin(group.position[0], group.position[1], group.position[2]);
    std::vector<Particle> rows;
    for (uint32_t i = 0; i < group.count; ++i)
        if (columns[4].values[i] > 0.0f)
            rows.push_back(
                {origin + turn * glm::dvec3(columns[0].values[i], columns[1].values[i], columns[2].values[i]),
                 double(columns[3].values[i])});
    return rows;
}

/// What lives when the scene has been simulated to `time` [s], a whole number of steps.
std::vector<Particle> particlesAt(EffectScene& effects, double time)
{
    EXPECT_TRUE(effects.showMoment(base::toTicks(time - kStep)).ok()); // the clock runs a step ahead
    FxSnapshotId id = {};
    EXPECT_EQ(fxScene_AcquireSnapshot(effects.scene(), &id), FX_OK);
    FxSnapshotInfo info = {};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(effects.scene(), id, &info), FX_OK);
    if (info.groupsNewer > 0) { // nothing is published while there is nothing
        EXPECT_NEAR(base::toSeconds(info.tickNewer), time, 1e-9);
    }
    std::vector<Particle> all;
    for (uint32_t i = 0; i < info.groupsNewer; ++i) {
        const std::vector<Particle> rows = rowsOf(effects.scene(), id, i);
        all.insert(all.end(), rows.begin(), rows.end());
    }
    EXPECT_EQ(fxScene_ReleaseSnapshot(effects.scene(), id), FX_OK);
    return all;
}

/// Sprites that are born where the instance is and stay as they are.
std::string emitter(const std::string& members)
{
    return R"({"name": "a", "shape": "point", "maxParticles": 1000, "lifetime": 100, "radius": 0.1,
        "forces": {"gravity": 0}, "appearance": {"kind": "sprite"}, )" +
           members + "}";
}

const std::string kOne = emitter(R"("emission": {"bursts": [{"time": 0, "count": 1}]})");

/// Passes x = 3 t with a constant velocity from 1 s to 2 s.
const std::string kWay = R"("keys": [{"time": 0, "position": [0, 5, 0]}, {"time": 1, "position": [3, 5, 0]},
    {"time": 2, "position": [6, 5, 0]}, {"time": 3, "position": [9, 5, 0]}])";

TEST(InstanceDirector, particlesOfSpaceWorldStayWhereTheyWereBornOnTheWay)
{
    const auto file = sceneOf(emitter(R"("space": "world", "emission": {"rate": 200})"), kWay);
    const auto effects = effectsOf(file);
    size_t born = 0;
    for (const Particle& particle : particlesAt(*effects, 2.0)) {
        if (particle.age > 1.0)
            continue;
        ++born;
        EXPECT_NEAR(particle.position.x, 3.0 * (2.0 - particle.age), 1e-4);
        EXPECT_NEAR(particle.position.y, 5.0, 1e-6);
    }
    EXPECT_NEAR(double(born), 200.0, 1.0);
}

TEST(InstanceDirector, theirInheritedVelocityIsAShareOfTheInstances)
{
    const auto file =
        sceneOf(emitter(R"("space": "world", "inheritVelocity": 0.5, "emission": {"rate": 200})"), kWay);
    const auto effects = effectsOf(file);
    for (const Particle& particle : particlesAt(*effects, 2.0))
        if (particle.age < 1.0 - kStep) {
            EXPECT_NEAR(particle.position.x, 3.0 * (2.0 - particle.age) + 1.5 * particle.age, 1e-3);
        }
}

TEST(InstanceDirector, particlesOfSpaceLocalGoWithTheInstance)
{
    const auto file = sceneOf(emitter(R"("emission": {"rate": 50})"), kWay);
    const auto effects = effectsOf(file);
    const std::vector<Particle> particles = particlesAt(*effects, 1.5);
    EXPECT_GT(particles.size(), 70u);
    for (const Particle& particle : particles)
        EXPECT_NEAR(particle.position.x, 4.5, 1e-5);
}

TEST(InstanceDirector, anInstanceThatStartsLaterStartsWhereItIsThen)
{
    const auto file = sceneOf(kOne, R"("start": 1.5, )" + kWay);
    const auto effects = effectsOf(file);
    EXPECT_TRUE(particlesAt(*effects, 1.5).empty());
    const std::vector<Particle> particles = particlesAt(*effects, 1.75);
    ASSERT_EQ(particles.size(), 1u);
    EXPECT_NEAR(particles[0].position.x, 5.25, 1e-5);
}

TEST(InstanceDirector, keysTurnWhatIsOffTheOrigin)
{
    const auto file =
        sceneOf(emitter(R"("position": [2, 0, 0], "emission": {"bursts": [{"time": 0, "count": 1}]})"),
                R"("keys": [{"time": 0, "rotationDegrees": [0, 0, 0]},
                                          {"time": 1, "rotationDegrees": [0, 180, 0]}])");
    const auto effects = effectsOf(file);
    const glm::dvec3 half = particlesAt(*effects, 0.5).at(0).position;
    EXPECT_LT(glm::length(half - glm::dvec3(0, 0, -2)), 1e-5) << "90 degrees about +Y";
    EXPECT_LT(glm::length(particlesAt(*effects, 1.5).at(0).position - glm::dvec3(-2, 0, 0)), 1e-5);
}

TEST(InstanceDirector, aTriggerIsHeardWithTheStepThatBeginsAtItsTime)
{
    const std::string hears =
        emitter(R"("events": [{"on": "host", "name": "boom", "emit": "b", "count": 5}])");
    const std::string born =
        R"(, {"name": "b", "lifetime": 100, "maxParticles": 1000, "emission": {"rate": 0},
        "appearance": {"kind": "sprite"}})";
    const auto file = sceneOf(hears + born, R"("triggers": [{"time": 0, "name": "boom"},
        {"time": 1, "name": "boom", "count": 2}, {"time": 1, "name": "boom"}])");
    const auto effects = effectsOf(file);
    EXPECT_EQ(particlesAt(*effects, kStep).size(), 5u);
    EXPECT_EQ(particlesAt(*effects, 1.0).size(), 5u);
    EXPECT_EQ(particlesAt(*effects, 1.0 + kStep).size(), 20u);
    EXPECT_EQ(particlesAt(*effects, 3.0).size(), 20u) << "once";

    const auto late = sceneOf(hears + born, R"("start": 0.5, "triggers": [{"time": 0.5, "name": "boom"}])");
    const auto started = effectsOf(late);
    EXPECT_EQ(particlesAt(*started, 0.5 + kStep).size(), 0u) << "its first step";
    EXPECT_EQ(particlesAt(*started, 0.5 + 2 * kStep).size(), 5u);
}

TEST(InstanceDirector, emissionIsSwitchedAtItsTimes)
{
    const auto file =
        sceneOf(emitter(R"("emission": {"rate": 60})"), R"("emitting": {"steps": [[1, false], [2, true]]})");
    const auto effects = effectsOf(file);
    EXPECT_NEAR(double(particlesAt(*effects, 0.5).size()), 30.0, 1.0);
    const size_t before = particlesAt(*effects, 1.0).size();
    EXPECT_NEAR(double(before), 60.0, 1.0);
    EXPECT_EQ(particlesAt(*effects, 2.0).size(), before);
    EXPECT_NEAR(double(particlesAt(*effects, 3.0).size()), double(before) + 60.0, 1.0);
}

TEST(InstanceDirector, theTimeOfAnInstanceIsTheSumOfItsSpeeds)
{
    const auto file = sceneOf(kOne, R"("speed": {"steps": [[0.5, 2], [1, 0], [2, 0.5]]})");
    const auto effects = effectsOf(file);
    EXPECT_NEAR(particlesAt(*effects, 0.5).at(0).age, 0.5, 1e-5);
    EXPECT_NEAR(particlesAt(*effects, 1.0).at(0).age, 1.5, 1e-5);
    EXPECT_NEAR(particlesAt(*effects, 2.0).at(0).age, 1.5, 1e-5);
    EXPECT_NEAR(particlesAt(*effects, 3.0).at(0).age, 2.0, 1e-5);
}

TEST(InstanceDirector, aJumpTakesTheInstanceToItsTime)
{
    const auto file = sceneOf(kOne, R"("seek": [{"time": 1, "to": 5}, {"time": 2, "to": 0.5}])");
    const auto effects = effectsOf(file);
    EXPECT_NEAR(particlesAt(*effects, 1.0).at(0).age, 1.0, 1e-5);
    EXPECT_NEAR(particlesAt(*effects, 1.5).at(0).age, 5.5, 1e-5);
    EXPECT_NEAR(particlesAt(*effects, 2.5).at(0).age, 1.0, 1e-5);
}

TEST(InstanceDirector, nothingHappensToAnEffectThatHasEnded)
{
    const auto file =
        sceneOf(R"({"name": "a", "lifetime": 0.2, "emission": {"bursts": [{"time": 0, "count": 1}]},
        "appearance": {"kind": "sprite"}})",
                R"("speed": {"steps": [[1, 2]]}, "seek": [{"time": 2, "to": 0}])");
    const auto effects = effectsOf(file);
    EXPECT_EQ(particlesAt(*effects, 0.1).size(), 1u);
    EXPECT_EQ(particlesAt(*effects, 3.0).size(), 0u);
}

TEST(InstanceDirector, theWayToAMomentDoesNotMatterWhateverHappens)
{
    const auto file = sceneOf(
        emitter(
            R"("space": "world", "inheritVelocity": 0.3, "speed": {"min": 0, "max": 2}, "emission": {"rate": 90},
            "events": [{"on": "host", "name": "boom", "emit": "b", "count": 7}])") +
            R"(, {"name": "b", "space": "world", "lifetime": 1, "speed": 3, "emission": {"rate": 0},
                "appearance": {"kind": "sprite"}})",
        R"("start": 0.13, "speed": {"steps": [[0.4, 0.3], [0.9, 3]]}, "emitting": {"steps": [[1.1, false]]},
           "triggers": [{"time": 0.2, "name": "boom"}, {"time": 0.7, "name": "boom", "count": 3}],
           "seek": [{"time": 0.6, "to": 1.5}], )" +
            kWay);
    std::vector<uint64_t> hashes;
    for (const double framesPerSecond : {0.75, 24.0, 30.0, 144.0, 1000.0}) {
        const auto effects = effectsOf(file);
        for (double frame = 1; frame <= framesPerSecond * 4.0 / 3.0 + 1e-9; ++frame)
            ASSERT_TRUE(effects->showMoment(base::toTicks(frame / framesPerSecond)).ok());
        ASSERT_TRUE(effects->showMoment(base::toTicks(4.0 / 3.0)).ok());
        ASSERT_EQ(fxScene_GetStateHash(effects->scene(), &hashes.emplace_back()), FX_OK);
        EXPECT_GT(effects->statistics()->particles, 50u);
        EXPECT_EQ(hashes.back(), hashes.front()) << framesPerSecond;
    }
}

} // namespace
} // namespace fx::cli
