#include "fxsdk/presets/preset_loader.h"
#include "simulation/emitters/emitter_def.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

using namespace fx;

namespace {

base::Result<preset::LoadedPreset> load(const std::string& emitters)
{
    return preset::loadPresetText("{\"version\":1,\"emitters\":[" + emitters + "]}", "probe");
}

std::string messageOf(const std::string& emitters)
{
    const auto loaded = load(emitters);
    return loaded.ok() ? "no error" : loaded.status().message();
}

const std::string kSparks = R"({"name":"sparks","speed":2})";

} // namespace

TEST(EmitterEventsPreset, joinsEmittersByNameWhateverTheirOrder)
{
    const auto loaded = load(kSparks + R"(,{"name":"rocket","emission":{"rate":1},"events":[
        {"on":"death","emit":"sparks","count":{"min":3,"max":7},"probability":0.5,"inheritVelocity":0.25},
        {"on":"age","age":0.5,"emit":"sparks"}, {"on":"host","name":"hit","emit":"sparks"}]})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const sim::EffectDef& effect = *loaded->effect;
    EXPECT_EQ(effect.order, (std::vector<uint32_t>{1, 0})); // causes first
    EXPECT_EQ(effect.hostEvents, std::vector<std::string>{"hit"});
    const auto& sparks = dynamic_cast<const sim::EmitterDef&>(*effect.solvers[0]);
    const auto& rocket = dynamic_cast<const sim::EmitterDef&>(*effect.solvers[1]);
    EXPECT_TRUE(sparks.fed);
    EXPECT_FALSE(rocket.fed);
    ASSERT_EQ(rocket.events.size(), 3u);
    EXPECT_EQ(rocket.events[0].on, sim::EventKind::Death);
    EXPECT_EQ(rocket.events[0].fewest, 3u);
    EXPECT_EQ(rocket.events[0].most, 7u);
    EXPECT_EQ(rocket.events[0].probability, 0.5f);
    EXPECT_EQ(rocket.events[0].inheritVelocity, 0.25f);
    EXPECT_EQ(rocket.events[1].age, base::kTicksPerSecond / 2);
    EXPECT_EQ(rocket.events[1].most, 1u);
}

TEST(EmitterEventsPreset, aCircleIsNamed)
{
    const std::string text = messageOf(
        R"({"name":"a","emission":{"rate":1},"events":[{"on":"death","emit":"b"}]},
           {"name":"b","events":[{"on":"death","emit":"c"}]},{"name":"c","events":[{"on":"birth","emit":"b"}]})");
    EXPECT_NE(text.find("b -> c -> b"), std::string::npos) << text;
}

TEST(EmitterEventsPreset, aContactHasALeastSpeed)
{
    const auto loaded = load(kSparks + R"(,{"name":"drop","emission":{"rate":1},"events":[
        {"on":"collision","emit":"sparks"}, {"on":"collision","emit":"sparks","minSpeed":2}]})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const auto& drop = dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers[1]);
    EXPECT_EQ(drop.events[0].minSpeed, 0.5f);
    EXPECT_EQ(drop.events[0].minLastSpeed, 0.0f);
    EXPECT_EQ(drop.events[1].minSpeed, 2.0f);
    EXPECT_EQ(drop.events[1].minLastSpeed, 2.0f);
    const std::string text = messageOf(
        kSparks +
        R"(,{"name":"a","emission":{"rate":1},"events":[{"on":"death","minSpeed":1,"emit":"sparks"}]})");
    EXPECT_NE(text.find("only the event collision has one"), std::string::npos) << text;
}

TEST(EmitterEventsPreset, mistakesAreExplained)
{
    const auto expect = [](const std::string& event, const std::string& message) {
        const std::string text =
            messageOf(kSparks + R"(,{"name":"rocket","emission":{"rate":1},"events":[)" + event + "]}");
        EXPECT_NE(text.find(message), std::string::npos) << text;
    };
    expect(R"({"on":"death","emit":"sparkz"})", "did you mean \"sparks\"?");
    expect(R"({"on":"age","emit":"sparks"})", "the event age needs one");
    expect(R"({"on":"death","age":1,"emit":"sparks"})", "only the event age has one");
    expect(R"({"on":"host","emit":"sparks"})", "the event host needs one");
    expect(R"({"on":"death","emit":"sparks","count":1.5})", "whole numbers");
    expect(R"({"on":"death"})", "needs one of them");
    expect(R"({"on":"death","cue":"end","count":2})", "an event without \"emit\"");
    expect(R"({"on":"death","cue":""})", "cue");
    EXPECT_NE(messageOf(kSparks).find("is missing"), std::string::npos);
}

TEST(EmitterEventsPreset, cuesOfEqualNamesAreOneAndNeedNoBirths)
{
    const auto loaded = load(kSparks + R"(,{"name":"drop","emission":{"rate":1},"events":[
        {"on":"collision","cue":"hit","probability":0.5}, {"on":"death","cue":"end","emit":"sparks"}]},
        {"name":"stone","emission":{"rate":1},"events":[{"on":"collision","cue":"hit"}]})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_EQ(loaded->effect->cues, (std::vector<std::string>{"hit", "end"}));
    const auto& drop = dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers[1]);
    const auto& stone = dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers[2]);
    EXPECT_EQ(drop.events[0].cue, 0u);
    EXPECT_EQ(drop.events[0].target, sim::kNoTarget);
    EXPECT_EQ(drop.events[0].probability, 0.5f);
    EXPECT_EQ(drop.events[1].cue, 1u);
    EXPECT_EQ(drop.events[1].target, 0u);
    EXPECT_EQ(stone.events[0].cue, 0u);
    EXPECT_EQ(loaded->effect->order.size(), 3u);
}

TEST(EmitterEventsPreset, trailsLightsAndPrewarmAreRead)
{
    const auto loaded =
        preset::loadPresetText(R"({"version":1,"prewarm":1.5,"emitters":[{"emission":{"rate":1},
        "trail":{"lifetime":0.5,"width":0.2,"minDistance":0.01,"maxPoints":20,"blend":"additive","luminance":5},
        "light":{"count":4,"merged":true,"intensity":3}}]})",
                               "probe");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    EXPECT_EQ(loaded->effect->prewarm, base::kTicksPerSecond * 3 / 2);
    const auto& emitter = dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers[0]);
    EXPECT_EQ(emitter.trail.lifetime, 0.5f);
    EXPECT_EQ(emitter.trail.width, 0.2f);
    EXPECT_EQ(emitter.trail.minDistance, 0.01f);
    EXPECT_EQ(emitter.trail.maxPoints, 20u);
    EXPECT_EQ(emitter.trail.appearance.blend, base::ParticleBlend::Additive);
    EXPECT_EQ(emitter.trail.appearance.luminance, 5.0f);
    EXPECT_TRUE(emitter.light.given);
    EXPECT_EQ(emitter.light.maxLights, 4u);
    EXPECT_TRUE(emitter.light.merged);
    EXPECT_EQ(emitter.light.intensity, 3.0f);
}

TEST(EmitterEventsPreset, spacesRepetitionsAndColorsAreReadAndMistakesExplained)
{
    const auto loaded = load(R"({"name":"sparks","space":"world"},{"name":"rocket","space":"world",
        "inheritVelocity":0.75,"emission":{"rate":1},"lifetime":2,"events":[
        {"on":"age","age":0.5,"every":0.25,"emit":"sparks","inheritColor":0.5}]})");
    ASSERT_TRUE(loaded.ok()) << loaded.status().message();
    const auto& sparks = dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers[0]);
    const auto& rocket = dynamic_cast<const sim::EmitterDef&>(*loaded->effect->solvers[1]);
    EXPECT_TRUE(sparks.tinted);
    EXPECT_TRUE(rocket.inWorld);
    EXPECT_EQ(rocket.inheritVelocity, 0.75f);
    EXPECT_EQ(rocket.events[0].every, base::kTicksPerSecond / 4);
    EXPECT_EQ(rocket.events[0].inheritColor, 0.5f);
    EXPECT_NE(messageOf(R"({"emission":{"rate":1},"inheritVelocity":1})").find("\"space\": \"world\""),
              std::string::npos);
    EXPECT_NE(messageOf(kSparks + R"(,{"name":"r","space":"world","emission":{"rate":1},
        "events":[{"on":"death","emit":"sparks"}]})")
                  .find("in another space"),
              std::string::npos);
    EXPECT_NE(messageOf(kSparks + R"(,{"name":"r","emission":{"rate":1},"lifetime":100,
        "events":[{"on":"age","age":1,"every":0.01,"emit":"sparks"}]})")
                  .find("repetitions"),
              std::string::npos);
}

TEST(EmitterEventsPreset, theReachOfAChainAddsUp)
{
    const auto reachOf = [](const std::string& emitters) {
        const auto loaded = load(emitters);
        EXPECT_TRUE(loaded.ok()) << loaded.status().message();
        return loaded.ok() ? loaded->effect->reach(9.81f, 0.0f) : 0.0f;
    };
    const std::string rocket = R"({"name":"rocket","emission":{"rate":1},"lifetime":2,"speed":10,"radius":0.1,
        "forces":{"gravity":0},"appearance":{"kind":"none"},"events":[{"on":"death","emit":"star")";
    const std::string star =
        R"(]},{"name":"star","lifetime":1,"speed":3,"radius":0.5,"forces":{"gravity":0}})";
    EXPECT_NEAR(reachOf(rocket + "}" + star), 20 + 3 + 0.5, 1e-3);
    EXPECT_NEAR(reachOf(rocket + R"(,"inheritVelocity":0.5})" + star), 20 + 3 + 5 + 0.5, 1e-3);
    const std::string smoke = R"({"emission":{"rate":1},"radius":0.5,"forces":{"gravity":0,)";
    EXPECT_NEAR(reachOf(smoke + R"("drag":1,"vortices":[{"radius":2,"speed":4,"lift":1}]}})"),
                0.5 * 1 * 5 + 0.5, 1e-3); // accelerates towards air of 5 m/s
    EXPECT_EQ(reachOf(smoke + R"("attractors":[{"strength":1,"falloff":"spring"}]}})"),
              std::numeric_limits<float>::infinity());
    EXPECT_EQ(reachOf(R"({"emission":{"rate":1},"space":"world"})"), reachOf(R"({"emission":{"rate":1}})"))
        << "around each place that the instance has had";
}
