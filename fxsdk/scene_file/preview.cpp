#include "fxsdk/scene_file/preview.h"

#include "fxsdk/presets/json_parser.h"
#include "fxsdk/presets/migration.h"
#include "fxsdk/scene_file/scene_members.h"
#include "rendering/stage/scale_figure.h"
#include "rendering/stage/stage_props.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace fx::scene_file {

namespace {

using preset::Findings;
using preset::PresetValue;

/// Gives the soil a mean albedo around the effect, and keeps its patches.
void colorSoil(const glm::vec3& color, render::StageMesh& io)
{
    constexpr float kAround = 60.0f; // [m]
    if (!io.isSoil)
        return;
    glm::vec3 sum(0.0f);
    float count = 0.0f;
    for (size_t i = 0; i < io.positions.size(); ++i)
        if (glm::length(io.positions[i]) < kAround) {
            sum += io.colors[i];
            count += 1.0f;
        }
    const glm::vec3 ratio = color * count / glm::max(sum, glm::vec3(1e-6f));
    for (glm::vec3& each : io.colors)
        each = glm::min(each * ratio, glm::vec3(1.0f));
}

void readProps(const PresetValue& value, const asset::AssetResolver& resolver, Findings& findings,
               render::StageMesh& io)
{
    const base::Result<render::StageMesh> mesh = readMeshMember(value, resolver, findings);
    if (!mesh)
        return;
    render::PropPlacement placement;
    value.read("position", placement.position);
    value.read("headingDegrees", placement.headingDegrees);
    value.read("scale", placement.scale);
    render::addStageProps(io, *mesh, placement);
}

Preview readParts(const PresetValue& value, const asset::AssetResolver& resolver, Findings& findings,
                  SceneFile& scene)
{
    Preview preview;
    if (value.has("time"))
        value.read("time", preview.time.emplace());
    preview.hasCamera = value.has("camera");
    if (preview.hasCamera)
        scene.camera = readCamera(value.child("camera"));
    const render::ViewSettings view = readView(value);
    if (value.has("exposureEv100"))
        scene.view.exposureEv100 = view.exposureEv100;
    if (value.has("lighting"))
        scene.view.lighting = view.lighting;
    if (value.has("background"))
        readBackground(value.child("background"), resolver, findings, scene);
    if (value.has("groundColor")) {
        glm::vec3 color(0.0f);
        value.read("groundColor", color);
        colorSoil(color, scene.mesh);
    }
    readSceneMesh(value.child("mesh"), resolver, findings, scene);
    if (value.has("props"))
        readProps(value.child("props"), resolver, findings, scene.mesh);
    if (value.has("figure")) {
        render::ScaleFigure figure;
        value.child("figure").read("position", figure.position);
        value.child("figure").read("headingDegrees", figure.headingDegrees);
        render::addScaleFigure(scene.mesh, figure);
    }
    if (value.has("instance")) {
        const size_t index = scene.instances[0].preset;
        scene.instances[0] = readInstance(value.child("instance"));
        scene.instances[0].preset = index;
        checkTriggers(value.child("instance"), scene.instances[0].play,
                      scene.presets[index].effect->hostEvents);
    }
    return preview;
}

} // namespace

base::Result<Preview> readPreview(std::string_view text, const std::string& displayName,
                                  const asset::AssetResolver& resolver, SceneFile& io,
                                  std::vector<preset::Diagnostic>* outDiagnostics)
{
    Findings findings;
    Preview preview;
    std::optional<nlohmann::json> document = preset::parseJson(text, preset::kPresetLimits, findings);
    if (document && preset::migrate(*document, preset::kPresetVersion, preset::presetMigrations(), findings))
    {
        const PresetValue root(&*document, "", findings);
        if (root.has("preview"))
            preview = readParts(root.child("preview"), resolver, findings, io);
    }
    std::vector<preset::Diagnostic> found = findings.locate(text, displayName);
    std::erase_if(found, [](const auto& f) { return !f.pointer.starts_with("/preview"); }); // the loader's
    if (outDiagnostics)
        outDiagnostics->insert(outDiagnostics->end(), found.begin(), found.end());
    if (findings.hasErrors())
        return base::Status(findings.firstCode(), preset::summary(found));
    return preview;
}

} // namespace fx::scene_file
