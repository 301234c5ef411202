#include "fxsdk/presets/preset_loader.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/gas/gas_def.h"
#include "tests/presets/temp_folder.h"

#include <gtest/gtest.h>

#include <set>

using namespace fx::preset;
namespace sim = fx::sim;

namespace {

/// The effect of a library preset; a failure of the test when it cannot be loaded or has warnings.
std::shared_ptr<const sim::EffectDef> load(const std::string& name)
{
    const fx::asset::AssetResolver resolver("", libraryFiles());
    auto loaded = loadPresetAsset("library:" + name, resolver);
    if (!loaded.ok()) {
        ADD_FAILURE() << loaded.status().message();
        return nullptr;
    }
    for (const Diagnostic& warning : loaded->warnings)
        ADD_FAILURE() << toString(warning);
    return loaded->effect;
}

std::vector<const sim::EmitterDef*> emittersIn(const sim::EffectDef& effect)
{
    std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    std::erase(emitters, nullptr);
    return emitters;
}

std::vector<std::string> names()
{
    std::vector<std::string> list;
    for (const auto& entry : presetLibrary())
        list.emplace_back(entry.name.substr(0, entry.name.find(".fx.json")));
    return list;
}

} // namespace

TEST(PresetLibrary, holdsWhatItPromisesAndAllOfItIsValid)
{
    const std::vector<std::string> list = names();
    const std::set<std::string> found(list.begin(), list.end());
    EXPECT_EQ(found,
              (std::set<std::string>{"artillery-dirt", "barrel-smoke",   "black-powder",    "gas-explosion",
                                     "grenade",        "mushroom-cloud", "petrol-fireball", "explosion",
                                     "gas-fire",       "campfire",       "smoke-column",    "dust-burst",
                                     "sparks",         "steam",          "burning-debris",  "rain",
                                     "snow",           "fireworks",      "waterfall-mist",  "magic-trail",
                                     "muzzle-flash",   "tracer",         "debris",          "cumulus",
                                     "stratus-bank",   "ash-plume",      "sandstorm",       "avalanche",
                                     "thunderhead"}));
    for (const std::string& name : list) {
        const auto effect = load(name);
        ASSERT_TRUE(effect);
        EXPECT_EQ(effect->name, name);
        EXPECT_FALSE(effect->solvers.empty());
    }
}

TEST(PresetLibrary, theEmbeddedTextIsTheFileInTheRepository)
{
    for (const auto& entry : presetLibrary())
        EXPECT_EQ(entry.text, fx::test::readText(std::string(FX_SOURCE_DIR "/fxsdk/presets/library/") +
                                                 std::string(entry.name)));
}

TEST(PresetLibrary, whatGlowsIsAsHotAsFlamesAre)
{
    for (const std::string& name : names()) {
        const auto effect = load(name);
        for (const sim::EmitterDef* emitter : emittersIn(*effect)) {
            const bool glows = emitter->fireShare > 0;
            EXPECT_TRUE(!glows || emitter->temperature.min >= 1200) << name << " " << emitter->name;
            EXPECT_TRUE(!glows || emitter->temperature.max <= 2200) << name << " " << emitter->name;
        }
    }
}

TEST(PresetLibrary, onlyWaterDropletsScatterMoreThanFineDust)
{
    constexpr float kFineDust = 0.97f; // desert dust in red light
    for (const std::string& name : names()) {
        const bool isWater = name == "steam" || name == "waterfall-mist";
        const auto effect = load(name);
        for (const sim::EmitterDef* emitter : emittersIn(*effect))
            for (const float t : {0.0f, 0.25f, 0.5f, 1.0f})
                for (const float albedo : emitter->albedoOverLife.at(t))
                    EXPECT_LT(albedo, isWater ? 1.0f : kFineDust) << name << " " << emitter->name;
    }
}

TEST(PresetLibrary, anExplosionEndsAndHasGasFragmentsDustAndSmoke)
{
    const auto effect = load("explosion");
    EXPECT_GT(effect->duration, fx::base::toTicks(5.0));
    const sim::GasDef* gas = nullptr;
    for (const auto& solver : effect->solvers)
        if (const auto* candidate = dynamic_cast<const sim::GasDef*>(solver.get()))
            gas = candidate;
    ASSERT_TRUE(gas);
    EXPECT_GE(gas->particles, 300u);
    std::set<fx::base::MediaLayer> layers;
    bool hasFragments = false;
    for (const sim::EmitterDef* emitter : emittersIn(*effect)) {
        layers.insert(emitter->layer);
        hasFragments |= emitter->shutter > 0 && emitter->fireShare == 1;
    }
    EXPECT_EQ(layers.size(), 3u);
    EXPECT_TRUE(hasFragments);
}
