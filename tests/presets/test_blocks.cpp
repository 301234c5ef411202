// The preset member "blocks": what it makes of a preset, and its messages.
#include "fxsdk/presets/preset_loader.h"
#include "simulation/blocks/blocks_def.h"

#include <gtest/gtest.h>

#include <string>

using namespace fx;

namespace {

std::string presetOf(const std::string& types, const std::string& rest)
{
    return R"({"version": 1, "blocks": [{"types": [)" + types + "], " + rest + "}]}";
}

const std::string kBall = R"({"name": "ball", "balls": [{"radius": 2, "opticalDepth": 0.5}]})";
const std::string kOne = R"("blocks": [{"type": "ball"}])";

std::string messageOf(const std::string& types, const std::string& rest)
{
    const auto loaded = preset::loadPresetText(presetOf(types, rest), "t");
    EXPECT_FALSE(loaded.ok());
    return loaded.ok() ? "" : loaded.status().message();
}

std::string warningsOf(const std::string& types, const std::string& rest)
{
    std::vector<preset::Diagnostic> diagnostics;
    const auto loaded = preset::loadPresetText(presetOf(types, rest), "t", &diagnostics);
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    std::string all;
    for (const preset::Diagnostic& diagnostic : diagnostics)
        all += diagnostic.message + "\n";
    return all;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

std::shared_ptr<const sim::EffectDef> effectOf(const std::string& types, const std::string& rest)
{
    const auto loaded = preset::loadPresetText(presetOf(types, rest), "t");
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    return loaded.ok() ? loaded->effect : nullptr;
}

const sim::BlocksDef& blocksOf(const sim::EffectDef& effect)
{
    return dynamic_cast<const sim::BlocksDef&>(*effect.solvers[0]);
}

const std::string kBoil = R"({"name": "boil", "period": 2, "frames": 10, "phases": 4, "emitter": {
    "shape": "sphere", "size": 1, "emission": {"rate": 20}, "lifetime": 2, "forces": {"gravity": 0}}})";

} // namespace

TEST(BlocksPreset, readsBallsAndBlocks)
{
    const auto effect = effectOf(
        kBall, R"("density": 2, "blocks": [{"type": "ball", "position": [1, 2, 3], "scale": 4, "density": 5,
                  "axis": [0, 0, 2], "angleDegrees": 90}])");
    const sim::BlocksDef& def = blocksOf(*effect);
    ASSERT_EQ(def.blocks.size(), 1u);
    EXPECT_EQ(def.blocks[0].position, glm::vec3(1, 2, 3));
    EXPECT_EQ(def.blocks[0].scale, 4.0f);
    EXPECT_EQ(def.blocks[0].density, 5.0f);
    EXPECT_EQ(def.density, 2.0f);
    EXPECT_NEAR(def.blocks[0].rotation.z, std::sqrt(0.5f), 1e-6f);
    // optical depth 0.5 along the diameter of the quartic kernel: 3.5 sigma / (pi R^2)
    EXPECT_NEAR(def.types[0].balls[0].crossSection * 3.5f / (3.14159265f * 4.0f), 0.5f, 1e-6f);
    EXPECT_NEAR(def.types[0].radius, 2.0f, 1e-3f);
}

TEST(BlocksPreset, readsPhasesAsSharesOfThePeriod)
{
    const auto effect =
        effectOf(kBoil, R"("blocks": [{"type": "boil", "phase": 0.25}, {"type": "boil", "phase": 0.6},
                                                      {"type": "boil", "phase": 1}])");
    const sim::BlocksDef& def = blocksOf(*effect);
    EXPECT_EQ(def.blocks[0].phase, 1u);
    EXPECT_EQ(def.blocks[1].phase, 2u);
    EXPECT_EQ(def.blocks[2].phase, 3u);
    EXPECT_EQ(def.types[0].phases, 4u);
    EXPECT_EQ(def.types[0].loop->period(), base::toTicks(2.0));
}

TEST(BlocksPreset, buildersMakeBallsAndBlocksOfOtherTypes)
{
    const std::string types =
        kBall + R"(, {"name": "heap", "builder": {"form": "cloud", "count": 40, "albedo": [0.9, 0.9, 0.9]}},
                    {"name": "bank", "builder": {"form": "dustWall", "of": [{"type": "ball"}, {"type": "heap"}],
                     "count": 30, "radius": {"min": 2, "max": 3}}})";
    const auto effect =
        effectOf(types, R"("builder": {"form": "plume", "of": [{"type": "bank"}], "count": 12})");
    const sim::BlocksDef& def = blocksOf(*effect);
    EXPECT_EQ(def.types[1].balls.size(), 40u);
    EXPECT_EQ(def.types[1].balls[7].albedo, glm::vec3(0.9f));
    EXPECT_EQ(def.types[2].blocks.size(), 30u);
    EXPECT_EQ(def.types[2].levels, 2u);
    EXPECT_EQ(def.blocks.size(), 12u);
    for (const sim::BlockPlacement& block : def.types[2].blocks) {
        const float radius = block.scale * def.types[block.type].radius;
        EXPECT_GE(radius, 0.79f * 2.0f);
        EXPECT_LE(radius, 1.21f * 3.0f);
    }
}

TEST(BlocksPreset, anEmitterGivesBirthToBlocks)
{
    const auto effect = effectOf(kBall, R"("of": [{"type": "ball"}], "turn": "free",
        "emitter": {"maxParticles": 50, "emission": {"rate": 10}, "lifetime": 2, "radius": 3})");
    const sim::BlocksDef& def = blocksOf(*effect);
    ASSERT_TRUE(def.emitter);
    EXPECT_EQ(def.emitted, std::vector<uint32_t>{0});
    EXPECT_EQ(def.turn, sim::BlockTurn::Free);
    EXPECT_EQ(def.capacity(), 50u);
    EXPECT_GT(effect->cost.stepWork, 0.0);
}

TEST(BlocksPreset, messagesNameWhatIsMissing)
{
    EXPECT_TRUE(has(messageOf(kBall, R"("name": "x")"), "found 0 sources of blocks"));
    EXPECT_TRUE(
        has(messageOf(kBall, kOne + R"(, "builder": {"form": "cloud"})"), "found 2 sources of blocks"));
    EXPECT_TRUE(has(messageOf(kBall, R"("builder": {"form": "cloud"})"), "add \"of\""));
    EXPECT_TRUE(has(messageOf(kBall, R"("emitter": {"emission": {"rate": 1}})"), "add \"of\""));
    EXPECT_TRUE(has(messageOf(R"({"name": "ball"})", kOne), "found 0 contents of the type"));
    EXPECT_TRUE(
        has(messageOf(R"({"name": "ball", "balls": [{}], "file": "x.fxballs"})", kOne), "found 2 contents"));
    EXPECT_TRUE(has(messageOf(kBall, R"("blocks": [{"type": "bal"}])"), "found no type \"bal\" before"));
    EXPECT_TRUE(has(messageOf(kBall + ", " + kBall, kOne), "found a second type \"ball\""));
    EXPECT_TRUE(
        has(messageOf(kBall, R"("blocks": [{"type": "ball", "axis": [0, 0, 0]}])"), "axis of length 0"));
    EXPECT_TRUE(has(messageOf(R"({"name": "ball", "file": "absent.fxballs"})", kOne), "absent.fxballs"));
    EXPECT_TRUE(
        has(messageOf(
                R"({"name": "ball", "emitter": {"appearance": {"kind": "sprite"}, "emission": {"rate": 9}}})",
                kOne),
            "is a medium"));
    EXPECT_TRUE(
        has(messageOf(R"({"name": "ball", "emitter": {"trail": {"lifetime": 1}, "emission": {"rate": 9}}})",
                      kOne),
            "has no trail"));
    EXPECT_TRUE(
        has(messageOf(R"({"name": "ball", "emitter": {"emission": {"rate": 0}}})", kOne), "no balls"));
    const auto none = preset::loadPresetText(R"({"version": 1, "blocks": [{}]})", "t");
    EXPECT_FALSE(none.ok());
}

TEST(BlocksPreset, moreThanFourLevelsAreRefusedWithTheNameOfTheType)
{
    std::string types = kBall;
    std::string before = "ball";
    for (const char* name : {"two", "three", "four", "five"}) {
        types += std::string(R"(, {"name": ")") + name + R"(", "blocks": [{"type": ")" + before + R"("}]})";
        before = name;
    }
    const std::string message = messageOf(types, R"("blocks": [{"type": "five"}])");
    EXPECT_TRUE(has(message, "\"five\" has 5 levels of blocks; allowed are 4")) << message;
}

TEST(BlocksPreset, warnsOfWhatIsNotDrawnOrNotUsed)
{
    EXPECT_EQ(warningsOf(kBall, kOne), "");
    EXPECT_TRUE(
        has(warningsOf(kBall + R"(, {"name": "other", "balls": [{}]})", kOne), "no block has this type"));
    const std::string many =
        R"("maxParticles": 3, "blocks": [{"type": "ball"}, {"type": "ball"}, {"type": "ball"},
                                {"type": "ball"}])";
    EXPECT_TRUE(has(warningsOf(kBall, many), "up to 4 balls, of which 3 are drawn"));
}

TEST(BlocksPreset, costsGrowWithBallsAndBlocks)
{
    const auto few = effectOf(kBoil, R"("blocks": [{"type": "boil"}])");
    const auto many = effectOf(kBoil, R"("blocks": [{"type": "boil"}, {"type": "boil"}, {"type": "boil"}])");
    EXPECT_GT(few->cost.memory, 0u);
    EXPECT_GT(few->cost.stepWork, 0.0);
    EXPECT_GT(many->cost.memory, few->cost.memory);
    EXPECT_GT(many->cost.stepWork, few->cost.stepWork);
    EXPECT_LT(many->cost.stepWork, 1.5 * few->cost.stepWork); // they share the balls of their type
}
