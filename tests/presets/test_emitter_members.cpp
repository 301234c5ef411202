#include "simulation/emitters/emitter_def.h"
#include "tests/presets/member_probe.h"

#include <cmath>
#include <numbers>

using namespace fx::test;
using fx::sim::EmitterDef;

namespace {

void addForces(Fields& fields, const fx::sim::EmitterForces& forces)
{
    fields.insert(fields.end(), {forces.gravity, forces.drag, forces.buoyancy, forces.curlStrength,
                                 forces.curlScale, forces.curlRate, forces.bounce, forces.friction});
    add(fields, forces.wind);
}

Fields fieldsOf(const fx::sim::SolverDef& solver)
{
    const auto& e = dynamic_cast<const EmitterDef&>(solver);
    Fields fields{double(e.layer),     double(e.maxParticles),
                  double(e.shape),     e.angle,
                  e.emission.rate,     e.emission.start,
                  e.emission.duration, double(e.opticalDepthGiven),
                  e.fireShare,         e.heat,
                  e.detailAmount,      e.detailScale,
                  e.anisotropy,        e.shutter};
    for (const glm::vec3& v : {e.position, e.size})
        add(fields, v);
    for (const fx::base::Range& range : {e.lifetime, e.speed, e.radius, e.crossSection, e.temperature})
        add(fields, range);
    addForces(fields, e.forces);
    for (const fx::base::ScalarCurve& curve : {e.sizeOverLife, e.opacityOverLife, e.temperatureOverLife})
        add(fields, curve);
    for (const fx::base::ColorCurve& curve : {e.albedoOverLife, e.emissionOverLife})
        add(fields, curve);
    for (const fx::sim::Burst& burst : e.emission.bursts)
        fields.insert(fields.end(), {burst.time, double(burst.count)});
    return fields;
}

const Json kLeast{{"emission", {{"rate", 1}}}};

Json emitterSchema()
{
    return fx::preset::presetSchema()["properties"]["emitters"]["items"];
}

/// The emitter of a preset whose only emitter has these members besides a rate.
EmitterDef emitterWith(const Json& members, const Json& emission = {{"rate", 1}})
{
    Json element = members;
    element["emission"] = emission;
    const Json document{{"version", 1}, {"emitters", Json::array({element})}};
    const auto loaded = fx::preset::loadPresetText(document.dump(), "t");
    EXPECT_TRUE(loaded.ok()) << loaded.status().message();
    if (!loaded.ok())
        return {};
    EmitterDef copy;
    const auto& e = dynamic_cast<const EmitterDef&>(*loaded->effect->solvers.at(0));
    copy.angle = e.angle;
    copy.size = e.size;
    copy.emission = e.emission;
    copy.crossSection = e.crossSection;
    copy.opticalDepthGiven = e.opticalDepthGiven;
    copy.sizeOverLife = e.sizeOverLife;
    copy.albedoOverLife = e.albedoOverLife;
    copy.lifetime = e.lifetime;
    return copy;
}

} // namespace

TEST(EmitterMembers, eachIsReadAndHasTheDefaultThatItsSchemaDocuments)
{
    probeMembers("emitters", emitterSchema(), kLeast, "", fieldsOf);
}

TEST(EmitterMembers, eachForceIsReadAndHasTheDefaultThatItsSchemaDocuments)
{
    probeMembers("emitters", emitterSchema()["properties"]["forces"], kLeast, "/forces", fieldsOf);
}

TEST(EmitterMembers, emissionHoldsForEverUnlessADurationIsGiven)
{
    EXPECT_TRUE(std::isinf(emitterWith({}).emission.duration));
    const EmitterDef e = emitterWith({}, {{"rate", 5}, {"start", 2}, {"duration", 3}});
    EXPECT_FLOAT_EQ(e.emission.rate, 5);
    EXPECT_FLOAT_EQ(e.emission.start, 2);
    EXPECT_FLOAT_EQ(e.emission.duration, 3);
}

TEST(EmitterMembers, burstsKeepTheirOrder)
{
    const Json bursts = Json::array({{{"time", 2}, {"count", 7}}, {{"time", 1}, {"count", 9}}});
    const EmitterDef e = emitterWith({}, {{"bursts", bursts}});
    ASSERT_EQ(e.emission.bursts.size(), 2u);
    EXPECT_FLOAT_EQ(e.emission.bursts[0].time, 2);
    EXPECT_EQ(e.emission.bursts[1].count, 9u);
}

TEST(EmitterMembers, anglesAreDegreesInPresetsAndRadiansInTheSimulation)
{
    EXPECT_FLOAT_EQ(emitterWith({{"angleDegrees", 180}}).angle, std::numbers::pi_v<float>);
}

TEST(EmitterMembers, aSizeIsOneNumberOrThree)
{
    EXPECT_EQ(emitterWith({{"size", 2}}).size, glm::vec3(2, 2, 2));
    EXPECT_EQ(emitterWith({{"size", {1, 2, 3}}}).size, glm::vec3(1, 2, 3));
}

TEST(EmitterMembers, aCrossSectionTakesThePlaceOfTheOpticalDepth)
{
    EXPECT_TRUE(emitterWith({{"opticalDepth", 3}}).opticalDepthGiven);
    const EmitterDef e = emitterWith({{"crossSection", {{"min", 2}, {"max", 4}}}});
    EXPECT_FALSE(e.opticalDepthGiven);
    EXPECT_FLOAT_EQ(e.crossSection.min, 2);
    EXPECT_FLOAT_EQ(e.crossSection.max, 4);
}

TEST(EmitterMembers, curvesAreNumbersOrKeys)
{
    EXPECT_FLOAT_EQ(emitterWith({{"sizeOverLife", 3}}).sizeOverLife.at(0.3f)[0], 3);
    const Json keys{{"keys", {{0, 1}, {0.5, 3}, {1, 2}}}};
    const EmitterDef e = emitterWith({{"sizeOverLife", keys}});
    EXPECT_FLOAT_EQ(e.sizeOverLife.at(0.25f)[0], 2);
    EXPECT_FLOAT_EQ(e.sizeOverLife.at(0.75f)[0], 2.5f);
}

TEST(EmitterMembers, colorCurvesAreColorsOrKeys)
{
    const EmitterDef flat = emitterWith({{"albedoOverLife", {0.1, 0.2, 0.3}}});
    EXPECT_FLOAT_EQ(flat.albedoOverLife.at(0.5f)[2], 0.3f);
    const Json keys{{"keys", {{0, {0, 0, 0}}, {1, {1, 0.5, 0.25}}}}};
    const EmitterDef ramp = emitterWith({{"albedoOverLife", keys}});
    EXPECT_FLOAT_EQ(ramp.albedoOverLife.at(0.5f)[0], 0.5f);
    EXPECT_FLOAT_EQ(ramp.albedoOverLife.at(0.5f)[2], 0.125f);
}

TEST(EmitterMembers, tooSmallACapacityIsAWarning)
{
    const auto warnings = [](int capacity) {
        const Json element{{"maxParticles", capacity},
                           {"lifetime", 2},
                           {"emission", {{"rate", 50}, {"bursts", {{{"time", 0}, {"count", 10}}}}}}};
        const Json document{{"version", 1}, {"emitters", Json::array({element})}};
        return fx::preset::loadPresetText(document.dump(), "t")->warnings;
    };
    EXPECT_TRUE(warnings(110).empty());
    ASSERT_EQ(warnings(109).size(), 1u);
    EXPECT_TRUE(warnings(109)[0].warning);
    EXPECT_NE(warnings(109)[0].message.find("110"), std::string::npos);
}

TEST(EffectMembers, theEffectsOwnMembersAreRead)
{
    const auto loaded = fx::preset::loadPresetText(
        R"({"version":1,"name":"n","duration":2.5,"subSteps":3,"wind":[1,2,3],"ground":false})", "t");
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(loaded->effect->name, "n");
    EXPECT_EQ(loaded->effect->duration, fx::base::kTicksPerSecond * 5 / 2);
    EXPECT_EQ(loaded->effect->subSteps, 3u);
    EXPECT_EQ(loaded->effect->wind, glm::vec3(1, 2, 3));
    EXPECT_FALSE(loaded->effect->hasGround);
    ASSERT_EQ(loaded->warnings.size(), 1u) << "an effect without solvers";
}
