// The tint of an instance: what hosts read of it, and what does not depend on it.
#include "tests/api/api_fixture.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace fx::test;

namespace {

constexpr float kTint[3] = {1.0f, 0.5f, 0.125f}; // exact in binary16

/// All kinds of groups that presets of small size publish.
const std::string kEveryKind = R"({"version":1,"emitters":[
    {"name":"smoke","emission":{"rate":60},"lifetime":1,"radius":0.3,"temperature":1500,
     "albedoOverLife":[0.8,0.6,0.4],"emissionOverLife":[10,20,30]},
    {"name":"sparks","emission":{"rate":60},"lifetime":1,"speed":2,"trail":{"lifetime":0.3},"light":{"intensity":5},
     "appearance":{"kind":"sprite","luminance":100,"colorOverLife":[1,0.5,0.25]}}]})";

float halfOf(uint64_t color, int channel)
{
    const uint32_t bits = uint32_t(color >> (16 * channel)) & 0xFFFFu;
    return bits == 0 ? 0.0f : std::ldexp(1.0f + float(bits & 0x3FFu) / 1024.0f, int(bits >> 10 & 31u) - 15);
}

/// Values of the columns and constants of an instance by kind and name. Colors are three columns.
using Content = std::map<std::string, std::vector<float>>;

Content contentOf(FxScene* scene, FxInstanceId instance)
{
    Content content;
    FxSnapshotId snapshot{};
    EXPECT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
    FxSnapshotInfo info{};
    info.structSize = sizeof info;
    EXPECT_EQ(fxScene_GetSnapshotInfo(scene, snapshot, &info), FX_OK);
    for (uint32_t g = 0; g < info.groupsNewer; ++g) {
        FxSnapshotGroup group{};
        group.structSize = sizeof group;
        EXPECT_EQ(fxScene_GetSnapshotGroup(scene, snapshot, FX_SNAPSHOT_NEWER, g, &group), FX_OK);
        if (group.instance.bits != instance.bits)
            continue;
        const std::string kind = group.kind;
        for (uint32_t c = 0; c < group.columnCount; ++c) {
            FxSnapshotColumn column{};
            column.structSize = sizeof column;
            EXPECT_EQ(fxScene_GetSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, g, c, &column), FX_OK);
            const std::string name = kind + "." + column.name;
            if (column.values)
                content[name].assign(column.values, column.values + column.count);
            for (uint32_t i = 0; column.values64 && std::string(column.name) == "color" && i < column.count;
                 ++i)
                for (int k = 0; k < 4; ++k)
                    content[name + "RGBA"[k]].push_back(halfOf(column.values64[i], k));
        }
        content[kind + ".constants"].assign(group.constants, group.constants + group.constantCount);
    }
    EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
    return content;
}

class TintApi : public ApiTest
{
protected:
    FxInstanceId add(FxPresetId preset, const float* tint, double x = 0.0)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset;
        def.position[0] = x;
        if (tint)
            std::copy_n(tint, 3, def.tint);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    void setTint(FxInstanceId id, const float* tint) const
    {
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        std::copy_n(tint, 3, parameters.tint);
        ASSERT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_OK) << fxGetLastErrorMessage();
    }
    /// Expects that `tinted` is `plain` in another light. @return names of what differs
    static std::set<std::string> compare(const Content& plain, const Content& tinted)
    {
        std::set<std::string> changed;
        EXPECT_EQ(plain.size(), tinted.size());
        for (const auto& [name, before] : plain) {
            const std::vector<float>& after = tinted.at(name);
            EXPECT_EQ(before.size(), after.size()) << name;
            const bool isConstants = name.ends_with(".constants");
            const bool isColored =
                name.find("color") != std::string::npos || name.find("albedo") != std::string::npos ||
                name.find("emission") != std::string::npos || name.starts_with("light.intensity");
            const size_t channel = std::string("RGB").find(name.back());
            for (size_t i = 0; i < before.size() && !isConstants; ++i) {
                const bool isFiltered = isColored && channel != std::string::npos;
                EXPECT_EQ(after[i], isFiltered ? kTint[channel] * before[i] : before[i]) << name << " " << i;
            }
            if (before != after)
                changed.insert(name);
        }
        return changed;
    }
};

} // namespace

TEST_F(TintApi, itFiltersTheLightOfEveryKindAndNothingElse)
{
    const FxPresetId preset = loadText(context_, kEveryKind);
    const FxInstanceId plain = add(preset, nullptr), tinted = add(preset, kTint);
    play(20);
    const std::set<std::string> changed = compare(contentOf(scene_, plain), contentOf(scene_, tinted));
    EXPECT_EQ(changed,
              (std::set<std::string>{"blob.albedoG", "blob.albedoB", "blob.emissionG", "blob.emissionB",
                                     "blob.constants", "particle.colorG", "particle.colorB", "ribbon.colorG",
                                     "ribbon.colorB", "light.intensityG", "light.intensityB"}));
    const std::vector<float> constants = contentOf(scene_, tinted).at("blob.constants");
    ASSERT_GE(constants.size(), 8u);
    for (size_t k = 0; k < 3; ++k) // black bodies, whose light readers compute
        EXPECT_EQ(constants[5 + k], 1.0f - kTint[k]);
}

TEST_F(TintApi, presetsOfTheLibraryWithVolumesBlocksAndGasAreFiltered)
{
    for (const char* name : {"cumulus", "explosion", "barrel-smoke", "ash-plume"}) {
        FxPresetId preset{};
        if (fxLoadPresetLibrary(context_, name, &preset) != FX_OK)
            continue; // a build without gases
        SCOPED_TRACE(name);
        const FxInstanceId plain = add(preset, nullptr), tinted = add(preset, kTint);
        play(12);
        EXPECT_FALSE(compare(contentOf(scene_, plain), contentOf(scene_, tinted)).empty());
        ASSERT_EQ(fxScene_DestroyAllInstances(scene_), FX_OK);
    }
}

TEST_F(TintApi, itIsChangedAndTakenBackWhileTheInstanceRuns)
{
    const FxPresetId preset = loadText(context_, kEveryKind);
    const FxInstanceId plain = add(preset, nullptr), other = add(preset, nullptr);
    play(5);
    setTint(other, kTint);
    play(5);
    EXPECT_FALSE(compare(contentOf(scene_, plain), contentOf(scene_, other)).empty());
    const float white[3] = {1, 1, 1};
    setTint(other, white);
    play(5);
    EXPECT_EQ(contentOf(scene_, plain), contentOf(scene_, other));
}

TEST_F(TintApi, manySmallEmittersOfWhichSomeAreTintedKeepTheirColors)
{
    const FxPresetId preset =
        loadText(context_, R"({"version":1,"emitters":[{"emission":{"rate":60},"lifetime":0.5,"speed":1,
        "maxParticles":64,"appearance":{"kind":"sprite","luminance":100,"colorOverLife":[1,0.5,0.25]}}]})");
    const auto playThem = [&](const float* tint) {
        std::vector<FxInstanceId> ids;
        for (uint64_t i = 0; i < 40; ++i) { // each for itself, so that pools compute them
            FxInstanceDef def = fxDefaultInstanceDef();
            def.preset = preset;
            def.seed = i;
            EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &ids.emplace_back()), FX_OK);
        }
        play(30);
        if (tint)
            setTint(ids[7], tint);
        play(30);
        std::vector<Content> contents;
        for (const FxInstanceId id : ids)
            contents.push_back(contentOf(scene_, id));
        EXPECT_EQ(fxScene_DestroyAllInstances(scene_), FX_OK);
        play(1);
        return contents;
    };
    const std::vector<Content> plain = playThem(nullptr), tinted = playThem(kTint);
    EXPECT_EQ(compare(plain[7], tinted[7]), (std::set<std::string>{"particle.colorG", "particle.colorB"}));
    EXPECT_EQ(plain[6], tinted[6]);
    EXPECT_EQ(plain[8], tinted[8]);
}

TEST_F(TintApi, isAPartOfStatesAndHashesAsTheOtherParametersAre)
{
    const FxInstanceId id = add(loadText(context_, kEveryKind), kTint);
    play(10);
    const std::vector<std::byte> state = savedState();
    const uint64_t shown = hash(), simulated = simulationHash();
    const Content before = contentOf(scene_, id);
    const float white[3] = {1, 1, 1};
    setTint(id, white);
    EXPECT_NE(simulationHash(), simulated);
    play(1);
    ASSERT_EQ(restore(state), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(hash(), shown);
    EXPECT_EQ(simulationHash(), simulated);
    EXPECT_EQ(contentOf(scene_, id), before);
}

TEST_F(TintApi, numbersOutOfRangeAreRefusedAndOlderHostsHaveNone)
{
    const FxPresetId preset = loadText(context_, kEveryKind);
    const FxInstanceId id = add(preset, nullptr);
    const uint64_t before = simulationHash();
    for (const float wrong : {-0.01f, 1.01f, std::numeric_limits<float>::quiet_NaN()}) {
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        parameters.tint[1] = wrong;
        EXPECT_EQ(fxScene_SetParameters(scene_, id, &parameters), FX_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "tint"), nullptr) << fxGetLastErrorMessage();
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = preset;
        def.tint[2] = wrong;
        FxInstanceId none{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &none), FX_ERROR_INVALID_ARGUMENT);
    }
    FxInstanceParameters old = fxDefaultInstanceParameters();
    old.structSize = 24;
    old.tint[0] = 0.0f; // memory behind the older struct
    EXPECT_EQ(fxScene_SetParameters(scene_, id, &old), FX_OK);
    EXPECT_EQ(simulationHash(), before);
}
