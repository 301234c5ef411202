#include "fxsdk/presets/emitters/mesh_text.h"
#include "simulation/particles/fields/field_grid.h"
#include "tests/presets/module_probe.h"
#include "tests/presets/temp_folder.h"

#include <fstream>

using namespace fx;
using namespace fx::test;

namespace {

constexpr const char* kTriangle =
    "# a floor\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nvn 0 1 0\nf 1//1 4//1 3//1 2//1\n";

std::string grid(uint32_t channels, const glm::uvec3& nodes, float first = 1.0f)
{
    sim::FieldGrid g;
    g.nodes = nodes;
    g.channels = channels;
    g.values.assign(g.count() * channels, first);
    return sim::writeFieldGrid(g);
}

/// Loads a preset with one emitter from a folder that also has these files.
base::Result<preset::LoadedPreset> loadWith(const Json& members,
                                            const std::vector<std::pair<std::string, std::string>>& files)
{
    const TempFolder folder;
    Json element = members;
    element["emission"] = {{"rate", 1}};
    const Json document{{"version", 1}, {"emitters", Json::array({element})}};
    const auto write = [&](const std::string& name, const std::string& bytes) {
        std::ofstream(folder.path() + "/" + name, std::ios::binary) << bytes;
    };
    for (const auto& [name, bytes] : files)
        write(name, bytes);
    write("p.fx.json", document.dump());
    return preset::loadPresetFile(folder.path() + "/p.fx.json");
}

const sim::EmitterDef& emitterOf(const base::Result<preset::LoadedPreset>& loaded)
{
    return dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers.at(0));
}

} // namespace

TEST(EmitterAssets, shapesFieldsAndObstaclesComeFromFilesBesideThePreset)
{
    const Json cases[] = {
        {{"shape", "mesh"}, {"file", "m.obj"}},
        {{"shape", "volume"}, {"file", "d.fxgrid"}},
        {{"forces", {{"vectorFields", {{{"file", "v.fxgrid"}}}}}}},
        {{"forces", {{"conform", {{{"shape", "mesh"}, {"file", "m.obj"}, {"stiffness", 1}}}}}}},
        {{"collisions", {{{"shape", "mesh"}, {"file", "m.obj"}}}}},
        {{"collisions", {{{"shape", "heights"}, {"file", "h.fxgrid"}}}}},
    };
    for (const Json& members : cases) {
        const auto loaded = loadWith(members, {{"m.obj", kTriangle},
                                               {"d.fxgrid", grid(1, {2, 2, 2})},
                                               {"v.fxgrid", grid(3, {2, 2, 2})},
                                               {"h.fxgrid", grid(1, {3, 1, 3})}});
        ASSERT_TRUE(loaded.ok()) << loaded.status().message();
        const sim::EmitterDef& e = emitterOf(loaded);
        EXPECT_EQ((e.births ? 1u : 0u) + e.modules.size(), 1u) << members.dump();
    }
}

TEST(EmitterAssets, aThinSlabThatIsMetFarFromItsSurfaceIsWarnedOf)
{
    const std::string slab = "v 0 0 0\nv 120 0 0\nv 120 0 120\nv 0 0 120\n"
                             "v 0 0.1 0\nv 120 0.1 0\nv 120 0.1 120\nv 0 0.1 120\n"
                             "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    const auto warningsOf = [&](const std::string& mesh, float cellSize) {
        const Json members{{"collisions", {{{"shape", "mesh"}, {"file", "m.obj"}, {"cellSize", cellSize}}}}};
        const auto loaded = loadWith(members, {{"m.obj", mesh}});
        std::string text;
        if (!loaded.ok())
            return loaded.status().message();
        for (const preset::Diagnostic& warning : loaded->warnings)
            text += preset::toString(warning);
        return text;
    };
    const std::string text = warningsOf(slab, 0.0f);
    EXPECT_NE(text.find("cells of 2.5 m"), std::string::npos) << text;
    EXPECT_NE(text.find("cellSize"), std::string::npos) << text;
    EXPECT_EQ(warningsOf(slab, 5.0f), "") << "as its author wants it";
    EXPECT_EQ(warningsOf(kTriangle, 0.0f), "");
}

TEST(EmitterAssets, filesThatDoNotFitAreErrors)
{
    const auto messageOf = [](const Json& members) {
        const auto loaded = loadWith(members, {{"m.obj", "v 1 2\n"},
                                               {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"},
                                               {"three.fxgrid", grid(3, {2, 2, 2})},
                                               {"one.fxgrid", grid(1, {2, 2, 2})}});
        return loaded.ok() ? std::string("none") : loaded.status().message();
    };
    const auto expectError = [&](const Json& members, const char* what) {
        EXPECT_NE(messageOf(members).find(what), std::string::npos) << messageOf(members);
    };
    expectError({{"shape", "mesh"}, {"file", "m.obj"}}, "line 1");
    expectError({{"shape", "mesh"}, {"file", "flat.obj"}}, "no triangle");
    expectError({{"shape", "mesh"}, {"file", "none.obj"}}, "none.obj");
    expectError({{"shape", "mesh"}, {"file", "../m.obj"}}, "file");
    expectError({{"shape", "volume"}, {"file", "three.fxgrid"}}, "channels");
    expectError({{"forces", {{"vectorFields", {{{"file", "one.fxgrid"}}}}}}}, "channels");
    expectError({{"collisions", {{{"shape", "heights"}, {"file", "one.fxgrid"}}}}}, "sheet");
}

TEST(EmitterAssets, theFingerprintDependsOnTheFiles)
{
    const Json members{{"shape", "volume"}, {"file", "d.fxgrid"}};
    const auto a = loadWith(members, {{"d.fxgrid", grid(1, {2, 2, 2}, 1.0f)}});
    const auto b = loadWith(members, {{"d.fxgrid", grid(1, {2, 2, 2}, 2.0f)}});
    const auto c = loadWith(members, {{"d.fxgrid", grid(1, {2, 2, 2}, 1.0f)}});
    ASSERT_TRUE(a.ok() && b.ok() && c.ok());
    EXPECT_NE(a->effect->fingerprint, b->effect->fingerprint);
    EXPECT_EQ(a->effect->fingerprint, c->effect->fingerprint);
}

TEST(MeshText, polygonsBecomeFansAndCornersMayCountBackwards)
{
    const auto mesh = preset::readMeshText("v 0 0 0\r\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4/1 -3/2/3 -2 -1\n");
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(mesh->indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    for (const char* wrong :
         {"f 1 2 3\n", "v 0 0 0\nf 1 1\n", "v 0 0 x\n", "v 0 0 0\nf 0 1 1\n", "v inf 0 0\n"})
        EXPECT_FALSE(preset::readMeshText(wrong).ok()) << wrong;
}
