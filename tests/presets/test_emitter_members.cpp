#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"
#include "tests/presets/module_probe.h"

#include <cmath>
#include <numbers>
#include <set>

using namespace fx::test;
using fx::sim::EmitterDef;

namespace {

void addForces(Fields& fields, const fx::sim::EmitterForces& forces)
{
    fields.insert(fields.end(), {forces.gravity, forces.drag, forces.buoyancy, forces.curlStrength,
                                 forces.curlScale, forces.curlRate, forces.bounce, forces.friction,
                                 double(forces.curlOctaves), forces.updraft});
    add(fields, forces.wind);
}

void addLook(Fields& fields, const fx::sim::EmitterAppearance& look)
{
    fields.insert(fields.end(),
                  {double(look.kind), double(look.blend), double(look.order), look.orderBias,
                   double(look.alignment), look.aspect, look.stretch, look.luminance, look.lit, look.softness,
                   double(look.tileColumns), double(look.tileRows), double(look.frameBlend), look.motionScale,
                   double(look.frames), look.framesPerSecond, look.fastest});
    add(fields, look.axis);
    for (const fx::base::Range& range :
         {look.opacity, look.brightness, look.angle, look.spin, look.firstFrame})
        add(fields, range);
    for (const fx::base::ColorCurve& curve : {look.colorOverLife, look.colorOverSpeed})
        add(fields, curve);
    for (const fx::base::ScalarCurve& curve : {look.sizeOverSpeed, look.opacityOverSpeed})
        add(fields, curve);
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
                  e.anisotropy,        e.shutter,
                  double(e.inWorld),   e.inheritVelocity,
                  double(e.compute),   double(e.meetsDepth)};
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
        fields.insert(fields.end(), {burst.time, double(burst.count), double(burst.cycles), burst.interval,
                                     burst.probability});
    add(fields, e.emission.rateOverTime);
    addLook(fields, e.appearance);
    addBirths(fields, e.births.get());
    addModules(fields, e.modules);
    return fields;
}

const Json kMin{{"emission", {{"rate", 1}}}};

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
    copy.modules = e.modules;
    copy.forces = e.forces;
    return copy;
}

/// Those properties of `object` whose names are in `names`, or are not.
Json only(const Json& object, const std::set<std::string>& names, bool areWanted = true)
{
    Json part{{"properties", Json::object()}};
    for (const auto& [name, member] : object["properties"].items())
        if ((names.count(name) == 1) == areWanted)
            part["properties"][name] = member;
    return part;
}

Json with(const Json& element, const Json& more)
{
    Json all = element;
    all.update(more);
    return all;
}

/// Tests each member of the elements of an array, the first of which is `first`.
void probeArray(const Json& object, const std::string& array, const Json& first,
                const std::set<std::string>& left = {})
{
    const Json::json_pointer pointer(array);
    Json element = kMin;
    element[pointer] = Json::array({first});
    const Json items = object[pointer.back()]["items"];
    probeMembers("emitters", only(items, left, false), element, array + "/0", fieldsOf);
}

} // namespace

TEST(EmitterMembers, eachIsReadAndHasTheDefaultThatItsSchemaDocuments)
{
    const std::set<std::string> ofShapes{"inner", "surface", "height", "tube", "closed"};
    const Json schema = emitterSchema();
    std::set<std::string> elsewhere = ofShapes;
    elsewhere.insert("inheritVelocity");
    Json plain = only(schema, elsewhere, false);
    plain["properties"]["shape"]["enum"] = {"point", "disc"}; // others need more than their name
    probeMembers("emitters", plain, kMin, "", fieldsOf);
    probeMembers("emitters", only(schema, {"inheritVelocity"}), with(kMin, {{"space", "world"}}), "",
                 fieldsOf);
    const Json torus = with(kMin, {{"shape", "torus"}, {"size", 8000}});
    probeMembers("emitters", only(schema, {"tube"}), torus, "", fieldsOf);
    probeMembers("emitters", only(schema, {"inner", "surface"}), with(torus, {{"tube", 1000}}), "", fieldsOf);
    probeMembers("emitters", only(schema, {"height"}), with(kMin, {{"shape", "cone"}, {"size", 1}}), "",
                 fieldsOf);
    const Json points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    probeMembers("emitters", only(schema, {"closed"}), with(kMin, {{"shape", "spline"}, {"points", points}}),
                 "", fieldsOf);
}

TEST(EmitterMembers, eachForceIsReadAndHasTheDefaultThatItsSchemaDocuments)
{
    const Json forces = emitterSchema()["properties"]["forces"];
    probeMembers("emitters", only(forces, {"gustPeriod"}, false), kMin, "/forces", fieldsOf);
    probeMembers("emitters", only(forces, {"gustPeriod"}), with(kMin, {{"forces", {{"gust", {1, 2, 3}}}}}),
                 "/forces", fieldsOf);
    const Json members = forces["properties"];
    probeArray(members, "/forces/vortices", {{"radius", 2}, {"speed", 3}, {"pull", 1}}, {"speed", "pull"});
    probeArray(members, "/forces/vortices", {{"radius", 2}}, {"position", "axis"});
    probeArray(members, "/forces/attractors", {{"strength", 5}}, {"reach"});
    probeArray(members, "/forces/conform", {{"stiffness", 9}}, {"cellSize", "shape", "reach"});
    for (const char* where : {"/forces/attractors", "/forces/conform"}) { // nothing of the cloud is that far
        Json near = kMin;
        near[Json::json_pointer(where)] = {{{"strength", 5}, {"reach", 1}}};
        if (std::string(where) == "/forces/conform")
            near[Json::json_pointer(where)] = {{{"stiffness", 9}, {"reach", 1}}};
        Json far = near;
        far[Json::json_pointer(where)][0]["reach"] = 0;
        EXPECT_NE(load("emitters", near, fieldsOf), load("emitters", far, fieldsOf)) << where;
    }
}

TEST(EmitterMembers, eachMemberOfObstaclesAndOfTheAppearanceIsRead)
{
    const Json members = emitterSchema()["properties"];
    probeArray(members, "/collisions", {{"shape", "plane"}},
               {"shape", "size", "hollow", "cellSize", "thickness"});
    probeArray(members, "/collisions", {{"shape", "box"}, {"size", 2.5}},
               {"shape", "size", "cellSize", "thickness"});
    probeArray(members, "/collisions", {{"shape", "box"}, {"position", {0, -1, 0}}},
               {"shape", "position", "axis", "hollow", "margin", "cellSize", "thickness", "response",
                "bounce", "friction"});
    probeArray(members, "/collisions", {{"shape", "depth"}},
               {"shape", "position", "axis", "size", "hollow", "cellSize"});
    for (const char* shape : {"plane", "sphere", "box", "ground", "scene", "hook", "depth"})
        EXPECT_EQ(emitterWith({{"collisions", {{{"shape", shape}}}}}).modules.size(), 1u) << shape;
    probeMembers("emitters", members["appearance"], kMin, "/appearance", fieldsOf);
}

TEST(EmitterMembers, bounceJoinsTheOtherObstacles)
{
    const EmitterDef e = emitterWith({{"collisions", {{{"shape", "plane"}}}}, {"forces", {{"bounce", 0.5}}}});
    ASSERT_EQ(e.modules.size(), 1u);
    EXPECT_TRUE(e.modules[0]->collides());
    EXPECT_LT(e.forces.bounce, 0.0f);
    EXPECT_TRUE(emitterWith({{"forces", {{"bounce", 0.5}}}}).modules.empty());
}

TEST(EmitterMembers, whatOnlyTheGpuMeetsIsAWarningWhereTheCpuComputes)
{
    std::string obstacle;
    const auto warningsOf = [&obstacle](const Json& members) {
        Json element = with(kMin, members);
        element["collisions"] = {{{"shape", "plane"}}, {{"shape", "depth"}}};
        const Json document{{"version", 1}, {"emitters", Json::array({element})}};
        std::vector<fx::preset::Diagnostic> found;
        const auto loaded = fx::preset::loadPresetText(document.dump(), "t", &found);
        EXPECT_TRUE(loaded.ok());
        obstacle = fx::sim::gpuObstacle(dynamic_cast<const EmitterDef&>(*loaded->effect->solvers.at(0)));
        std::erase_if(found, [](const auto& f) { return f.pointer != "/emitters/0/collisions/1/shape"; });
        return found;
    };
    const Json sprite{{"appearance", {{"kind", "sprite"}}}};
    const Json cases[] = {sprite,
                          {{"compute", "gpu"}},
                          with(sprite, {{"compute", "auto"}}),
                          with(sprite, {{"compute", "gpu"}, {"trail", {{"lifetime", 1}}}}),
                          with(sprite, {{"compute", "gpu"}})};
    for (const Json& members : cases) {
        const auto found = warningsOf(members);
        ASSERT_EQ(found.size(), obstacle.empty() ? 0u : 1u) << members;
        if (found.empty())
            continue;
        EXPECT_TRUE(found[0].warning);
        EXPECT_NE(found[0].message.find(obstacle), std::string::npos) << found[0].message;
        EXPECT_NE(found[0].message.find("move freely"), std::string::npos);
    }
}

TEST(EmitterMembers, whatASchemaCannotForbidIsAnErrorWithItsPlace)
{
    const auto messageOf = [](const Json& members, const Json& emission) {
        Json element = members;
        element["emission"] = emission;
        const Json document{{"version", 1}, {"emitters", Json::array({element})}};
        const auto loaded = fx::preset::loadPresetText(document.dump(), "t");
        return loaded.ok() ? std::string("none") : loaded.status().message();
    };
    const Json rate{{"rate", 1}};
    const auto expectError = [&](const Json& members, const Json& emission, const char* where) {
        EXPECT_NE(messageOf(members, emission).find(where), std::string::npos)
            << messageOf(members, emission);
    };
    expectError({{"axis", {0, 0, 0}}}, rate, "axis");
    expectError({{"shape", "torus"}, {"size", 1}, {"tube", 2}}, rate, "tube");
    expectError({{"shape", "spline"}}, rate, "points");
    expectError({{"shape", "mesh"}}, rate, "file");
    expectError({{"shape", "volume"}, {"file", "a.fxgrid"}}, rate, "no folder");
    expectError(Json::object(), {{"rate", 1}, {"rateOverTime", {{"keys", {{0, 1}, {1, 2}}}}}}, "duration");
    expectError(Json::object(), {{"bursts", {{{"time", 0}, {"count", 1}, {"cycles", 2}}}}}, "interval");
    expectError({{"collisions", {{{"shape", "heights"}}}}}, rate, "file");
    expectError({{"forces", {{"vectorFields", {{{"file", "x"}}}}}}}, rate, "no folder");
}

TEST(EmitterMembers, burstsRepeatAndCountTowardsTheCapacity)
{
    const Json burst{{"time", 0}, {"count", 4}, {"cycles", 5}, {"interval", 0.25}, {"probability", 0.5}};
    const EmitterDef e = emitterWith({}, {{"bursts", {burst}}});
    EXPECT_EQ(e.emission.bursts.at(0).cycles, 5u);
    EXPECT_FLOAT_EQ(e.emission.bursts[0].interval, 0.25f);
    EXPECT_FLOAT_EQ(e.emission.bursts[0].probability, 0.5f);
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
