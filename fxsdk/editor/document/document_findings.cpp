#include "fxsdk/editor/document/document_findings.h"

#include "foundation/result/nearest_name.h"
#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/preview.h"
#include "fxsdk/scene_file/scene_file.h"

#include <algorithm>
#include <array>

namespace fx::editor {

namespace {

std::vector<preset::Diagnostic> validate(const Document& document)
{
    std::vector<preset::Diagnostic> diagnostics;
    const std::string& name = document.path();
    const std::string folder = preset::folderOf(name);
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, preset::libraryFiles());
    const std::string text = document.text();
    if (document.kind() == DocumentKind::Scene) {
        (void)scene_file::loadSceneText(text, name, resolver, &diagnostics);
        return diagnostics;
    }
    const auto loaded = preset::loadPresetText(text, name, &diagnostics, &resolver);
    if (!loaded)
        return diagnostics;
    scene_file::SceneFile scene;
    scene.presets.push_back({name, text, name, loaded->effect});
    scene.instances.emplace_back();
    std::vector<preset::Diagnostic> ofPreview;
    (void)scene_file::readPreview(text, name, resolver, scene, &ofPreview);
    diagnostics.insert(diagnostics.end(), ofPreview.begin(), ofPreview.end());
    return diagnostics;
}

std::optional<Remedy> nearestOf(const Json& choices, const Json& value, const std::string& pointer)
{
    if (!value.is_string() || std::find(choices.begin(), choices.end(), value) != choices.end())
        return std::nullopt;
    std::string best;
    for (const Json& choice : choices) {
        const std::array<std::string, 1> name{choice.is_string() ? choice.get<std::string>() : std::string()};
        if (!base::didYouMean(value.get<std::string>(), name).empty())
            best = name[0];
    }
    if (best.empty())
        return std::nullopt;
    return Remedy{"set to \"" + best + "\"", pointer, Json(best)};
}

std::optional<Remedy> nearestInRange(const Json& schema, const Json& value, const std::string& pointer)
{
    if (!value.is_number())
        return std::nullopt;
    const double number = value.get<double>();
    for (const char* bound : {"minimum", "maximum"}) {
        if (!schema.contains(bound))
            continue;
        const double limit = schema[bound].get<double>();
        if (bound[1] == 'i' ? number < limit : number > limit)
            return Remedy{"set to " + schema[bound].dump(), pointer, schema[bound]};
    }
    return std::nullopt;
}

} // namespace

std::optional<Remedy> remedyFor(const Document& document, const std::string& pointer)
{
    const Json::json_pointer target(pointer);
    if (target.empty() || !document.json().contains(target))
        return std::nullopt;
    const Json& value = document.json().at(target);
    const Json* const schema = schemaAt(document.schema(), document.json(), target);
    if (!schema)
        return Remedy{"remove", pointer, std::nullopt};
    const Json& part = decided(*schema, value);
    if (part.contains("enum"))
        return nearestOf(part["enum"], value, pointer);
    return nearestInRange(part, value, pointer);
}

std::vector<DocumentFinding> findingsOf(const Document& document)
{
    std::vector<DocumentFinding> findings;
    for (preset::Diagnostic& diagnostic : validate(document)) {
        std::optional<Remedy> remedy = remedyFor(document, diagnostic.pointer);
        const bool isRemovable = diagnostic.warning && !diagnostic.pointer.empty() &&
                                 document.json().contains(Json::json_pointer(diagnostic.pointer));
        if (!remedy && isRemovable && diagnostic.message.find("remove it") != std::string::npos)
            remedy = Remedy{"remove", diagnostic.pointer, std::nullopt};
        findings.push_back({std::move(diagnostic), std::move(remedy)});
    }
    return findings;
}

base::Status applyRemedy(Document& io, const Remedy& remedy)
{
    return remedy.value ? io.set(remedy.pointer, *remedy.value) : io.erase(remedy.pointer);
}

} // namespace fx::editor
