#include "fxsdk/presets/migration.h"
#include "fxsdk/presets/schema_assembly.h"
#include "fxsdk/presets/schema_explainer.h"
#include "fxsdk/presets/schema_validator.h"

#include <gtest/gtest.h>

#include <functional>

using namespace fx::preset;
using Json = nlohmann::json;

namespace {

using Visitor = std::function<void(const std::string& path, const Json& member)>;

/// Calls `visit` for each member that an author can write, at any depth.
void forEachMember(const Json& object, const std::string& path, const Visitor& visit)
{
    for (const auto& [name, member] : object["properties"].items()) {
        visit(path + "/" + name, member);
        if (member.contains("x-kind"))
            continue;
        if (member.contains("properties"))
            forEachMember(member, path + "/" + name, visit);
        else if (member.contains("items") && member["items"].contains("properties"))
            forEachMember(member["items"], path + "/" + name + "/0", visit);
    }
}

void forEachNumber(const Json& schema, const std::string& path, const Visitor& visit)
{
    if (schema.is_object() &&
        (schema.value("type", Json()) == "number" || schema.value("type", Json()) == "integer"))
        visit(path, schema);
    if (schema.is_structured())
        for (const auto& [name, part] : schema.items())
            forEachNumber(part, path + "/" + name, visit);
}

} // namespace

class EachSchema : public ::testing::TestWithParam<bool>
{
protected:
    Json schema() const { return GetParam() ? Json(sceneSchema()) : Json(presetSchema()); }
};

INSTANTIATE_TEST_SUITE_P(PresetsAndScenes, EachSchema, ::testing::Values(false, true));

TEST_P(EachSchema, saysOfEveryMemberWhatItIs)
{
    forEachMember(schema(), "", [](const std::string& path, const Json& member) {
        EXPECT_TRUE(member.contains("title")) << path;
        EXPECT_TRUE(member.contains("description")) << path;
    });
}

TEST_P(EachSchema, givesEveryMeasurableMemberAUnit)
{
    forEachMember(schema(), "", [](const std::string& path, const Json& member) {
        const bool isMeasurable = member.contains("x-kind") || member.value("type", "") == "number";
        EXPECT_TRUE(!isMeasurable || member.contains("x-unit")) << path;
    });
}

TEST_P(EachSchema, boundsEveryNumberSoThatNoneOverflowsAFloat)
{
    int count = 0;
    forEachNumber(schema(), "", [&](const std::string& path, const Json& number) {
        ++count;
        ASSERT_TRUE(number.contains("minimum") && number.contains("maximum")) << path;
        const double largest = number["type"] == "integer" ? 9007199254740991.0 : 1e12;
        EXPECT_LE(number["maximum"].get<double>(), largest) << path;
        EXPECT_GE(number["minimum"].get<double>(), -1e12) << path;
    });
    EXPECT_GE(count, 40);
}

TEST_P(EachSchema, forbidsUnknownMembersEverywhere)
{
    const std::function<void(const Json&, const std::string&)> walk = [&](const Json& part,
                                                                          const std::string& path) {
        const bool isObject =
            part.is_object() && part.contains("properties") && part["properties"].is_object();
        EXPECT_TRUE(!isObject || part.value("additionalProperties", Json()) == false) << path;
        if (part.is_structured())
            for (const auto& [name, inner] : part.items())
                walk(inner, path + "/" + name);
    };
    walk(schema(), "");
}

TEST_P(EachSchema, acceptsItsOwnDefaults)
{
    Json document{{"version", 1}};
    if (GetParam())
        document.update({{"camera", Json::object()}, {"mesh", {{"file", "m.obj"}}}});
    else
        document["preview"] = {{"mesh", {{"file", "m.obj"}}},
                               {"figure", {{"position", {0, 0, 0}}}},
                               {"props", {{"file", "p.obj"}}}};
    forEachMember(schema(), "", [&](const std::string& path, const Json& member) {
        if (member.contains("default") && path.find("/0") == std::string::npos)
            document[Json::json_pointer(path)] = member["default"];
    });
    Findings findings;
    SchemaValidator(schema()).validate(document, {}, findings);
    for (const Diagnostic& d : findings.locate("{}", "defaults"))
        ADD_FAILURE() << toString(d);
}

TEST(SchemaAssembly, theNewestVersionIsTheOneThatMigrationLeadsTo)
{
    EXPECT_EQ(presetSchema()["properties"]["version"]["maximum"], kPresetVersion);
    EXPECT_EQ(presetSchema()["properties"]["version"]["minimum"], kPresetVersion);
    EXPECT_EQ(sceneSchema()["properties"]["version"]["maximum"], kSceneVersion);
}

TEST(SchemaExplainer, saysWhatIsAllowedInWords)
{
    const Json emitter = presetSchema()["properties"]["emitters"]["items"]["properties"];
    EXPECT_EQ(allowedText(emitter["angleDegrees"]), "a number from 0 to 180 [degree]");
    EXPECT_EQ(allowedText(emitter["maxParticles"]), "a whole number from 1 to 16777216");
    EXPECT_EQ(allowedText(emitter["layer"]), "one of \"fire\", \"smoke\", \"dust\"");
    EXPECT_EQ(allowedText(emitter["position"]), "[x, y, z] with numbers from -10000 to 10000 [m]");
    EXPECT_EQ(allowedText(emitter["lifetime"]),
              "a number from 0.01 to 3600 or {\"min\": a, \"max\": b} of such numbers [s]");
}

TEST(SchemaExplainer, saysWhatWasFound)
{
    EXPECT_EQ(foundText(Json(3)), "3");
    EXPECT_EQ(foundText(Json("x")), "\"x\"");
    EXPECT_EQ(foundText(Json::array({1, 2})), "an array of 2 elements");
    EXPECT_EQ(foundText(Json(nullptr)), "null");
    EXPECT_LT(foundText(Json(std::string(4000, 'a'))).size(), 60u);
}

TEST(SchemaValidator, longArraysAreCheckedElementByElementWithTheSameResult)
{
    constexpr std::string_view kLong[] = {"/instances"};
    const SchemaValidator validator{Json(sceneSchema())};
    Json document{{"version", 1}, {"camera", Json::object()}, {"instances", Json::array()}};
    for (int i = 0; i < 40; ++i)
        document["instances"].push_back(i % 20 == 7 ? Json{{"preset", 5}} : Json{{"preset", "a.fx.json"}});
    const Json before = document;
    Findings whole, split;
    validator.validate(document, {}, whole);
    validator.validate(document, kLong, split);
    EXPECT_EQ(document, before);
    ASSERT_EQ(whole.size(), 2u);
    ASSERT_EQ(split.size(), 2u);
    const std::string text = document.dump();
    const auto a = whole.locate(text, "f"), b = split.locate(text, "f");
    for (size_t i = 0; i < 2; ++i)
        EXPECT_EQ(toString(a[i]), toString(b[i]));
    EXPECT_EQ(a[0].pointer, "/instances/7/preset");
}

TEST(SchemaValidator, stopsAfterAHundredFindings)
{
    constexpr std::string_view kLong[] = {"/instances"};
    Json document{{"version", 1}, {"camera", Json::object()}, {"instances", Json::array()}};
    for (int i = 0; i < 10'000; ++i)
        document["instances"].push_back(i);
    Findings findings;
    SchemaValidator{Json(sceneSchema())}.validate(document, kLong, findings);
    EXPECT_EQ(findings.size(), Findings::kLimit);
}
