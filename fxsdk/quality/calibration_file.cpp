#include "fxsdk/quality/calibration_file.h"

#include "embedded/quality_texts.h"
#include "fxsdk/presets/diagnostic.h"
#include "fxsdk/presets/json_parser.h"
#include "fxsdk/presets/migration.h"
#include "fxsdk/presets/schema_validator.h"

#include <cstdio>

namespace fx::quality {

namespace {

using Json = nlohmann::json;
using preset::Findings;

constexpr preset::JsonLimits kLimits{kCalibrationBytes, 8, 4'096, 1'024, 64, uint64_t(4) << 20};
constexpr const char* kForms[] = {"planar", "constant", "kernel"};

std::string_view textNamed(std::string_view name)
{
    for (const base::EmbeddedText& entry : embedded::texts())
        if (entry.name == name)
            return entry.text;
    return {};
}

Knobs readKnobs(const Json& setting)
{
    Knobs knobs;
    if (const auto it = setting.find("billboards"); it != setting.end())
        for (size_t form = 0; form < std::size(kForms); ++form)
            if (*it == kForms[form])
                knobs.billboards = render::BillboardForm(form);
    if (const auto it = setting.find("detail"); it != setting.end())
        knobs.detail = it->get<bool>();
    if (const auto it = setting.find("particles"); it != setting.end())
        knobs.particles = it->get<float>();
    if (const auto it = setting.find("shimmer"); it != setting.end())
        knobs.shimmer = it->get<bool>();
    if (const auto it = setting.find("lodBias"); it != setting.end())
        knobs.lodBias = it->get<float>();
    if (const auto it = setting.find("dazzle"); it != setting.end())
        knobs.dazzle = it->get<bool>();
    return knobs;
}

void checkStep(const Ladder& ladder, size_t k, const std::string& pointer, Findings& findings)
{
    const LadderStep& step = ladder.steps[k];
    if (k > 0 && !(step.cost > ladder.steps[k - 1].cost))
        findings.error(pointer + "/cost",
                       "is not above the step's before it; remove the step that costs more "
                       "without being better, or measure with fx calibrate");
    if (k > 0 && !(step.error < ladder.steps[k - 1].error))
        findings.error(pointer + "/error",
                       "is not below the step's before it; remove this step: it costs more for nothing");
    if (k + 1 == ladder.steps.size() && step.error != 0.0)
        findings.error(pointer + "/error",
                       "is not 0, but the last step is what the others are compared with");
    if (k + 1 == ladder.steps.size() && step.cost != 1.0)
        findings.error(pointer + "/cost", "is not 1, but the last step is the unit of the costs");
}

Ladder readLadder(const Json& json, const std::string& pointer, Findings& findings)
{
    Ladder ladder{json["name"].get<std::string>(), {}};
    for (const Json& step : json["steps"]) {
        ladder.steps.push_back(
            {step["cost"].get<double>(), step["error"].get<double>(), readKnobs(step["setting"])});
    }
    for (size_t k = 0; k < ladder.steps.size(); ++k)
        checkStep(ladder, k, pointer + "/steps/" + std::to_string(k), findings);
    return ladder;
}

Calibration readDocument(std::string_view text, Findings& findings)
{
    Calibration calibration;
    std::optional<Json> document = preset::parseJson(text, kLimits, findings);
    if (!document || !preset::migrate(*document, 1, {}, findings))
        return calibration;
    const preset::SchemaValidator validator{Json::parse(textNamed("calibration.schema.json"))};
    validator.validate(*document, {}, findings);
    if (findings.hasErrors())
        return calibration;
    calibration.origin = document->value("origin", "");
    const Json& techniques = (*document)["techniques"];
    for (size_t i = 0; i < techniques.size(); ++i) {
        const std::string pointer = "/techniques/" + std::to_string(i);
        calibration.ladders.push_back(readLadder(techniques[i], pointer, findings));
        for (size_t j = 0; j < i; ++j)
            if (calibration.ladders[j].technique == calibration.ladders[i].technique)
                findings.error(pointer + "/name", "occurs twice; give each technique once");
    }
    return calibration;
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
    if (knobs.billboards)
        json["billboards"] = kForms[size_t(*knobs.billboards)];
    if (knobs.detail)
        json["detail"] = *knobs.detail;
    if (knobs.particles)
        json["particles"] = *knobs.particles;
    if (knobs.shimmer)
        json["shimmer"] = *knobs.shimmer;
    if (knobs.lodBias)
        json["lodBias"] = *knobs.lodBias;
    if (knobs.dazzle)
        json["dazzle"] = *knobs.dazzle;
    return json;
}

nlohmann::ordered_json toJson(const Calibration& calibration)
{
    nlohmann::ordered_json techniques = nlohmann::ordered_json::array();
    for (const Ladder& ladder : calibration.ladders) {
        nlohmann::ordered_json steps = nlohmann::ordered_json::array();
        for (const LadderStep& step : ladder.steps)
            steps.push_back({{"cost", step.cost}, {"error", step.error}, {"setting", toJson(step.knobs)}});
        techniques.push_back({{"name", ladder.technique}, {"steps", steps}});
    }
    return {{"version", 1}, {"origin", calibration.origin}, {"techniques", techniques}};
}

std::string toText(const Knobs& knobs)
{
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    const auto addNumber = [&](const char* name, const std::optional<float>& value) {
        char part[32];
        if (value && std::snprintf(part, sizeof part, "%s %g", name, double(*value)) > 0)
            add(part);
    };
    addNumber("particles", knobs.particles);
    addNumber("lod bias", knobs.lodBias);
    if (knobs.billboards)
        add(kForms[size_t(*knobs.billboards)]);
    if (knobs.detail)
        add(*knobs.detail ? "detail on" : "detail off");
    if (knobs.shimmer)
        add(*knobs.shimmer ? "shimmer on" : "shimmer off");
    if (knobs.dazzle)
        add(*knobs.dazzle ? "dazzle on" : "dazzle off");
    return text;
}

std::string calibrationText(const Calibration& calibration)
{
    const nlohmann::ordered_json json = toJson(calibration);
    std::string text =
        "{\n  \"version\": 1,\n  \"origin\": " + json["origin"].dump() + ",\n  \"techniques\": [";
    const char* nextTechnique = "\n";
    for (const auto& technique : json["techniques"]) {
        text += nextTechnique + ("    {\"name\": " + technique["name"].dump()) + ", \"steps\": [";
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
