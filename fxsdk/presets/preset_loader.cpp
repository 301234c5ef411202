#include "fxsdk/presets/preset_loader.h"

#include "embedded/preset_library.h"
#include "foundation/math/euler.h"
#include "foundation/math/hash.h"
#include "foundation/snapshot/blob_kind.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/presets/effect_cost.h"
#include "fxsdk/presets/json_parser.h"
#include "fxsdk/presets/migration.h"
#include "fxsdk/presets/order_members.h"
#include "fxsdk/presets/schema_assembly.h"
#include "fxsdk/presets/schema_validator.h"

#include <glm/geometric.hpp>

#include <array>
#include <span>
#include <utility>

namespace fx::preset {

namespace {

using Json = nlohmann::json;

/// The same for documents that say the same in another order or with other blanks. How it is shown is no part
/// of an effect.
uint64_t fingerprintOf(Json document)
{
    document.erase("preview");
    document.erase("composition");
    document.erase("scattering");
    const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    return base::hashBytes(0, text.data(), text.size());
}

constexpr std::array<std::pair<std::string_view, sim::CatchUp>, 5> kPolicies{{
    {"analytic", sim::CatchUp::Analytic},
    {"replay", sim::CatchUp::Replay},
    {"coarse", sim::CatchUp::Coarse},
    {"skip", sim::CatchUp::Skip},
    {"authoritative", sim::CatchUp::Authoritative},
}};

void readOffscreen(const PresetValue& root, sim::EffectDef& effect)
{
    if (!root.has("offscreen"))
        return;
    sim::CatchUp policy = sim::CatchUp::Replay;
    root.read("offscreen", std::span<const std::pair<std::string_view, sim::CatchUp>>(kPolicies), policy);
    effect.offscreen = policy;
}

constexpr std::array<std::pair<std::string_view, sim::PreferredComposition>, 3> kCompositions{{
    {"sorted", sim::PreferredComposition::Sorted},
    {"slabs", sim::PreferredComposition::Slabs},
    {"volume", sim::PreferredComposition::Volume},
}};

constexpr std::array<std::pair<std::string_view, sim::PreferredScattering>, 4> kScatterings{{
    {"automatic", sim::PreferredScattering::Automatic},
    {"single", sim::PreferredScattering::Single},
    {"closed_form", sim::PreferredScattering::ClosedForm},
    {"network", sim::PreferredScattering::Network},
}};

void readHints(const PresetValue& root, sim::DrawingHints& hints)
{
    root.read("composition",
              std::span<const std::pair<std::string_view, sim::PreferredComposition>>(kCompositions),
              hints.composition);
    root.read("scattering",
              std::span<const std::pair<std::string_view, sim::PreferredScattering>>(kScatterings),
              hints.scattering);
}

/// The camera of the stage as one relative to the instance that stands there.
void moveToInstance(const PresetValue& instance, sim::PreviewDef& io)
{
    glm::dvec3 position(0.0), degrees(0.0);
    std::array<float, 4> xyzw{0, 0, 0, 1};
    double scale = 1.0;
    instance.read("position", position);
    instance.read("rotationDegrees", degrees);
    instance.read("quaternion", xyzw);
    instance.read("scale", scale);
    glm::dquat rotation{double(xyzw[3]), double(xyzw[0]), double(xyzw[1]), double(xyzw[2])};
    const double length = glm::length(rotation);
    rotation = instance.has("quaternion") && length > 1e-6 ? rotation / length
                                                           : glm::dquat(base::rotationOf(degrees));
    if (!(scale > 0.0)) // tools report it
        return;
    for (glm::dvec3* const place : {&io.cameraPosition, &io.cameraTarget})
        *place = glm::conjugate(rotation) * (*place - position) / scale;
}

/// Tools report the faults of a preview, and read all of its members.
void readPreview(const PresetValue& root, sim::PreviewDef& preview)
{
    if (!root.has("preview"))
        return;
    const PresetValue value = root.child("preview");
    value.read("time", preview.seconds);
    value.read("exposureEv100", preview.exposureEv100);
    if (value.has("lighting")) {
        const PresetValue lighting = value.child("lighting");
        glm::vec3 direction(0.3f, 0.8f, 0.5f);
        lighting.read("sunDirection", direction);
        if (const float length = glm::length(direction); length >= 1e-6f)
            preview.sunDirection = direction / length;
        preview.sunIlluminance = preview.skyLuminance = glm::vec3(0.0f);
        lighting.read("sunIlluminance", preview.sunIlluminance);
        lighting.read("skyLuminance", preview.skyLuminance);
        lighting.read("groundAlbedo", preview.groundAlbedo);
    }
    const PresetValue camera = value.child("camera");
    preview.hasCamera = camera.has("position") && camera.has("target");
    camera.read("position", preview.cameraPosition);
    camera.read("target", preview.cameraTarget);
    camera.read("fovYDegrees", preview.fovYDegrees);
    if (value.has("instance"))
        moveToInstance(value.child("instance"), preview);
}

/// Warns of a way to scatter light that has no effect: sorted balls have no networks, and without a medium
/// nothing scatters.
void lintScattering(const PresetValue& root, const sim::EffectDef& effect)
{
    using sim::PreferredScattering;
    const PreferredScattering scattering = effect.hints.scattering;
    if (scattering == PreferredScattering::Automatic)
        return;
    if (!effect.publishes(base::kBlobKind))
        root.warning("scattering", "the effect has no medium that scatters light; remove it");
    else if (scattering == PreferredScattering::Network && !sumsUp(effect.hints.composition))
        root.warning("scattering", "\"network\" needs \"composition\": \"volume\" or \"slabs\": sorted balls "
                                   "scatter light by the closed form; add it, or remove \"scattering\"");
}

/// Warns of members that order particles, where the preset is made to be summed up.
void lintOrder(const Json& document, const sim::EffectDef& effect, Findings& findings)
{
    if (!sumsUp(effect.hints.composition))
        return;
    for (const OrderMember& member : orderMembers(document))
        findings.warning(member.pointer, orderWarning(member) + "; remove it, or \"composition\"");
}

/// Parts of a load: the file, its text, its elements, and what they have to do with each other.
constexpr float kTextBegins = 0.05f, kElementsBegin = 0.2f, kElementsEnd = 0.9f;

void buildElements(const PresetValue& root, Techniques techniques, const Findings& findings,
                   sim::EffectDef& effect)
{
    asset::LoadMonitor* const monitor = findings.assets()->monitor();
    size_t all = 0, built = 0;
    for (const Technique& technique : techniques)
        all += root.size(std::string(technique.presetMember).c_str());
    const auto place = [&](size_t count) {
        return kElementsBegin + (kElementsEnd - kElementsBegin) * float(count) / float(all);
    };
    for (const Technique& technique : techniques) {
        const std::string member(technique.presetMember);
        const size_t count = root.size(member.c_str());
        for (size_t i = 0; i < count; ++i, ++built) {
            if (monitor)
                monitor->beginPart(member + " " + std::to_string(i + 1) + " of " + std::to_string(count),
                                   place(built), place(built + 1));
            technique.build(root.element(member.c_str(), i), effect);
        }
    }
    if (monitor)
        monitor->beginPart("links and estimates", kElementsEnd, 1.0f);
}

std::shared_ptr<const sim::EffectDef> buildEffect(const Json& document, const std::string& displayName,
                                                  Techniques techniques, Findings& findings)
{
    auto effect = std::make_shared<sim::EffectDef>();
    const PresetValue root(&document, "", findings);
    effect->name = displayName;
    effect->fingerprint = fingerprintOf(document);
    root.read("name", effect->name);
    double duration = 0;
    root.read("duration", duration);
    effect->duration = base::toTicks(duration);
    double prewarm = 0;
    root.read("prewarm", prewarm);
    effect->prewarm = base::toTicks(prewarm);
    root.read("subSteps", effect->subSteps);
    root.read("wind", effect->wind);
    root.read("ground", effect->hasGround);
    root.read("bound", effect->bound);
    readOffscreen(root, *effect);
    readHints(root, effect->hints);
    readPreview(root, effect->preview);
    buildElements(root, techniques, findings, *effect);
    for (const Technique& technique : techniques)
        if (technique.link)
            technique.link(root, *effect);
    const bool isValid = !findings.hasErrors();
    for (const Technique& technique : techniques)
        if (isValid && technique.lint)
            technique.lint(root, *effect);
    if (isValid) {
        lintOrder(document, *effect, findings);
        lintScattering(root, *effect);
    }
    if (isValid)
        estimateCost(root, *effect, techniques);
    if (findings.assets()->contentHash() != 0)
        effect->fingerprint = base::hashWord(effect->fingerprint, findings.assets()->contentHash());
    if (effect->solvers.empty() && !findings.hasErrors())
        findings.warning("", "the preset has no emitters and no gas: there will be nothing to see");
    return effect;
}

/// The validator of the built-in techniques is kept for the life of the process: to compile their schema
/// takes longer than to load most presets.
void validateSchema(Json& document, Techniques techniques, Findings& findings)
{
    const Techniques builtIn = preset::techniques();
    if (techniques.data() == builtIn.data() && techniques.size() == builtIn.size()) {
        static const SchemaValidator kept{Json(presetSchema(builtIn))};
        return kept.validate(document, {}, findings);
    }
    const SchemaValidator validator{Json(presetSchema(techniques))};
    validator.validate(document, {}, findings);
}

/// The effect, or null when `findings` has errors.
std::shared_ptr<const sim::EffectDef> readPreset(std::string_view text, const std::string& displayName,
                                                 Techniques techniques, Findings& findings)
{
    std::optional<Json> document = parseJson(text, kPresetLimits, findings);
    if (!document || !migrate(*document, kPresetVersion, presetMigrations(), findings))
        return nullptr;
    validateSchema(*document, techniques, findings);
    if (findings.hasErrors())
        return nullptr;
    std::shared_ptr<const sim::EffectDef> effect = buildEffect(*document, displayName, techniques, findings);
    return findings.hasErrors() ? nullptr : effect;
}

/// Reports a file that could not be read in the form of the other findings.
base::Status unreadable(const base::Status& status, const std::string& displayName,
                        std::vector<Diagnostic>* outDiagnostics)
{
    if (outDiagnostics)
        *outDiagnostics = {Diagnostic{displayName, 0, 0, "", printable(status.message(), 1000), false}};
    return status;
}

/// States that the text of a preset is about to be read.
void beginText(const PresetAssets& assets, std::string_view name)
{
    if (!assets.monitor)
        return;
    assets.monitor->beginPart(name, 0.0f, kTextBegins);
    assets.monitor->beginFile(name);
}

} // namespace

std::span<const base::EmbeddedText> presetLibrary()
{
    const std::span<const base::EmbeddedText> files = library::texts(); // presets come first
    size_t presets = 0;
    while (presets < files.size() && files[presets].name.ends_with(".fx.json"))
        ++presets;
    return files.first(presets);
}

std::span<const base::EmbeddedText> libraryFiles()
{
    return library::texts();
}

std::string folderOf(std::string_view name)
{
    const size_t slash = name.find_last_of('/');
    return std::string(name.substr(0, slash == std::string_view::npos ? 0 : slash + 1));
}

base::Result<LoadedPreset> loadPresetText(std::string_view text, const std::string& displayName,
                                          std::vector<Diagnostic>* outDiagnostics,
                                          const asset::AssetResolver* resolver, const PresetAssets& assets,
                                          const std::string& folder, Techniques techniques)
{
    const asset::AssetResolver libraryOnly("", libraryFiles());
    std::unique_ptr<base::AssetTable> forgotten;
    if (!assets.table)
        forgotten = std::make_unique<base::AssetTable>(std::pmr::get_default_resource());
    asset::AssetLoader loader(resolver ? *resolver : libraryOnly, assets.table ? *assets.table : *forgotten,
                              assets.missing, folder, assets.monitor);
    Findings findings(&loader);
    if (assets.monitor)
        assets.monitor->beginPart(displayName, kTextBegins, kElementsBegin);
    std::shared_ptr<const sim::EffectDef> effect = readPreset(text, displayName, techniques, findings);
    std::vector<Diagnostic> diagnostics = findings.locate(text, displayName);
    if (outDiagnostics)
        *outDiagnostics = diagnostics;
    if (!effect)
        return base::Status(findings.firstCode(), summary(diagnostics));
    return LoadedPreset{std::move(effect), std::move(diagnostics)};
}

base::Result<LoadedPreset> loadPresetAsset(std::string_view name, const asset::AssetResolver& resolver,
                                           std::vector<Diagnostic>* outDiagnostics,
                                           const PresetAssets& assets, Techniques techniques)
{
    beginText(assets, name);
    const base::Result<std::string> text = resolver.read(name, kPresetBytes);
    if (!text)
        return unreadable(text.status(), std::string(name), outDiagnostics);
    return loadPresetText(*text, std::string(name), outDiagnostics, &resolver, assets,
                          name.starts_with("library:") ? std::string() : folderOf(name), techniques);
}

base::Result<LoadedPreset> loadPresetFile(const std::string& path, std::vector<Diagnostic>* outDiagnostics,
                                          const PresetAssets& assets, Techniques techniques)
{
    beginText(assets, path);
    const base::Result<std::string> text = asset::readFile(path, kPresetBytes);
    if (!text)
        return unreadable(text.status(), path, outDiagnostics);
    const std::string folder = folderOf(path);
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, libraryFiles());
    return loadPresetText(*text, path, outDiagnostics, &resolver, assets, {}, techniques);
}

} // namespace fx::preset
