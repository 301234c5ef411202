#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/presets/parameter_reference.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/techniques.h"

#include <gtest/gtest.h>

#include <set>

using namespace fx::preset;

TEST(Techniques, registerEachKindOnce)
{
    fx::base::SnapshotSchema schema;
    registerKinds(schema);
    EXPECT_EQ(schema.size(), 10u);
    for (const char* kind : {"blob", "material", "particle", "ribbon", "light", "gpuParticle", "volume",
                             "block", "blockBall", "blockMaterial"})
        EXPECT_NE(schema.find(kind), fx::base::kNoKind) << kind;
    registerKinds(schema);
    EXPECT_EQ(schema.size(), 10u);
}

TEST(Techniques, haveNamesAndAllOfAPresetMember)
{
    std::set<std::string_view> names;
    for (const Technique& technique : techniques()) {
        EXPECT_TRUE(names.insert(technique.name).second) << technique.name;
        EXPECT_FALSE(technique.presetMember.empty()) << technique.name;
        EXPECT_TRUE(technique.schema && technique.build) << technique.name;
        EXPECT_FALSE(technique.kinds.empty()) << technique.name;
    }
}

TEST(Techniques, aPresetThatAsksForOneThatIsMissingIsToldWhichOptionBringsIt)
{
    if (missingTechniques().empty())
        GTEST_SKIP() << "this build has every technique";
    for (const MissingTechnique& missing : missingTechniques()) {
        const std::string text = "{\"version\":1,\"" + std::string(missing.presetMember) + "\":[{}]}";
        const auto loaded = loadPresetText(text, "t");
        ASSERT_FALSE(loaded.ok());
        EXPECT_NE(loaded.status().message().find(missing.option), std::string::npos)
            << loaded.status().message();
    }
}

TEST(ParameterReference, describesTheMembersOfEveryTechnique)
{
    const std::string reference = parameterReference();
    for (const Technique& technique : techniques()) {
        const std::string heading = "## `/" + std::string(technique.presetMember) + "[]`";
        EXPECT_NE(reference.find(heading), std::string::npos) << heading;
    }
    EXPECT_NE(reference.find("| `curlStrength` |"), std::string::npos);
    EXPECT_NE(reference.find("a number from 0 to 180 | `0` |"), std::string::npos) << "angleDegrees";
    EXPECT_NE(reference.find("## `/instances[]`"), std::string::npos);
}
