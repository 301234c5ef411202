#include "fxsdk/scene_file/scene_file.h"

#include "foundation/math/euler.h"
#include "foundation/snapshot/volume_kind.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/presets/json_parser.h"
#include "fxsdk/presets/migration.h"
#include "fxsdk/presets/order_members.h"
#include "fxsdk/presets/schema_assembly.h"
#include "fxsdk/presets/schema_validator.h"
#include "fxsdk/scene_file/key_interpolation.h"
#include "fxsdk/scene_file/scene_members.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>

namespace fx::scene_file {

namespace {

using Json = nlohmann::json;
using preset::Findings;
using preset::PresetValue;

/// What reading one scene works with.
struct Reader
{
    const asset::AssetResolver& resolver;
    Findings& findings;
    SceneFile& scene;
    std::map<std::string, size_t> presetIndices; ///< by name
    std::map<std::string, std::string> failures; ///< presets that cannot be used, with the reason
};

/// Warns when an emitter uses the scene's geometry and the scene has none. The preset is valid.
void lintGeometry(Reader& reader, const PresetValue& instance, const std::string& name,
                  const std::string& text)
{
    const bool hasGeometry = !reader.scene.mesh.positions.empty() && reader.scene.meshCollides;
    const Json preset = Json::parse(text, nullptr, false);
    if (hasGeometry || !preset.is_object())
        return;
    for (const Json& emitter : preset.value("emitters", Json::array()))
        for (const Json& obstacle : emitter.value("collisions", Json::array()))
            if (obstacle.value("shape", std::string()) == "scene")
                return instance.warning(
                    "preset", name + ": an emitter collides with the shape \"scene\", but no mesh of "
                                     "this scene stands in the way; add \"mesh\": {\"file\": "
                                     "\"NAME.obj\", \"collide\": true} to the scene");
}

/// Index of the preset called `name`, loaded when it is met for the first time; nothing after a failure.
std::optional<size_t> findPreset(Reader& reader, const std::string& name, const PresetValue& instance)
{
    if (const auto found = reader.presetIndices.find(name); found != reader.presetIndices.end())
        return found->second;
    if (reader.failures.count(name) > 0)
        return std::nullopt; // said once
    base::Result<std::string> text = reader.resolver.read(name, preset::kPresetBytes);
    if (!text) {
        reader.failures[name] = text.status().message();
        reportAsset(instance, "preset", text.status(), reader.findings);
        return std::nullopt;
    }
    const bool isInLibrary = name.starts_with("library:");
    const base::Result<preset::LoadedPreset> loaded = preset::loadPresetText(
        *text, name, nullptr, &reader.resolver, {}, isInLibrary ? std::string() : preset::folderOf(name));
    if (!loaded) {
        reader.failures[name] = loaded.status().message();
        reportAsset(instance, "preset", loaded.status(), reader.findings);
        return std::nullopt;
    }
    for (const preset::Diagnostic& warning : loaded->warnings)
        instance.warning("preset", preset::toString(warning));
    lintGeometry(reader, instance, name, *text);
    const size_t index = reader.scene.presets.size();
    const bool isFile = !isInLibrary && !reader.resolver.folder().empty();
    reader.scene.presets.push_back({name, std::move(*text),
                                    isFile ? reader.resolver.folder() + "/" + name : std::string(),
                                    loaded->effect});
    reader.presetIndices[name] = index;
    return index;
}

void readInstances(Reader& reader, const PresetValue& root)
{
    for (size_t i = 0; i < root.size("instances") && !reader.findings.full(); ++i) {
        const PresetValue value = root.element("instances", i);
        SceneInstance instance = readInstance(value);
        std::string name;
        value.read("preset", name);
        if (const std::optional<size_t> index = findPreset(reader, name, value)) {
            instance.preset = *index;
            checkTriggers(value, instance.play, reader.scene.presets[*index].effect->hostEvents);
            reader.scene.instances.push_back(instance);
        }
    }
}

/// Calls `lint(preset, instance)` once for each preset of the scene that could be used, with the first of its
/// instances.
template <typename Lint>
void lintPresets(const Reader& reader, const PresetValue& root, const Lint& lint)
{
    std::set<size_t> seen;
    for (size_t i = 0; i < root.size("instances"); ++i) {
        const PresetValue instance = root.element("instances", i);
        std::string name;
        instance.read("preset", name);
        const auto index = reader.presetIndices.find(name);
        if (index != reader.presetIndices.end() && seen.insert(index->second).second)
            lint(reader.scene.presets[index->second], instance);
    }
}

/// Whether the scene sums particles up without an order.
bool sumsUp(const SceneFile& scene)
{
    if (scene.view.composition != render::Composition::Automatic)
        return scene.view.composition != render::Composition::Sorted;
    return preset::sumsUp(preferredHints(scene).composition);
}

/// Warns where a preset orders its particles and the scene sums them up. Presets that ask for a sum
/// themselves have been warned of already.
void lintOrder(const Reader& reader, const PresetValue& root)
{
    if (!sumsUp(reader.scene))
        return;
    lintPresets(reader, root, [](const ScenePreset& preset, const PresetValue& instance) {
        if (preset::sumsUp(preset.effect->hints.composition))
            return;
        for (const preset::OrderMember& member :
             preset::orderMembers(Json::parse(preset.text, nullptr, false)))
            instance.warning("preset", preset.name + ": " + member.pointer + ": " +
                                           preset::orderWarning(member) +
                                           "; remove it, or give the scene \"composition\": \"sorted\"");
    });
}

/// Warns where a preset asks for voxels and the scene draws balls.
void lintVolumes(const Reader& reader, const PresetValue& root)
{
    const render::Composition composition = reader.scene.view.composition;
    if (composition == render::Composition::Automatic || composition == render::Composition::Volume)
        return;
    lintPresets(reader, root, [](const ScenePreset& preset, const PresetValue& instance) {
        if (preset.effect->publishes(base::kVolumeKind) &&
            preset.effect->hints.composition == sim::PreferredComposition::Volume)
            instance.warning("preset", preset.name + ": its voxels are drawn as blurred balls; give the "
                                                     "scene \"composition\": \"automatic\"");
    });
}

/// Fills `scene`; false when `findings` has errors.
bool readScene(std::string_view text, const asset::AssetResolver& resolver, Findings& findings,
               SceneFile& scene)
{
    constexpr std::array<std::string_view, 2> kLongArrays{"/instances", "/camera/keys"};
    std::optional<Json> document = preset::parseJson(text, preset::kSceneLimits, findings);
    if (!document || !preset::migrate(*document, preset::kSceneVersion, preset::sceneMigrations(), findings))
        return false;
    const preset::SchemaValidator validator{Json(preset::sceneSchema())};
    validator.validate(*document, kLongArrays, findings);
    if (findings.hasErrors())
        return false;

    const PresetValue root(&*document, "", findings);
    Reader reader{resolver, findings, scene, {}, {}};
    root.read("name", scene.name);
    scene.camera = readCamera(root.child("camera"));
    for (size_t i = 0; i < root.size("lights"); ++i)
        scene.lights.push_back(readLight(root.element("lights", i)));
    scene.view = readView(root);
    readBackground(root.child("background"), resolver, findings, scene);
    readSceneMesh(root.child("mesh"), resolver, findings, scene);
    readInstances(reader, root);
    lintOrder(reader, root);
    lintVolumes(reader, root);
    return !findings.hasErrors();
}

} // namespace

sim::DrawingHints preferredHints(const SceneFile& scene)
{
    sim::DrawingHints most;
    for (const SceneInstance& instance : scene.instances)
        most = sim::greatest(most, scene.presets[instance.preset].effect->hints);
    return most;
}

base::Placement SceneInstance::placementAt(double time) const
{
    return {play.moves ? smoothAt(play.keys, time, &InstanceKey::position) : position,
            play.turns ? base::rotationOf(smoothAt(play.keys, time, &InstanceKey::rotationDegrees))
                       : rotation,
            scale};
}

base::Result<SceneFile> loadSceneText(std::string_view text, const std::string& displayName,
                                      const asset::AssetResolver& resolver,
                                      std::vector<preset::Diagnostic>* outDiagnostics)
{
    Findings findings;
    SceneFile scene;
    scene.name = displayName;
    const bool isUsable = readScene(text, resolver, findings, scene);
    scene.warnings = findings.locate(text, displayName);
    if (outDiagnostics)
        *outDiagnostics = scene.warnings;
    if (!isUsable)
        return base::Status(findings.firstCode(), preset::summary(scene.warnings));
    return scene;
}

base::Result<SceneFile> loadSceneFile(const std::string& path,
                                      std::vector<preset::Diagnostic>* outDiagnostics)
{
    const base::Result<std::string> text = asset::readFile(path, kSceneBytes);
    if (!text) {
        if (outDiagnostics)
            *outDiagnostics = {{path, 0, 0, "", preset::printable(text.status().message(), 1000), false}};
        return text.status();
    }
    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    const asset::AssetResolver resolver(folder, preset::libraryFiles());
    return loadSceneText(*text, path, resolver, outDiagnostics);
}

} // namespace fx::scene_file
