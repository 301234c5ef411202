#include "fxsdk/quality/calibration_file.h"

#include "embedded/quality_texts.h"
#include "fxsdk/presets/diagnostic.h"
#include "fxsdk/presets/json_parser.h"
#include "fxsdk/presets/migration.h"
#include "fxsdk/presets/schema_validator.h"
#include "rendering/frame/composition_names.h"

#include <algorithm>
#include <cstdio>

namespace fx::quality {

namespace {

using Json = nlohmann::json;
using preset::Findings;
using render::QualityKnob;

constexpr preset::JsonLimits kLimits{kCalibrationBytes, 8, 4'096, 1'024, 64, uint64_t(4) << 20};

std::string_view textNamed(std::string_view name)
{
    for (const base::EmbeddedText& entry : embedded::texts())
        if (entry.name == name)
            return entry.text;
    return {};
}

float readValue(const QualityKnob& knob, const Json& value)
{
    switch (knob.type) {
    case QualityKnob::Type::Number:
        return value.get<float>();
    case QualityKnob::Type::Switch:
        return value.get<bool>() ? 1.0f : 0.0f;
    case QualityKnob::Type::Choice:
        break;
    }
    const auto found = std::ranges::find(knob.choices, value.get_ref<const std::string&>());
    return float(found - knob.choices.begin());
}

Knobs readKnobs(const Json& setting)
{
    Knobs knobs;
    forEachKnob([&](const QualityKnob& knob) {
        if (const auto it = setting.find(knob.name); it != setting.end())
            knobs.set(knob.name, readValue(knob, *it));
    });
    return knobs;
}

/// The text in the folder, with the scalability levels and the settings of all techniques.
Json calibrationSchema()
{
    Json schema = Json::parse(textNamed("calibration.schema.json"));
    Json& techniques = schema["properties"]["techniques"];
    Json& levels = techniques["items"]["properties"];
    Json& settings = levels["steps"]["items"]["properties"]["setting"]["properties"];
    std::string meanings;
    Json names = Json::array();
    for (const render::DrawTechnique* technique : render::drawTechniques()) {
        if (!technique->levels)
            continue;
        const std::string name(technique->levels->name);
        names.push_back(name);
        meanings +=
            (meanings.empty() ? "" : " ") + name + ": " + std::string(technique->levels->meaning) + ".";
    }
    techniques["maxItems"] = names.size() * (1 + render::kCompositionCount);
    levels["name"]["enum"] = std::move(names);
    levels["name"]["description"] = meanings;
    forEachKnob(
        [&](const QualityKnob& knob) { settings[std::string(knob.name)] = Json::parse(knob.schema); });
    return schema;
}

void checkStep(const ScalabilityLevels& levels, size_t k, const std::string& pointer, Findings& findings)
{
    const ScalabilityLevel& step = levels.steps[k];
    if (k > 0 && !(step.cost > levels.steps[k - 1].cost))
        findings.error(pointer + "/cost",
                       "is not above the step's before it; remove the step that costs more "
                       "without being better, or measure with fx calibrate");
    if (k > 0 && !(step.error < levels.steps[k - 1].error))
        findings.error(pointer + "/error",
                       "is not below the step's before it; remove this step: it costs more for nothing");
    if (k + 1 == levels.steps.size() && step.error != 0.0)
        findings.error(pointer + "/error",
                       "is not 0, but the last step is what the others are compared with");
    if (k + 1 == levels.steps.size() && step.cost != 1.0)
        findings.error(pointer + "/cost", "is not 1, but the last step is the unit of the costs");
}

ScalabilityLevels readLevels(const Json& json, const std::string& pointer, Findings& findings)
{
    ScalabilityLevels levels{json["name"].get<std::string>(), {}, {}};
    for (const auto& [name, composition] : render::kCompositionNames)
        if (json.value("composition", "") == name)
            levels.composition = composition;
    for (const Json& step : json["steps"]) {
        levels.steps.push_back(
            {step["cost"].get<double>(), step["error"].get<double>(), readKnobs(step["setting"])});
    }
    for (size_t k = 0; k < levels.steps.size(); ++k)
        checkStep(levels, k, pointer + "/steps/" + std::to_string(k), findings);
    return levels;
}

Calibration readDocument(std::string_view text, Findings& findings)
{
    Calibration calibration;
    std::optional<Json> document = preset::parseJson(text, kLimits, findings);
    if (!document || !preset::migrate(*document, 1, {}, findings))
        return calibration;
    const preset::SchemaValidator validator{calibrationSchema()};
    validator.validate(*document, {}, findings);
    if (findings.hasErrors())
        return calibration;
    calibration.origin = document->value("origin", "");
    const Json& techniques = (*document)["techniques"];
    for (size_t i = 0; i < techniques.size(); ++i) {
        const std::string pointer = "/techniques/" + std::to_string(i);
        calibration.techniqueLevels.push_back(readLevels(techniques[i], pointer, findings));
        for (size_t j = 0; j < i; ++j)
            if (calibration.techniqueLevels[j].technique == calibration.techniqueLevels[i].technique &&
                calibration.techniqueLevels[j].composition == calibration.techniqueLevels[i].composition)
                findings.error(pointer + "/name", "occurs twice; give each technique once for a composition");
    }
    return calibration;
}

/// "particles 0.5", "kernel", "detail on".
std::string partOf(const QualityKnob& knob, float value)
{
    const std::string label = std::string(knob.label) + " ";
    char number[32];
    switch (knob.type) {
    case QualityKnob::Type::Switch:
        return label + (value != 0.0f ? "on" : "off");
    case QualityKnob::Type::Choice:
        return std::string(knob.choices[size_t(value)]);
    case QualityKnob::Type::Number:
        break;
    }
    std::snprintf(number, sizeof number, "%g", double(value));
    return label + number;
}

} // namespace

base::Result<Calibration> readCalibration(std::string_view text, const std::string& displayName)
{
    Findings findings;
    Calibration calibration = readDocument(text, findings);
    if (!findings.hasErrors())
        return calibration;
    return base::Status(findings.firstCode(), preset::summary(findings.locate(text, displayName)));
}

base::Result<Calibration> builtInCalibration()
{
    return readCalibration(textNamed("calibration.json"), "the built-in calibration.json");
}

nlohmann::ordered_json toJson(const Knobs& knobs)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    forEachKnob([&](const QualityKnob& knob) {
        const std::optional<float> value = knobs.valueOf(knob.name);
        if (!value)
            return;
        nlohmann::ordered_json& member = json[std::string(knob.name)];
        switch (knob.type) {
        case QualityKnob::Type::Number:
            member = *value;
            break;
        case QualityKnob::Type::Switch:
            member = *value != 0.0f;
            break;
        case QualityKnob::Type::Choice:
            member = std::string(knob.choices[size_t(*value)]);
            break;
        }
    });
    return json;
}

nlohmann::ordered_json toJson(const Calibration& calibration)
{
    nlohmann::ordered_json techniques = nlohmann::ordered_json::array();
    for (const ScalabilityLevels& levels : calibration.techniqueLevels) {
        nlohmann::ordered_json steps = nlohmann::ordered_json::array();
        for (const ScalabilityLevel& step : levels.steps)
            steps.push_back({{"cost", step.cost}, {"error", step.error}, {"setting", toJson(step.knobs)}});
        nlohmann::ordered_json technique = {{"name", levels.technique}};
        if (levels.composition)
            technique["composition"] = std::string(render::nameOf(*levels.composition));
        technique["steps"] = steps;
        techniques.push_back(technique);
    }
    return {{"version", 1}, {"origin", calibration.origin}, {"techniques", techniques}};
}

std::string toText(const Knobs& knobs)
{
    std::string text;
    const auto addAll = [&](QualityKnob::Type type) {
        forEachKnob([&](const QualityKnob& knob) {
            const std::optional<float> value = knobs.valueOf(knob.name);
            if (knob.type == type && value)
                text += (text.empty() ? "" : ", ") + partOf(knob, *value);
        });
    };
    addAll(QualityKnob::Type::Number);
    addAll(QualityKnob::Type::Choice);
    addAll(QualityKnob::Type::Switch);
    return text;
}

std::string calibrationText(const Calibration& calibration)
{
    const nlohmann::ordered_json json = toJson(calibration);
    std::string text =
        "{\n  \"version\": 1,\n  \"origin\": " + json["origin"].dump() + ",\n  \"techniques\": [";
    const char* nextTechnique = "\n";
    for (const auto& technique : json["techniques"]) {
        text += nextTechnique + ("    {\"name\": " + technique["name"].dump());
        if (technique.contains("composition"))
            text += ", \"composition\": " + technique["composition"].dump();
        text += ", \"steps\": [";
        const char* nextStep = "\n";
        for (const auto& step : technique["steps"]) {
            text += nextStep + ("      " + step.dump());
            nextStep = ",\n";
        }
        text += "\n    ]}";
        nextTechnique = ",\n";
    }
    return text + "\n  ]\n}\n";
}

} // namespace fx::quality
