/// @file explain_command.cpp
/// fx explain: what a moment of a scene costs, and which effect called for it.

#include "foundation/snapshot/blob_kind.h"
#include "foundation/tasks/work_budget.h"
#include "fxsdk/cli/commands.h"
#include "fxsdk/cli/render/frame_renderer.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/scene/view_settings.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/presets/order_members.h"
#include "fxsdk/techniques.h"
#include "rendering/field/field_glow_plan.h"
#include "rendering/field/network_choice.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/techniques/draw_techniques.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {
namespace {

using Json = nlohmann::json;

struct ExplainOptions
{
    std::string input;
    double time = 1.0;        ///< [s]
    int size = 256;           ///< [pixel]
    float lodBias = 0;        ///< [1]
    float impostorPixels = 0; ///< [pixel]
    bool everything = false;
    bool json = false;
};

constexpr std::array<const char*, 6> kStates{"dormant", "active", "finished", "waking", "resting", "hidden"};
constexpr std::array<const char*, 10> kReasons{
    "",         "not started",       "outside of the view", "too far",       "too small",
    "occluded", "beyond the budget", "catching up",         "nothing moves", "ended"};
constexpr std::array<const char*, 4> kLights{"sun", "host", "effect", "sky"};
constexpr std::array<const char*, 5> kPolicies{"analytic", "replay", "coarse", "skip", "authoritative"};

/// The scene's camera as the scene's only focus.
base::Status lookThroughCamera(const scene_file::SceneFile& file, const ExplainOptions& options,
                               FxScene* scene)
{
    FxFocus focus = fxDefaultFocus();
    focus.height = float(options.size);
    const glm::dvec3 eye = file.camera.at(options.time).position;
    std::copy_n(glm::value_ptr(eye), 3, focus.origin);
    std::copy_n(glm::value_ptr(file.camera.viewRotation(options.time)), 16, focus.view);
    std::copy_n(glm::value_ptr(file.camera.projection(1.0f)), 16, focus.projection);
    return toStatus(fxScene_SetFocus(scene, &focus, 1));
}

Json instancesOf(const scene_file::SceneFile& file, FxScene* scene, double time)
{
    std::vector<FxInstanceId> ids(file.instances.size());
    uint32_t count = 0;
    Json list = Json::array();
    if (fxScene_GetInstances(scene, ids.data(), uint32_t(ids.size()), &count) != FX_OK)
        return list;
    for (uint32_t i = 0; i < count; ++i) {
        FxInstanceActivity activity = {};
        activity.structSize = sizeof activity;
        if (fxScene_GetInstanceActivity(scene, ids[i], &activity) != FX_OK)
            continue;
        const scene_file::SceneInstance& instance = file.instances[i];
        const glm::dvec3 place = instance.placementAt(time).position;
        list.push_back({{"instance", i},
                        {"position", {place.x, place.y, place.z}},
                        {"speed", scene_file::valueAt(instance.play.speed, time, 1.0)},
                        {"emitting", scene_file::valueAt(instance.play.emitting, time, 1.0) > 0.0},
                        {"preset", file.presets[file.instances[i].preset].name},
                        {"state", kStates.at(activity.state)},
                        {"reason", kReasons.at(activity.reason)},
                        {"offscreen", kPolicies.at(activity.policy)},
                        {"particles", activity.particles},
                        {"lag_s", base::toSeconds(activity.lagTicks)},
                        {"significance", activity.significance},
                        {"ms_estimated", activity.milliseconds}});
    }
    return list;
}

/// Names of the presets of active instances for which `uses` is true.
template <typename F>
Json callersOf(const scene_file::SceneFile& file, const Json& instances, F&& uses)
{
    std::vector<std::string> names;
    for (const Json& entry : instances) {
        if (entry["state"] != "active")
            continue;
        const auto& used = file.presets[file.instances[entry["instance"].get<size_t>()].preset];
        if (std::find(names.begin(), names.end(), used.name) == names.end() && uses(used))
            names.push_back(used.name);
    }
    return names;
}

bool hasMember(const scene_file::ScenePreset& used, std::string_view member)
{
    return Json::parse(used.text, nullptr, false).contains(std::string(member));
}

bool isUsed(const render::DrawTechnique& technique, const sim::EffectDef& effect)
{
    std::vector<const base::KindDesc*> kinds;
    for (const preset::Technique& publisher : preset::techniques())
        std::copy_if(publisher.kinds.begin(), publisher.kinds.end(), std::back_inserter(kinds),
                     [&](const base::KindDesc* kind) { return effect.publishes(*kind); });
    return render::isUsed(technique, {kinds, render::isDrawn(kinds), effect.bendsLight()});
}

/// Whether each emitter is computed on CPU or GPU, and the reason. Emitters move to the GPU once a view has
/// drawn the scene, and while no reader requests rows.
Json emittersOf(const scene_file::SceneFile& file)
{
    Json list = Json::array();
    for (const scene_file::ScenePreset& preset : file.presets)
        for (const sim::EmitterDef* const emitter : sim::emittersOf(*preset.effect)) {
            if (!emitter)
                continue;
            const std::string_view why = sim::gpuObstacle(*emitter);
            list.push_back({{"preset", preset.name},
                            {"emitter", emitter->name},
                            {"path", why.empty() ? "gpu" : "cpu"},
                            {"meets_depth", emitter->meetsDepth && why.empty()},
                            {"bytes", emitter->bytes()},
                            {"why", std::string(why)}});
        }
    return list;
}

/// What an instance of each preset is expected to need.
Json needsOf(const scene_file::SceneFile& file)
{
    Json list = Json::array();
    for (const scene_file::ScenePreset& preset : file.presets) {
        const sim::EffectCost& cost = preset.effect->cost;
        list.push_back({{"preset", preset.name},
                        {"bytes", cost.memory},
                        {"work_step", cost.stepWork},
                        {"ms_step", cost.stepWork * base::kSecondsPerUnit * 1e3},
                        {"work_prewarm", cost.startWork},
                        {"ms_prewarm", cost.startWork * base::kSecondsPerUnit * 1e3}});
    }
    return list;
}

constexpr std::array<const char*, 4> kScatterings{"automatic", "single", "closed_form", "network"};

struct Scattering
{
    sim::PreferredScattering value;
    std::string why;
};

/// How light is scattered again in the pictures of a scene.
Scattering scatteringIn(const scene_file::SceneFile& file)
{
    using sim::PreferredScattering;
    const sim::DrawingHints hints = scene_file::preferredHints(file);
    const render::SliceSettings& slices = file.view.slices;
    Scattering chosen{hints.scattering, "no preset asks for another"};
    if (!slices.automatic) {
        chosen = {!slices.multiple ? PreferredScattering::Single
                  : slices.network ? PreferredScattering::Network
                                   : PreferredScattering::ClosedForm,
                  "the scene says so"};
    } else if (hints.scattering == PreferredScattering::Automatic) {
        chosen.value = PreferredScattering::ClosedForm;
    } else {
        for (const scene_file::ScenePreset& preset : file.presets)
            if (preset.effect->hints.scattering == hints.scattering)
                chosen.why = preset.name + " asks for it";
    }
    const render::Composition drawn = file.view.composition;
    const bool isSummed = drawn != render::Composition::Automatic
                              ? drawn == render::Composition::Volume || drawn == render::Composition::Slabs
                              : preset::sumsUp(hints.composition);
    if (chosen.value == PreferredScattering::Network && !isSummed)
        chosen = {PreferredScattering::ClosedForm, "networks need the composition volume or slabs"};
    return chosen;
}

/// Media of the last step by the preset of their instance.
base::Result<std::vector<render::MediumMoments>> mediaOf(const scene_file::SceneFile& file,
                                                         EffectScene& effects)
{
    const auto moment = effects.moment();
    if (!moment.ok())
        return moment.status();
    std::vector<render::MediumMoments> media(file.presets.size());
    for (const render::MediumBlob& blob : render::mediumOf(moment->snapshots, 1.0).blobs)
        if (const uint32_t number = effects.numberOf(blob.instance); number > 0)
            media[file.instances[number - 1].preset].add(blob.center, blob.radius, blob.crossSection,
                                                         blob.albedo);
    return media;
}

/// Size of a pixel [m] at a medium.
double pixelAt(const render::MediumMoments& medium, const scene_file::SceneFile& file,
               const ExplainOptions& options)
{
    const scene_file::CameraPath& camera = file.camera;
    const double distance = glm::length(camera.at(options.time).position - medium.center());
    const double height = camera.orthographicHeight > 0.0f
                              ? double(camera.orthographicHeight)
                              : 2.0 * distance * std::tan(0.5 * glm::radians(double(camera.fovYDegrees)));
    return height / double(options.size);
}

/// Automatic scattering leaves out networks from which a medium does not gain. A picture in which nothing of
/// the medium is there says nothing about that.
Scattering chosenFor(const render::MediumMoments& medium, const scene_file::SceneFile& file,
                     const ExplainOptions& options, const Scattering& asked)
{
    if (file.view.voxels < render::kLeastNetworkVoxels)
        return {sim::PreferredScattering::ClosedForm, "the view has few voxels for a network"};
    if (medium.isEmpty())
        return asked;
    const double pixel = pixelAt(medium, file, options);
    const render::NetworkUse use = render::networkUse(medium, pixel);
    const std::string numbers = render::textOf(use, medium, pixel);
    if (use == render::NetworkUse::Network)
        return {asked.value, asked.why + "; " + numbers};
    std::string why = "a network would gain little: " + numbers;
    if (render::networkUse(medium, pixel, true) == render::NetworkUse::Network) {
        const int percent = int(std::lround(100.0 * render::kKeptNetworkShare));
        why += "; a medium that has had one keeps it down to " + std::to_string(percent) + " % of the limit";
    }
    return {sim::PreferredScattering::ClosedForm, why};
}

/// A picture has no more than kMaxGlowGrids networks: those of the media that are largest on it.
void leaveOutSmallest(std::span<const render::MediumMoments> media, const scene_file::SceneFile& file,
                      const ExplainOptions& options, std::span<Scattering> io)
{
    std::vector<std::pair<double, size_t>> sizes;
    for (size_t i = 0; i < media.size(); ++i) {
        if (io[i].value != sim::PreferredScattering::Network || media[i].isEmpty())
            continue;
        const glm::dvec3 axes = media[i].semiAxes();
        sizes.emplace_back(-std::max({axes.x, axes.y, axes.z}) / pixelAt(media[i], file, options), i);
    }
    std::ranges::sort(sizes);
    for (size_t rank = render::kMaxGlowGrids; rank < sizes.size(); ++rank)
        io[sizes[rank].second] = {
            sim::PreferredScattering::ClosedForm,
            std::to_string(render::kMaxGlowGrids) +
                " media with networks are larger on the picture, as many as it may have"};
}

/// What the preset of each effect with a medium asks for, what it gets, and why.
Json scatteringOf(const scene_file::SceneFile& file, const ExplainOptions& options,
                  std::span<const render::MediumMoments> media)
{
    const Scattering asked = scatteringIn(file);
    const bool chooses = asked.value == sim::PreferredScattering::Network && file.view.slices.automatic;
    std::vector<Scattering> chosen;
    for (const render::MediumMoments& medium : media)
        chosen.push_back(chooses ? chosenFor(medium, file, options, asked) : asked);
    leaveOutSmallest(media, file, options, chosen);
    Json list = Json::array();
    for (size_t i = 0; i < file.presets.size(); ++i) {
        const scene_file::ScenePreset& preset = file.presets[i];
        if (!preset.effect->publishes(base::kBlobKind))
            continue;
        list.push_back({{"preset", preset.name},
                        {"asks", kScatterings.at(size_t(preset.effect->hints.scattering))},
                        {"gets", kScatterings.at(size_t(chosen[i].value))},
                        {"why", chosen[i].why}});
    }
    return list;
}

Json techniquesOf(const scene_file::SceneFile& file, const Json& instances,
                  const std::vector<std::string>& passes)
{
    Json list = Json::array();
    const auto add = [&](std::string_view name, std::span<const render::TimedPass> own, const Json& callers) {
        Json executed = Json::array();
        for (const render::TimedPass& timed : own)
            if (std::find(passes.begin(), passes.end(), timed.pass) != passes.end())
                executed.push_back(std::string(timed.pass));
        const bool exists = !callers.empty() && (own.empty() || !executed.empty());
        list.push_back({{"technique", std::string(name)},
                        {"exists", exists},
                        {"passes", exists ? executed : Json::array()},
                        {"called_by", exists ? callers : Json::array()}});
    };
    for (const preset::Technique& technique : preset::techniques())
        add(technique.name, {}, callersOf(file, instances, [&](const scene_file::ScenePreset& used) {
                return hasMember(used, technique.presetMember);
            }));
    for (const render::DrawTechnique* technique : render::drawTechniques())
        if (technique->kind || technique->isUsedBy)
            add(technique->name, technique->passes,
                callersOf(file, instances, [&](const scene_file::ScenePreset& used) {
                    return isUsed(*technique, *used.effect);
                }));
    return list;
}

/// Draws the frames after `time` with a clock, so that lights say how long their planes take.
base::Status timeFrames(FrameRenderer& renderer, const render::ViewSettings& shown, double time)
{
    constexpr int kFrames = 2; // the first one compiles what only timed frames need
    FxViewSettings settings = toApi(shown);
    settings.budgetMilliseconds = 1e4f; // nothing is lowered
    settings.budgetClock = FX_BUDGET_CLOCK_CPU;
    if (base::Status status = toStatus(fxView_SetSettings(renderer.view(), &settings)); !status)
        return status;
    for (int i = 1; i <= kFrames; ++i)
        if (base::Status status = renderer.render(base::toTicks(time + double(i) / 60.0)); !status)
            return status;
    return {};
}

/// Lights of media, with what their planes take.
base::Result<Json> lightsOf(FxView* view)
{
    uint32_t count = 0;
    if (base::Status status = toStatus(fxView_GetLightCostCount(view, &count)); !status)
        return status;
    Json list = Json::array();
    for (uint32_t i = 0; i < count; ++i) {
        FxLightCost cost = {};
        cost.structSize = sizeof cost;
        if (base::Status status = toStatus(fxView_GetLightCost(view, i, &cost)); !status)
            return status;
        list.push_back({{"light", kLights.at(cost.kind)},
                        {"index", cost.index},
                        {"casts_shadows", cost.planes > 0},
                        {"planes", cost.planes},
                        {"bytes", cost.bytes},
                        {"rays", cost.rays},
                        {"ms", cost.milliseconds}});
    }
    return list;
}

/// Groups of media by what is drawn of them.
Json levelsOf(const FxViewStatistics& view)
{
    return {{"all", view.lodGroups[0]},   {"half", view.lodGroups[1]}, {"eighth", view.lodGroups[2]},
            {"less", view.lodGroups[3]},  {"blobs_drawn", view.blobs}, {"blobs_thinned", view.blobsThinned},
            {"impostors", view.impostors}};
}

void print(const Json& report)
{
    for (const Json& entry : report["instances"])
        std::printf("%4d  %-24s %-9s %-20s %6u particles %8.4f ms\n", entry["instance"].get<int>(),
                    entry["preset"].get<std::string>().c_str(), entry["state"].get<std::string>().c_str(),
                    entry["reason"].get<std::string>().c_str(), entry["particles"].get<unsigned>(),
                    entry["ms_estimated"].get<double>());
    for (const Json& entry : report["emitters"])
        std::printf("%-24s %-20s %s %9.1f KiB  %s\n", entry["preset"].get<std::string>().c_str(),
                    entry["emitter"].get<std::string>().c_str(), entry["path"].get<std::string>().c_str(),
                    entry["bytes"].get<double>() / 1024.0, entry["why"].get<std::string>().c_str());
    for (const Json& entry : report["needs"])
        std::printf("%-24s needs at most %.1f MiB, %.3g ms of a core a step, %.3g ms for its prewarm\n",
                    entry["preset"].get<std::string>().c_str(), entry["bytes"].get<double>() / (1 << 20),
                    entry["ms_step"].get<double>(), entry["ms_prewarm"].get<double>());
    for (const Json& entry : report["scattering"])
        std::printf("%-24s scattering: asks for %s, gets %s: %s\n",
                    entry["preset"].get<std::string>().c_str(), entry["asks"].get<std::string>().c_str(),
                    entry["gets"].get<std::string>().c_str(), entry["why"].get<std::string>().c_str());
    for (const Json& entry : report["techniques"])
        std::printf("%-22s %s  passes %s  called by %s\n", entry["technique"].get<std::string>().c_str(),
                    entry["exists"].get<bool>() ? "exists" : "absent", entry["passes"].dump().c_str(),
                    entry["called_by"].dump().c_str());
    for (const Json& entry : report["lights"])
        std::printf(
            "%s %u: %s, %u planes, %.1f KiB, %llu rays when they are filled, %.3f ms in the frames after\n",
            entry["light"].get<std::string>().c_str(), entry["index"].get<unsigned>(),
            entry["casts_shadows"].get<bool>() ? "media cast shadows" : "added without shadows",
            entry["planes"].get<unsigned>(), entry["bytes"].get<double>() / 1024.0,
            entry["rays"].get<unsigned long long>(), entry["ms"].get<double>());
    std::printf("passes %s\nlevel of detail %s\n", report["passes"].dump().c_str(),
                report["level_of_detail"].dump().c_str());
    std::printf(
        "%llu bytes of textures, %llu of them for the frame's passes (%llu if none shared memory), "
        "%.4f ms of simulation a step (estimated)\n",
        report["bytes_textures"].get<unsigned long long>(), report["bytes_frame"].get<unsigned long long>(),
        report["bytes_frame_unshared"].get<unsigned long long>(), report["ms_estimated"].get<double>());
}

base::Status explain(const ExplainOptions& options)
{
    const bool isScene = options.input.ends_with(".scene.json");
    auto file = isScene ? scene_file::loadSceneFile(options.input) : sceneOfPreset(options.input);
    if (!file.ok())
        return file.status();
    if (!isScene)
        followPresets(*file); // as fx render does
    FrameRendererOptions rendererOptions;
    rendererOptions.width = rendererOptions.height = options.size;
    rendererOptions.settings = file->view;
    rendererOptions.settings.lod = {options.lodBias, options.impostorPixels};
    auto renderer = FrameRenderer::create(*file, rendererOptions);
    if (!renderer.ok())
        return renderer.status();
    FxScene* scene = (*renderer)->effects().scene();
    if (!options.everything)
        if (base::Status status = lookThroughCamera(*file, options, scene); !status)
            return status;
    if (base::Status status = (*renderer)->render(base::toTicks(options.time)); !status)
        return status;
    FxFrameStats stats = {};
    stats.structSize = sizeof stats;
    if (base::Status status = toStatus(fxScene_GetFrameStats(scene, &stats)); !status)
        return status;
    FxSceneStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    if (base::Status status = toStatus(fxScene_GetStatistics(scene, &statistics)); !status)
        return status;
    const FrameCounters counters = (*renderer)->counters();
    const Json instances = instancesOf(*file, scene, options.time);
    const auto media = mediaOf(*file, (*renderer)->effects());
    if (!media.ok())
        return media.status();
    const Json techniques = techniquesOf(*file, instances, counters.passes);
    if (base::Status status = timeFrames(**renderer, rendererOptions.settings, options.time); !status)
        return status;
    const base::Result<Json> lights = lightsOf((*renderer)->view());
    if (!lights.ok())
        return lights.status();
    const Json report = {{"file", options.input},
                         {"time", options.time},
                         {"instances", instances},
                         {"emitters", emittersOf(*file)},
                         {"needs", needsOf(*file)},
                         {"scattering", scatteringOf(*file, options, *media)},
                         {"seconds_debt", base::toSeconds(statistics.timeDebtTicks)},
                         {"techniques", techniques},
                         {"passes", counters.passes},
                         {"lights", *lights},
                         {"level_of_detail", levelsOf(counters.view)},
                         {"bytes_textures", counters.view.textureBytes},
                         {"bytes_frame", counters.view.sharedBytes},
                         {"bytes_frame_unshared", counters.view.unsharedBytes},
                         {"ms_estimated", stats.estimatedMilliseconds}};
    if (options.json)
        printJsonLine(withMachine(report, readMachine()));
    else
        print(report);
    return {};
}

} // namespace

void addExplainCommand(CLI::App& app, int& outExitCode)
{
    auto options = std::make_shared<ExplainOptions>();
    CLI::App* command = app.add_subcommand(
        "explain",
        "Which instances of a scene are active and why others are not, and what exists because of them");
    command->add_option("FILE", options->input, "*.scene.json, *.fx.json or library:NAME")->required();
    command->add_option("--time", options->time, "[s] Moment to explain; default 1")
        ->check(CLI::Range(0.0, 86400.0));
    command->add_option("--size", options->size, "[pixel] Width and height of the picture; default 256")
        ->check(CLI::Range(16, 4096));
    command->add_option("--lod-bias", options->lodBias, "Level of detail, as of fx render; default 0")
        ->check(CLI::Range(0.0f, 256.0f));
    command->add_option("--impostors", options->impostorPixels, "As of fx render; default 0")
        ->check(CLI::Range(0.0f, 13.0f));
    command->add_flag("--everything", options->everything, "As if everything were in sight");
    command->add_flag("--json", options->json, "One object");
    command->callback([options, &outExitCode] {
        const base::Status status = explain(*options);
        if (!status.ok())
            std::fprintf(stderr, "fx explain: %s\n", status.message().c_str());
        outExitCode = status.ok() ? kSuccess : kFailed;
    });
}

} // namespace fx::cli
