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

std::vector<preset::Diagnostic> validate(const std::string& text, const std::string& name, DocumentKind kind)
{
    std::vector<preset::Diagnostic> diagnostics;
    const std::string folder = preset::folderOf(name);
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, preset::libraryFiles());
    if (kind == DocumentKind::Scene) {
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

/// Whether a message says that the member can go.
bool saysRemove(const std::string& message)
{
    constexpr std::array<std::string_view, 3> kWords{"remove it", "take it out", "has no effect"};
    return std::any_of(kWords.begin(), kWords.end(),
                       [&](std::string_view words) { return message.find(words) != std::string::npos; });
}

/// Adds the defaults of absent members, which changes nothing of an effect.
void addDefaults(const Json& schema, Json& io)
{
    const Json& part = decided(schema, io);
    if (!io.is_object() || !part.contains("properties"))
        return;
    const Json& properties = part["properties"];
    for (auto it = properties.begin(); it != properties.end(); ++it)
        if (!io.contains(it.key())) {
            if (it->contains("default"))
                io[it.key()] = (*it)["default"];
        } else
            addDefaults(*it, io[it.key()]);
}

} // namespace

std::map<std::string, std::string> unusedMembersOf(const Document& document, const std::string& pointer)
{
    std::map<std::string, std::string> unused;
    const Json::json_pointer at(pointer);
    const Json* const schema = schemaAt(document.schema(), document.json(), at);
    if (!schema || !document.json().contains(at) || document.kind() != DocumentKind::Preset || at.empty())
        return unused;
    Json probe = document.json();
    addDefaults(*schema, probe[at]);
    for (const preset::Diagnostic& found : validate(probe.dump(), document.path(), document.kind()))
        if (found.warning && saysRemove(found.message) && found.pointer.starts_with(pointer + "/") &&
            !document.json().contains(Json::json_pointer(found.pointer)))
            unused[found.pointer] =
                found.message.substr(0, std::min(found.message.find(": take"), found.message.find("; ")));
    return unused;
}

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

namespace {

bool isRequired(const Document& document, const Json::json_pointer& member)
{
    const Json::json_pointer around = member.parent_pointer();
    const Json* const schema = schemaAt(document.schema(), document.json(), around);
    if (!schema || !document.json().at(around).is_object())
        return false;
    const Json required = decided(*schema, document.json().at(around)).value("required", Json::array());
    return std::find(required.begin(), required.end(), Json(member.back())) != required.end();
}

} // namespace

std::vector<DocumentFinding> findingsOf(const Document& document)
{
    std::vector<DocumentFinding> findings;
    for (preset::Diagnostic& diagnostic : validate(document.text(), document.path(), document.kind())) {
        std::optional<Remedy> remedy = remedyFor(document, diagnostic.pointer);
        const bool isRemovable =
            !diagnostic.pointer.empty() && document.json().contains(Json::json_pointer(diagnostic.pointer));
        if (!remedy && isRemovable && saysRemove(diagnostic.message) &&
            !isRequired(document, Json::json_pointer(diagnostic.pointer)))
            remedy = Remedy{"take it out", diagnostic.pointer, std::nullopt};
        findings.push_back({std::move(diagnostic), std::move(remedy)});
    }
    return findings;
}

base::Status applyRemedy(Document& io, const Remedy& remedy)
{
    return remedy.value ? io.set(remedy.pointer, *remedy.value) : io.erase(remedy.pointer);
}

} // namespace fx::editor
