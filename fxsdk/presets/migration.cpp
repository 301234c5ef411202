#include "fxsdk/presets/migration.h"

#include "fxsdk/presets/schema_explainer.h"

#include <array>
#include <string>

namespace fx::preset {

namespace {

using Json = nlohmann::json;

void rename(Json& object, const std::string& pointer, const char* before, const char* now, Findings& findings)
{
    if (!object.is_object() || !object.contains(before) || object.contains(now))
        return;
    Json value = std::move(object[before]);
    object.erase(before);
    object[now] = std::move(value);
    findings.renamed(pointer + "/" + now, pointer + "/" + before);
}

/// Version 0 called a particle's radius "size", the extents of an emitter "extent", and a cone's half angle
/// "angle".
void presetFrom0(Json& document, Findings& findings)
{
    if (!document.contains("emitters") || !document["emitters"].is_array())
        return;
    Json& emitters = document["emitters"];
    for (size_t i = 0; i < emitters.size(); ++i) {
        const std::string pointer = "/emitters/" + std::to_string(i);
        rename(emitters[i], pointer, "size", "radius", findings);
        rename(emitters[i], pointer, "extent", "size", findings);
        rename(emitters[i], pointer, "angle", "angleDegrees", findings);
    }
}

constexpr std::array kPresetSteps{MigrationStep{0, presetFrom0}};

} // namespace

std::span<const MigrationStep> presetMigrations()
{
    return kPresetSteps;
}

std::span<const MigrationStep> sceneMigrations()
{
    return {}; // version 1 is the first
}

bool migrate(nlohmann::json& document, int current, std::span<const MigrationStep> steps, Findings& findings)
{
    const std::string wanted = "\"version\": " + std::to_string(current);
    if (!document.is_object()) {
        findings.error("",
                       "found " + foundText(document) + "; allowed is an object that begins with " + wanted);
        return false;
    }
    if (!document.contains("version")) {
        findings.error("", "the member \"version\" is missing; new files say " + wanted);
        return false;
    }
    const Json& version = document["version"];
    const bool isWhole = version.is_number_integer() && version >= 0;
    const int oldest = steps.empty() ? current : steps.front().from;
    if (!isWhole || version < oldest || version > current) {
        findings.error("/version",
                       "found " + foundText(version) + "; this library reads versions " +
                           std::to_string(oldest) + " to " + std::to_string(current),
                       isWhole ? base::Code::Version : base::Code::Schema);
        return false;
    }
    const int found = version.get<int>();
    for (const MigrationStep& step : steps)
        if (step.from >= found)
            step.apply(document, findings);
    if (found < current) {
        document["version"] = current;
        findings.warning("/version", "version " + std::to_string(found) + " was read as version " +
                                         std::to_string(current) + "; save the file in the new form");
    }
    return true;
}

} // namespace fx::preset
