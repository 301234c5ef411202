#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/preview.h"
#include "fxsdk/scene_file/validate_file.h"
#include "tests/presets/temp_folder.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace fx::scene_file;
using fx::test::TempFolder;

namespace {

std::string presetWith(const std::string& preview)
{
    return R"({"version": 1, "emitters": [{"emission": {"rate": 1}}])" + preview + "}";
}

SceneFile stage()
{
    SceneFile scene;
    const auto loaded = fx::preset::loadPresetText(presetWith(""), "p");
    EXPECT_TRUE(loaded.ok());
    scene.presets.push_back({"p", presetWith(""), "", loaded->effect});
    scene.instances.emplace_back();
    scene.instances[0].position = {7, 8, 9};
    scene.view.exposureEv100 = 13;
    scene.camera.position = {1, 2, 3};
    return scene;
}

fx::base::Result<Preview> read(const std::string& preview, SceneFile& io)
{
    const fx::asset::AssetResolver library("", fx::preset::libraryFiles());
    return readPreview(presetWith(preview), "p", library, io);
}

/// Pointers of what fx validate says of a preset with this preview.
std::vector<std::string> faults(const std::string& preview)
{
    const TempFolder folder;
    std::vector<std::string> pointers;
    for (const auto& finding : fx::preset::validateFile(folder.write("p.fx.json", presetWith(preview))))
        pointers.push_back(finding.pointer);
    return pointers;
}

} // namespace

TEST(Preview, changesWhatItNames)
{
    SceneFile scene = stage();
    const auto preview = read(R"(, "preview": {"time": 2.5,
        "camera": {"position": [4, 5, 6], "fovYDegrees": 30}, "exposureEv100": 9, "lighting": {"skyLuminance": 7},
        "background": {"color": [1, 2, 3]}, "mesh": {"file": "library:stage-yard.obj", "collide": true},
        "instance": {"position": [1, 1, 1], "seed": 5}})",
                              scene);
    ASSERT_TRUE(preview.ok()) << preview.status().message();
    EXPECT_EQ(preview->time, 2.5);
    EXPECT_TRUE(preview->hasCamera);
    EXPECT_EQ(scene.camera.position, glm::dvec3(4, 5, 6));
    EXPECT_FLOAT_EQ(scene.view.exposureEv100, 9);
    EXPECT_EQ(scene.view.lighting.skyLuminance, glm::vec3(7));
    EXPECT_EQ(scene.background.luminance, glm::vec3(1, 2, 3));
    EXPECT_GT(scene.mesh.positions.size(), 100u);
    EXPECT_TRUE(scene.meshCollides);
    EXPECT_EQ(scene.instances[0].position, glm::dvec3(1, 1, 1));
    EXPECT_EQ(scene.instances[0].seed, 5u);
}

TEST(Preview, placesAFigureThatIsNotPartOfTheStageWithWhichEffectsCollide)
{
    SceneFile without = stage(), with = stage();
    ASSERT_TRUE(
        read(R"(, "preview": {"mesh": {"file": "library:stage-yard.obj", "collide": true}})", without));
    ASSERT_TRUE(read(R"(, "preview": {"mesh": {"file": "library:stage-yard.obj", "collide": true},
        "figure": {"position": [4, 0, 2], "headingDegrees": 30}})",
                     with));
    const size_t figure = with.mesh.figureVertices;
    EXPECT_EQ(without.mesh.figureVertices, 0u);
    ASSERT_GT(figure, 100u);
    EXPECT_EQ(std::vector(with.mesh.positions.begin() + std::ptrdiff_t(figure), with.mesh.positions.end()),
              without.mesh.positions);
    for (size_t i = 0; i < figure; ++i)
        EXPECT_LT(glm::length(with.mesh.positions[i] - glm::vec3(4, 0.9f, 2)), 1.0f);
}

TEST(Preview, placesPropsWithWhichEffectsDoNotCollideEither)
{
    SceneFile without = stage(), with = stage();
    ASSERT_TRUE(read(R"(, "preview": {"mesh": {"file": "library:stage-yard.obj"}})", without));
    ASSERT_TRUE(
        read(R"(, "preview": {"mesh": {"file": "library:stage-yard.obj"}, "figure": {"position": [4, 0, 2]},
        "props": {"file": "library:debris-brick.obj", "position": [3, 1, 2], "headingDegrees": 20, "scale": 0.5}})",
             with));
    ASSERT_GT(with.mesh.propVertices, 20u);
    EXPECT_EQ(std::vector(with.mesh.positions.begin() + std::ptrdiff_t(with.mesh.addedVertices()),
                          with.mesh.positions.end()),
              without.mesh.positions);
    for (size_t i = with.mesh.figureVertices; i < with.mesh.addedVertices(); ++i)
        EXPECT_LT(glm::length(with.mesh.positions[i] - glm::vec3(3, 1, 2)), 1.0f);
}

TEST(Preview, givesTheGroundAMeanColor)
{
    SceneFile scene = stage();
    scene.mesh = {};
    scene.mesh.isSoil = true;
    scene.mesh.positions = {{1, 0, 0}, {0, 0, 2}, {500, 0, 0}};
    scene.mesh.colors = {{0.1f, 0.2f, 0.3f}, {0.3f, 0.2f, 0.1f}, {0.2f, 0.2f, 0.6f}};
    ASSERT_TRUE(read(R"(, "preview": {"groundColor": [0.4, 0.3, 0.1]})", scene));
    EXPECT_FLOAT_EQ(scene.mesh.colors[0].x, 0.2f); // half of the mean around the effect, as before
    EXPECT_FLOAT_EQ(scene.mesh.colors[1].x, 0.6f);
    EXPECT_FLOAT_EQ(scene.mesh.colors[1].y, 0.3f);
    EXPECT_FLOAT_EQ(scene.mesh.colors[2].z, 0.3f);
    scene.mesh.isSoil = false;
    ASSERT_TRUE(read(R"(, "preview": {"groundColor": [0, 0, 0]})", scene));
    EXPECT_FLOAT_EQ(scene.mesh.colors[0].x, 0.2f);
    EXPECT_EQ(faults(R"(, "preview": {"groundColor": [2, 0, 0]})"),
              std::vector<std::string>{"/preview/groundColor/0"});
}

TEST(Preview, leavesTheRestAsItWas)
{
    for (const char* text : {"", R"(, "preview": {})"}) {
        SceneFile scene = stage();
        const auto preview = read(text, scene);
        ASSERT_TRUE(preview.ok());
        EXPECT_FALSE(preview->time.has_value());
        EXPECT_FALSE(preview->hasCamera);
        EXPECT_EQ(scene.camera.position, glm::dvec3(1, 2, 3));
        EXPECT_FLOAT_EQ(scene.view.exposureEv100, 13);
        EXPECT_EQ(scene.instances[0].position, glm::dvec3(7, 8, 9));
    }
}

TEST(Preview, isCheckedAsASceneIs)
{
    EXPECT_TRUE(faults(R"(, "preview": {"time": 1, "camera": {}})").empty());
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"("tiem": 1)", "/preview/tiem"},
        {R"("time": -1)", "/preview/time"},
        {R"("camera": {"position": [1, 1, 1], "target": [1, 1, 1]})", "/preview/camera/target"},
        {R"("lighting": {"sunDirection": [0, 0, 0]})", "/preview/lighting/sunDirection"},
        {R"("mesh": {"file": "none.obj"})", "/preview/mesh/file"},
        {R"("instance": {"preset": "library:rain"})", "/preview/instance/preset"},
        {R"("props": {"file": "none.obj"})", "/preview/props/file"},
        {R"("props": {"position": [0, 0, 0]})", "/preview/props"},
        {R"("props": {"file": "library:debris-brick.obj", "scale": 0})", "/preview/props/scale"},
        {R"("figure": {})", "/preview/figure"},
        {R"("figure": {"position": [0, 0]})", "/preview/figure/position"},
        {R"("figure": {"position": [0, 0, 1e9]})", "/preview/figure/position/2"},
        {R"("figure": {"position": [0, 0, 0], "headingDegrees": 400})", "/preview/figure/headingDegrees"},
        {R"("instance": {"keys": [{"time": 1, "position": [0, 0, 0]}, {"time": 1, "position": [1, 0, 0]}]})",
         "/preview/instance/keys/1/time"},
    };
    for (const auto& [member, pointer] : cases)
        EXPECT_EQ(faults(R"(, "preview": {)" + member + "}"), std::vector<std::string>{pointer});
}

TEST(Preview, isNoPartOfTheEffect)
{
    const auto fingerprint = [](const std::string& preview) {
        const auto loaded = fx::preset::loadPresetText(presetWith(preview), "p");
        EXPECT_TRUE(loaded.ok());
        return loaded.ok() ? loaded->effect->fingerprint : 0;
    };
    EXPECT_EQ(fingerprint(R"(, "preview": {"time": 2})"), fingerprint(""));
    EXPECT_NE(fingerprint(R"(, "duration": 2)"), fingerprint(""));
}

TEST(Preview, ofEveryPresetOfTheLibraryIsValid)
{
    size_t previews = 0;
    for (const auto& entry : fx::preset::presetLibrary()) {
        const std::string path =
            std::string(FX_SOURCE_DIR "/fxsdk/presets/library/") + std::string(entry.name);
        for (const auto& finding : fx::preset::validateFile(path))
            ADD_FAILURE() << fx::preset::toString(finding);
        previews += entry.text.find("\"preview\"") != std::string_view::npos ? 1 : 0;
    }
    EXPECT_GE(previews, 8u);
}
