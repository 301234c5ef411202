#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/scene/effect_scene.h"
#include "fxsdk/presets/preset_loader.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <numbers>

namespace fx::cli {
namespace {

scene_file::SceneFile explosion()
{
    auto scene = sceneOfPreset("library:explosion");
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    return std::move(*scene);
}

std::unique_ptr<EffectScene> effectsOf(const scene_file::SceneFile& file,
                                       const EffectSceneOptions& options = {})
{
    auto effects = EffectScene::create(file, options);
    EXPECT_TRUE(effects.ok()) << effects.status().message();
    return std::move(*effects);
}

/// [s] scene time between the two steps that a view shows.
double shownTime(FxScene* scene)
{
    FxSnapshotId id = {};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &id), FX_OK);
    FxSnapshotInfo info = {};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, id, &info), FX_OK);
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene, id), FX_OK);
    const double older = base::toSeconds(info.tickOlder);
    return older + info.interpolation * (base::toSeconds(info.tickNewer) - older);
}

uint64_t hashOf(EffectScene& effects)
{
    uint64_t hash = 0;
    EXPECT_EQ(fxScene_GetStateHash(effects.scene(), &hash), FX_OK);
    return hash;
}

TEST(EffectScene, showsPresetsOfTheLibraryInTheLightThatHostsAreTold)
{
    for (const base::EmbeddedText& file : preset::presetLibrary()) {
        const std::string name = "library:" + std::string(file.name.substr(0, file.name.find(".fx.json")));
        scene_file::Preview preview;
        const auto scene = sceneOfPreset(name, &preview);
        ASSERT_TRUE(scene.ok()) << scene.status().message();
        const sim::PreviewDef& told = scene->presets[0].effect->preview;
        EXPECT_EQ(scene->view.exposureEv100, told.exposureEv100) << name;
        const render::Lighting& shown = scene->view.lighting;
        EXPECT_EQ(shown.sunDirection, told.sunDirection) << name;
        EXPECT_EQ(shown.sunIlluminance, told.sunIlluminance) << name;
        EXPECT_EQ(shown.skyLuminance, told.skyLuminance) << name;
        EXPECT_EQ(shown.groundAlbedo, told.groundAlbedo) << name;
        if (!told.hasCamera)
            continue;
        const scene_file::SceneInstance& stands = scene->instances[0]; // hosts are told of it at the origin
        const auto placed = [&](const glm::dvec3& place) {
            return stands.position + glm::dquat(stands.rotation) * (double(stands.scale) * place);
        };
        EXPECT_LT(glm::distance(scene->camera.position, placed(told.cameraPosition)), 1e-5) << name;
        EXPECT_LT(glm::distance(scene->camera.target, placed(told.cameraTarget)), 1e-5) << name;
        EXPECT_EQ(scene->camera.fovYDegrees, told.fovYDegrees) << name;
    }
}

TEST(EffectScene, aViewShowsExactlyTheMomentAskedForOnAndBetweenSteps)
{
    const scene_file::SceneFile file = explosion();
    const auto effects = effectsOf(file);
    for (const double time : {0.05, 0.1, 0.123, 0.5}) {
        ASSERT_TRUE(effects->showMoment(base::toTicks(time)).ok());
        EXPECT_NEAR(shownTime(effects->scene()), time, 1e-8);
    }
}

TEST(EffectScene, theWayToAMomentDoesNotMatter)
{
    const scene_file::SceneFile file = explosion();
    const auto direct = effectsOf(file);
    const auto stepwise = effectsOf(file);
    ASSERT_TRUE(direct->showMoment(base::toTicks(0.4)).ok());
    for (int frame = 0; frame <= 12; ++frame)
        ASSERT_TRUE(stepwise->showMoment(base::toTicks(frame / 30.0)).ok());
    EXPECT_EQ(hashOf(*direct), hashOf(*stepwise));
}

TEST(EffectScene, anotherSeedIsAnotherRun)
{
    const scene_file::SceneFile file = explosion();
    const auto one = effectsOf(file, {.seed = 1});
    const auto two = effectsOf(file, {.seed = 2});
    const auto again = effectsOf(file, {.seed = 1});
    for (EffectScene* effects : {one.get(), two.get(), again.get()})
        ASSERT_TRUE(effects->showMoment(base::toTicks(0.2)).ok());
    EXPECT_NE(hashOf(*one), hashOf(*two));
    EXPECT_EQ(hashOf(*one), hashOf(*again));
}

TEST(EffectScene, theCopiedSnapshotHoldsEveryParticleInItsPlace)
{
    scene_file::SceneFile file = explosion();
    file.instances[0].position = {1000.0, 0.0, -2000.0};
    const auto effects = effectsOf(file);
    ASSERT_TRUE(effects->showMoment(base::toTicks(0.3)).ok());
    const auto snapshot = effects->snapshot();
    ASSERT_TRUE(snapshot.ok());
    uint32_t count = 0;
    for (size_t g = 0; g < (*snapshot)->groupCount(); ++g) {
        const base::SnapshotGroup& group = (*snapshot)->group(g);
        EXPECT_EQ(group.info().placement.position, glm::dvec3(1000.0, 0.0, -2000.0));
        if ((*snapshot)->schema().kind(group.info().kind) !=
            base::kBlobKind) // coordinates of detail belong to rows of blobs
            continue;
        count += group.count();
        for (const float radius : group.column(base::blob_column::Radius))
            EXPECT_GT(radius, 0.0f);
    }
    EXPECT_GT(count, 0u);
    const auto sprites = effects->places(); // are not copied
    ASSERT_TRUE(sprites.ok());
    EXPECT_EQ(count + sprites->size(), effects->statistics()->particles);
}

TEST(DefaultStage, theCameraSeesMostOfTheMediumAtAllMoments)
{
    constexpr double kAspect = 16.0 / 9.0;
    scene_file::SceneFile file = explosion();
    ASSERT_TRUE(frameEffect(file, base::toTicks(3.0), {}, kAspect).ok());
    const glm::dvec3 ahead = glm::normalize(file.camera.target - file.camera.position);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, ahead);
    const double slope = std::tan(double(file.camera.fovYDegrees) * std::numbers::pi / 360.0);
    const auto effects = effectsOf(file);
    for (const double seconds : {0.25, 0.75, 1.5, 3.0}) {
        ASSERT_TRUE(effects->showMoment(base::toTicks(seconds)).ok());
        const auto snapshot = effects->snapshot();
        ASSERT_TRUE(snapshot.ok());
        double seen = 0.0;
        double total = 0.0;
        for (size_t g = 0; g < (*snapshot)->groupCount(); ++g) {
            const base::SnapshotGroup& group = (*snapshot)->group(g);
            if ((*snapshot)->schema().kind(group.info().kind) != base::kBlobKind)
                continue;
            for (size_t i = 0; i < group.count(); ++i) {
                namespace column = base::blob_column;
                const glm::dvec3 position(group.column(column::PositionX)[i],
                                          group.column(column::PositionY)[i],
                                          group.column(column::PositionZ)[i]);
                const glm::dvec3 way = position - file.camera.position;
                const double weight = double(group.column(column::CrossSection)[i]);
                const double depth = glm::dot(way, ahead);
                total += weight;
                if (std::abs(glm::dot(way, up)) < slope * depth &&
                    std::abs(glm::dot(way, right)) < kAspect * slope * depth)
                    seen += weight;
            }
        }
        EXPECT_GT(seen, 0.9 * total) << seconds;
    }
    EXPECT_GT(file.camera.position.y, 0.0); // above the ground
}

TEST(DefaultStage, aMissingPresetIsNamed)
{
    for (const char* name : {"library:nothing", "/nowhere/nothing.fx.json"}) {
        const auto scene = sceneOfPreset(name);
        ASSERT_FALSE(scene.ok());
        EXPECT_NE(scene.status().message().find("nothing"), std::string::npos);
    }
}

} // namespace
} // namespace fx::cli
