#include "fxsdk/scene_file/scene_file.h"

#include "fxsdk/assets/volume_file.h"
#include "fxsdk/scene_file/validate_file.h"
#include "rendering/image/image.h"
#include "tests/presets/temp_folder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>
#include <limits>

using namespace fx::scene_file;
using fx::test::TempFolder;

namespace {

constexpr const char* kSparks = R"({"version":1,"emitters":[{"emission":{"rate":1}}]})";

constexpr const char* kScene = R"({
  "version": 1, "name": "all", "description": "every member",
  "camera": {"position": [1, 2, 3], "target": [4, 5, 6], "up": [0, 0, 1], "fovYDegrees": 40, "near": 0.5},
  "exposureEv100": 9,
  "lighting": {"sunDirection": [0, 3, 4], "sunIlluminance": [1, 2, 3], "skyLuminance": 7, "groundAlbedo": 0.5},
  "background": {"color": [1, 2, 3]},
  "mesh": {"file": "m.obj", "position": [10, 0, 0], "scale": 2, "collide": true, "cellSize": 0.25},
  "instances": [
    {"preset": "sparks.fx.json", "position": [100000.25, 1, 2], "rotationDegrees": [0, 90, 0], "scale": 2,
     "seed": 9007199254740991, "start": 1.5, "intensity": 3, "wind": [4, 5, 6], "tint": [1, 0.5, 0],
     "layer": -16, "sortKey": -2147483648},
    {"preset": "library:explosion", "quaternion": [0, 0, 2, 0]},
    {"preset": "sparks.fx.json"}
  ],
  "shimmer": {"strength": 0.5, "maxOffset": 6},
  "dazzle": {"enabled": false, "white": 2, "a": 3, "b": 1, "c": 4, "riseTime": 0.5, "fallTime": 2},
  "form": "planar", "detail": false, "toneMap": true
})";

/// Loads `text` as a scene in a folder with a mesh, a preset and pictures.
SceneFile load(const std::string& text)
{
    const TempFolder folder;
    folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("sparks.fx.json", kSparks);
    fx::image::Image picture{2, 1, 3, {1, 1, 1, 0, 1, 0}};
    const auto png = fx::image::writePng(picture);
    folder.write("sky.png", {reinterpret_cast<const char*>(png->data()), png->size()});
    auto scene = loadSceneFile(folder.write("s.scene.json", text));
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    return scene.ok() ? *scene : SceneFile{};
}

} // namespace

TEST(SceneFile, warnsWhereAnEmitterWantsGeometryThatTheSceneLacks)
{
    const TempFolder folder;
    folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("p.fx.json",
                 R"({"version":1,"emitters":[{"emission":{"rate":1},"collisions":[{"shape":"scene"}]}]})");
    const auto warnings = [&](const std::string& mesh) {
        const auto scene = loadSceneFile(
            folder.write("s.scene.json", R"({"version":1,"camera":{"position":[0,0,9],"target":[0,0,0]},)" +
                                             mesh + R"("instances":[{"preset":"p.fx.json"}]})"));
        EXPECT_TRUE(scene.ok()) << scene.status().message();
        return scene.ok() ? scene->warnings.size() : 99;
    };
    EXPECT_EQ(warnings(""), 1u);
    EXPECT_EQ(warnings(R"("mesh":{"file":"m.obj"},)"), 1u);
    EXPECT_EQ(warnings(R"("mesh":{"file":"m.obj","collide":true},)"), 0u);
}

TEST(SceneFile, warnsWhereAnOrderOfParticlesIsNotSeen)
{
    const TempFolder folder;
    const auto warnings = [&](const std::string& view, const std::string& appearance) {
        folder.write("p.fx.json", R"({"version":1,"emitters":[{"emission":{"rate":1},"appearance":{)" +
                                      appearance + "}}]}");
        const auto scene = loadSceneFile(
            folder.write("s.scene.json", R"({"version":1,"camera":{"position":[0,0,9],"target":[0,0,0]},)" +
                                             view + R"("instances":[{"preset":"p.fx.json"}]})"));
        EXPECT_TRUE(scene.ok()) << scene.status().message();
        size_t count = 0;
        for (const auto& warning : scene.ok() ? scene->warnings : decltype(scene->warnings)())
            count += warning.message.find("needs the composition") != std::string::npos ? 1 : 0;
        return count;
    };
    const std::string slabs = R"("composition":"slabs",)";
    EXPECT_EQ(warnings(slabs, R"("order":"youngest")"), 1u);
    EXPECT_EQ(warnings(slabs, R"("order":"oldest")"), 1u);
    EXPECT_EQ(warnings(slabs, R"("orderBias":0.5)"), 1u);
    EXPECT_EQ(warnings(slabs, R"("order":"depth","orderBias":0)"), 0u);
    EXPECT_EQ(warnings(slabs, R"("order":"oldest","orderBias":-1)"), 2u) << "each member is named";
    EXPECT_EQ(warnings("", R"("order":"youngest")"), 0u) << "sorted is the default";
    EXPECT_EQ(warnings(R"("composition":"automatic",)", R"("order":"youngest")"), 0u)
        << "nothing asks for more";
}

TEST(SceneFile, warnsWhereVoxelsAreDrawnAsBalls)
{
    fx::base::VoxelVolume volume;
    volume.side = 0.5f;
    volume.bricks = {{1, 1, 1}};
    volume.extinction.assign(fx::base::kVolumeBrickVoxels, 1.0f);
    const auto bytes = fx::asset::writeVolume(volume);
    ASSERT_TRUE(bytes.ok()) << bytes.status().message();
    const TempFolder folder;
    folder.write("v.fxvolume", *bytes);
    folder.write("v.fx.json", R"({"version":1,"volumes":[{"file":"v.fxvolume"}]})");
    folder.write("s.fx.json", R"({"version":1,"composition":"sorted","volumes":[{"file":"v.fxvolume"}]})");
    folder.write("b.fx.json", R"({"version":1,"emitters":[{"emission":{"rate":1}}]})");
    const auto warnings = [&](const std::string& view, const std::string& instances) {
        const auto scene = loadSceneFile(
            folder.write("s.scene.json", R"({"version":1,"camera":{"position":[0,0,9],"target":[0,0,0]},)" +
                                             view + R"("instances":[)" + instances + "]}"));
        EXPECT_TRUE(scene.ok()) << scene.status().message();
        size_t count = 0;
        for (const auto& warning : scene.ok() ? scene->warnings : decltype(scene->warnings)())
            count += warning.message.find("blurred balls") != std::string::npos ? 1 : 0;
        return count;
    };
    const std::string voxels = R"({"preset":"v.fx.json"})", balls = R"({"preset":"b.fx.json"})";
    EXPECT_EQ(warnings("", voxels), 1u) << "sorted is the default";
    EXPECT_EQ(warnings("", balls + "," + voxels + "," + voxels), 1u) << "a preset is named once";
    EXPECT_EQ(warnings("", balls), 0u);
    EXPECT_EQ(warnings("", R"({"preset":"s.fx.json"})"), 0u) << "as its author wants";
    EXPECT_EQ(warnings(R"("composition":"slabs",)", voxels), 1u);
    EXPECT_EQ(warnings(R"("composition":"volume",)", voxels), 0u);
    EXPECT_EQ(warnings(R"("composition":"automatic",)", voxels), 0u)
        << "a preset with voxels asks for volume";
}

TEST(SceneFile, readsTheComposition)
{
    const SceneFile scene = load(R"({"version": 1, "camera": {}, "composition": "slabs", "slabs": 6})");
    EXPECT_EQ(scene.view.composition, fx::render::Composition::Slabs);
    EXPECT_EQ(scene.view.slabs, 6);
    EXPECT_EQ(load(R"({"version": 1, "camera": {}, "composition": "automatic"})").view.composition,
              fx::render::Composition::Automatic);
    EXPECT_EQ(load(R"({"version": 1, "camera": {}})").view.composition, fx::render::Composition::Sorted);
}

TEST(SceneFile, readsCameraAndView)
{
    const SceneFile scene = load(kScene);
    EXPECT_EQ(scene.name, "all");
    EXPECT_EQ(scene.camera.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.camera.target, glm::dvec3(4, 5, 6));
    EXPECT_EQ(scene.camera.up, glm::vec3(0, 0, 1));
    EXPECT_FLOAT_EQ(scene.camera.fovYDegrees, 40);
    EXPECT_FLOAT_EQ(scene.camera.nearPlane, 0.5f);
    EXPECT_FLOAT_EQ(scene.view.exposureEv100, 9);
    EXPECT_FLOAT_EQ(scene.view.shimmer.strength, 0.5f);
    EXPECT_FLOAT_EQ(scene.view.shimmer.maxOffset, 6);
    EXPECT_EQ(scene.view.form, fx::render::BillboardForm::Planar);
    EXPECT_FALSE(scene.view.detail);
    EXPECT_TRUE(scene.view.toneMap);
}

TEST(SceneFile, readsLightAndGlare)
{
    const SceneFile scene = load(kScene);
    const fx::render::Lighting& lighting = scene.view.lighting;
    EXPECT_LT(glm::length(lighting.sunDirection - glm::vec3(0, 0.6f, 0.8f)), 1e-6f) << "made a unit vector";
    EXPECT_EQ(lighting.sunIlluminance, glm::vec3(1, 2, 3));
    EXPECT_EQ(lighting.skyLuminance, glm::vec3(7));
    EXPECT_FLOAT_EQ(lighting.groundAlbedo, 0.5f);
    const fx::render::DazzleSettings& dazzle = scene.view.dazzle;
    EXPECT_FALSE(dazzle.enabled);
    EXPECT_EQ((std::array{dazzle.white, dazzle.a, dazzle.b, dazzle.c, dazzle.riseTime, dazzle.fallTime}),
              (std::array{2.0f, 3.0f, 1.0f, 4.0f, 0.5f, 2.0f}));
}

TEST(SceneFile, readsPointsBallsAndSpots)
{
    const SceneFile scene = load(R"({"version": 1, "camera": {}, "lights": [
        {"position": [1, 2, 3], "intensity": 5},
        {"type": "ball", "position": [0, 1, 0], "intensity": [1, 2, 3], "radius": 0.5},
        {"type": "spot", "position": [0, 4, 0], "intensity": 9, "direction": [0, -3, 4], "innerDegrees": 10,
         "outerDegrees": 45}]})");
    EXPECT_TRUE(scene.warnings.empty());
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(5));
    EXPECT_FALSE(scene.lights[0].isBall() || scene.lights[0].isSpot());
    EXPECT_EQ(scene.lights[1].intensity, glm::vec3(1, 2, 3));
    EXPECT_EQ(scene.lights[1].radius, 0.5f);
    EXPECT_TRUE(scene.lights[2].isSpot());
    EXPECT_LT(glm::length(scene.lights[2].direction - glm::vec3(0, -0.6f, 0.8f)), 1e-6f);
    EXPECT_NEAR(std::tan(scene.lights[2].outerAngle), 1.0, 1e-6);
    EXPECT_NEAR(scene.lights[2].innerAngle, 0.17453293, 1e-6);
}

TEST(SceneFile, refusesALightThatCannotBeAndWarnsOfMembersWithoutEffect)
{
    const auto loaded = [](const std::string& light) {
        return loadSceneText(
            R"({"version": 1, "camera": {}, "lights": [{"position": [0, 1, 0], "intensity": 1, )" + light +
                "}]}",
            "s.scene.json", fx::asset::AssetResolver("", {}));
    };
    EXPECT_FALSE(loaded(R"("type": "spot", "innerDegrees": 40, "outerDegrees": 30)").ok());
    EXPECT_FALSE(loaded(R"("type": "spot", "direction": [0, 0, 0])").ok());
    EXPECT_FALSE(loaded(R"("type": "tube")").ok());
    EXPECT_FALSE(loaded(R"("type": "ball", "radius": 0)").ok());
    for (const char* member : {R"("radius": 1)", R"("direction": [1, 0, 0])", R"("outerDegrees": 10)"}) {
        const auto scene = loaded(member);
        ASSERT_TRUE(scene.ok()) << scene.status().message();
        EXPECT_EQ(scene->warnings.size(), 1u) << member;
    }
}

TEST(SceneFile, placesTheMesh)
{
    const SceneFile scene = load(kScene);
    ASSERT_EQ(scene.mesh.positions.size(), 3u);
    EXPECT_TRUE(scene.meshCollides);
    EXPECT_EQ(scene.meshCellSize, 0.25f);
    EXPECT_FALSE(
        load(R"({"version": 1, "camera": {"position": [0, 0, 9]}, "mesh": {"file": "m.obj"}})").meshCollides);
    EXPECT_EQ(scene.mesh.positions[1], glm::vec3(12, 0, 0));
    EXPECT_EQ(scene.mesh.normals[1], glm::vec3(0, 0, 1));
}

TEST(SceneFile, readsInstancesAndEachPresetOnce)
{
    const SceneFile scene = load(kScene);
    ASSERT_EQ(scene.instances.size(), 3u);
    ASSERT_EQ(scene.presets.size(), 2u);
    EXPECT_EQ(scene.presets[0].text, kSparks);
    EXPECT_EQ(scene.presets[1].effect->name, "explosion");
    EXPECT_EQ(scene.instances[2].preset, 0u);
    const SceneInstance& first = scene.instances[0];
    EXPECT_EQ(first.position, glm::dvec3(100000.25, 1, 2)) << "in double precision";
    EXPECT_EQ(first.seed, 9007199254740991u);
    EXPECT_EQ(first.start, 1.5);
    EXPECT_FLOAT_EQ(first.scale, 2);
    EXPECT_FLOAT_EQ(first.parameters.intensity, 3);
    EXPECT_EQ(first.parameters.wind, glm::vec3(4, 5, 6));
    EXPECT_EQ(first.parameters.tint, glm::vec3(1.0f, 0.5f, 0.0f));
    EXPECT_EQ(first.layer, -16);
    EXPECT_EQ(first.sortKey, std::numeric_limits<int32_t>::min());
    EXPECT_EQ(scene.instances[2].layer, 0);
}

TEST(SceneFile, refusesALayerThatTheLibraryDoesNotHave)
{
    const auto faultOf = [](const std::string& members) {
        const auto scene = loadSceneText(
            R"({"version": 1, "camera": {}, "instances": [{"preset": "library:sparks", )" + members + "}]}",
            "s.scene.json", fx::asset::AssetResolver("", {}));
        return std::string(scene.status().message());
    };
    EXPECT_EQ(faultOf(R"("layer": 15, "sortKey": 2147483647)").find("/instances/0/layer"), std::string::npos);
    for (const char* wrong : {"16", "-17", "0.5"}) {
        const std::string fault = faultOf(R"("layer": )" + std::string(wrong));
        EXPECT_NE(fault.find("/instances/0/layer"), std::string::npos) << fault;
    }
    const std::string fault = faultOf(R"("sortKey": 2147483648)");
    EXPECT_NE(fault.find("/instances/0/sortKey"), std::string::npos) << fault;
}

TEST(SceneFile, rotatesAboutXThenYThenZAndNormalizesQuaternions)
{
    const SceneFile scene = load(kScene);
    EXPECT_LT(glm::length(scene.instances[0].rotation * glm::vec3(0, 0, 1) - glm::vec3(1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::length(scene.instances[1].rotation * glm::vec3(1, 0, 0) - glm::vec3(-1, 0, 0)), 1e-6f);
    const SceneFile turned = load(R"({"version":1,"camera":{},"instances":[
        {"preset":"sparks.fx.json","rotationDegrees":[90,90,0]}]})");
    // (0, 0, 1) goes to (0, -1, 0) about x, which y leaves alone
    EXPECT_LT(glm::length(turned.instances[0].rotation * glm::vec3(0, 0, 1) - glm::vec3(0, -1, 0)), 1e-6f);
}

TEST(SceneFile, anImageBecomesLuminance)
{
    const SceneFile scene =
        load(R"({"version":1,"camera":{},"background":{"image":"sky.png","luminance":500,"panorama":true}})");
    ASSERT_EQ(scene.background.image.size(), 2u);
    EXPECT_TRUE(scene.background.panorama);
    EXPECT_EQ(scene.background.width, 2);
    EXPECT_LT(glm::length(scene.background.image[0] - glm::vec3(500)), 1e-3f);
    EXPECT_LT(glm::length(scene.background.image[1] - glm::vec3(0, 500, 0)), 1e-3f);
}

TEST(SceneFile, aCameraMayMoveAndBeOrthographic)
{
    const SceneFile scene = load(R"({"version":1,"camera":{"orthographicHeight":8,"keys":[
        {"time":0,"position":[0,0,9],"target":[0,0,0]},{"time":2,"position":[0,0,5],"target":[0,0,0]}]}})");
    EXPECT_FLOAT_EQ(scene.camera.orthographicHeight, 8);
    EXPECT_NEAR(scene.camera.at(1).position.z, 7, 1e-9);
}

TEST(ExampleScenes, areAllValid)
{
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(FX_SOURCE_DIR "/examples/scenes")) {
        const std::string path = entry.path().string();
        if (!path.ends_with(".scene.json"))
            continue;
        ++count;
        for (const fx::preset::Diagnostic& d : fx::preset::validateFile(path)) {
            const bool isGenerated = d.pointer == "/mesh/file"; // written by scripts/make_courtyard.py
            const bool isOfTheBuild = d.message.find("FXSDK_GPU_PARTICLES") != std::string::npos;
            if (!isGenerated && !isOfTheBuild)
                ADD_FAILURE() << fx::preset::toString(d);
        }
    }
    EXPECT_GE(count, 8);
}
