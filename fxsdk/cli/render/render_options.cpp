#include "fxsdk/cli/render/render_options.h"

#include "fxsdk/cli/support/named_choice.h"
#include "fxsdk/scene_file/stages.h"
#include "rendering/frame/composition_names.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <utility>

namespace fx::cli {
namespace {

constexpr int kMaxSize = 16384;      // [pixel]
constexpr double kDefaultTime = 0.5; // [s]
constexpr size_t kMaxTimes = 256;

base::Status usage(const std::string& message)
{
    return {base::Code::InvalidArgument, message};
}

/// Frame k shows the k-th of the times. With one file it is a sheet of all of them.
base::Status planTimes(const RenderArguments& arguments, RenderPlan& plan)
{
    if (!arguments.frames.empty() || arguments.time)
        return usage(std::string("found both ") + (arguments.time ? "--time" : "--frames") +
                     " and --times; give one of them");
    if (plan.output.kind == OutputKind::Mp4 || (plan.output.kind == OutputKind::Exr && plan.output.isStill()))
        return usage(
            "--times needs a sequence (-o name.%d.png, -o name.%d.exr), or one PNG (-o name.png) that "
            "shows all times side by side");
    std::istringstream list(arguments.times + ",");
    for (std::string text; std::getline(list, text, ',');) {
        char* end = nullptr;
        const double time = std::strtod(text.c_str(), &end);
        if (text.empty() || *end != '\0' || !(time >= 0.0 && time <= kMaxSceneTime))
            return usage("--times " + arguments.times +
                         ": expected numbers from 0 to 3600 with commas between");
        const base::Ticks tick = base::toTicks(time);
        if (!plan.frames.empty() && tick <= plan.frames.back().tick)
            return usage("--times " + arguments.times + ": expected rising times");
        plan.frames.push_back({int64_t(plan.frames.size()), tick});
    }
    if (plan.frames.size() > kMaxTimes)
        return usage("--times: at most " + std::to_string(kMaxTimes) + " times");
    plan.isSheet = plan.output.isStill();
    if (plan.isSheet &&
        (plan.width * plan.sheetColumns() > kMaxSize || plan.height * plan.sheetRows() > kMaxSize))
        return usage("--times: the sheet would have a side of more than 16384 pixels; make --size smaller");
    return {};
}

base::Status planFrames(const RenderArguments& arguments, RenderPlan& plan)
{
    if (!arguments.times.empty())
        return planTimes(arguments, plan);
    const bool isSingle = plan.output.isStill();
    auto frames = listFrames({arguments.time, arguments.frames, arguments.framesPerSecond}, isSingle,
                             kDefaultTime, "a sequence (-o name.%04d.png) or a video (-o name.mp4)",
                             "one PNG or EXR; for a sequence or a video give --frames or --times");
    if (!frames.ok())
        return frames.status();
    plan.frames = std::move(*frames);
    plan.hasDefaultTime = isSingle && !arguments.time;
    return {};
}

/// Reads --figure: X,Y,Z or off.
base::Status planFigure(const std::string& text, RenderPlan& plan)
{
    constexpr double kFarthest = 1e5; // [m]
    plan.noFigure = text == "off";
    if (text.empty() || plan.noFigure)
        return {};
    glm::vec3 place(0.0f);
    int count = 0;
    std::istringstream list(text + ",");
    for (std::string part; std::getline(list, part, ','); ++count) {
        char* end = nullptr;
        const double value = std::strtod(part.c_str(), &end);
        if (part.empty() || *end != '\0' || !(std::abs(value) <= kFarthest) || count == 3)
            return usage("--figure " + text + ": expected off or X,Y,Z, each from -100000 to 100000 m");
        place[count] = float(value);
    }
    if (count != 3)
        return usage("--figure " + text + ": expected off or X,Y,Z, found " + std::to_string(count) +
                     (count == 1 ? " number" : " numbers"));
    plan.figure = place;
    return {};
}

struct NamedOutputs
{
    std::string_view name;
    uint32_t bits;
};
constexpr NamedOutputs kOutputs[] = {
    {"id", render::view_output::InstanceId},
    {"motion", render::view_output::Motion},
    {"depth", render::view_output::FirstDepth | render::view_output::MeanDepth},
};

/// view_output bits of names with commas between; nothing where one is unknown.
std::optional<uint32_t> outputsOf(const std::string& names)
{
    uint32_t bits = 0;
    std::istringstream list(names);
    for (std::string name; std::getline(list, name, ',');) {
        const auto found = std::ranges::find(kOutputs, std::string_view(name), &NamedOutputs::name);
        if (found == std::end(kOutputs))
            return std::nullopt;
        bits |= found->bits;
    }
    return bits;
}

/// What is drawn, of when, and where it goes.
void addOutputOptions(CLI::App& command, RenderArguments& arguments)
{
    command
        .add_option(
            "FILE", arguments.input,
            "A scene (*.scene.json), a preset (*.fx.json), library:NAME, or a list of blobs (*.blobs.csv); "
            "a preset stands on a plain ground")
        ->required();
    command
        .add_option("-o,--output", arguments.output,
                    "NAME.png, NAME.exr, a sequence (NAME.%04d.png, NAME.%04d.exr) or "
                    "NAME.mp4 (needs ffmpeg)")
        ->required();
    command.add_option("--size", arguments.size, "Picture size in pixels, WIDTHxHEIGHT")
        ->capture_default_str();
    command
        .add_option("--time", arguments.time,
                    "Scene time of a still [s] (default: of the preset's preview, or 0.5)")
        ->check(CLI::Range(0.0, kMaxSceneTime));
    command.add_option("--frames", arguments.frames,
                       "Frames of a sequence or video, FIRST:LAST, both included "
                       "(default: 2 seconds)");
    command.add_option("--times", arguments.times,
                       "Scene times T,T,... [s] instead of frames: one file each with a sequence, a sheet of "
                       "all of them with one PNG");
    command
        .add_option(
            "--outputs", arguments.outputs,
            "More channels of an EXR file, with commas between: id, number of the instance; motion, in "
            "pixels; depth, where media begin and their mean")
        ->check(CLI::Validator(
            [](std::string& text) {
                return outputsOf(text) ? std::string() : "expected id, motion, depth, found " + text;
            },
            "NAMES"));
    command.add_option("--fps", arguments.framesPerSecond, "Frames a second; frame N shows the time N / fps")
        ->check(CLI::Range(0.1, 1000.0))
        ->capture_default_str();
}

std::vector<std::string> compositionNames()
{
    std::vector<std::string> names;
    for (const auto& [name, value] : render::kCompositionNames)
        names.emplace_back(name);
    return names;
}

std::vector<std::string> stageNames()
{
    std::vector<std::string> names;
    for (const scene_file::Stage& stage : scene_file::stages())
        names.emplace_back(stage.name);
    return names;
}

/// How it looks.
void addLookOptions(CLI::App& command, RenderArguments& arguments)
{
    command
        .add_option("--quality", arguments.quality,
                    "low: homogeneous balls, no detail, no shimmer; medium: with "
                    "shimmer; high: the gas's own kernel and detail; reference: as "
                    "high, simulated at 120 steps a second")
        ->check(oneOf({"low", "medium", "high", "reference"}))
        ->capture_default_str();
    command.add_option("--form", arguments.form, "Billboard form instead of the one that the quality says")
        ->check(oneOf({"planar", "constant", "kernel"}));
    command
        .add_option(
            "--composition", arguments.composition,
            "How media that overlap are put together instead of what the scene says: sorted, one over "
            "the other; slabs, summed up in slabs across each ray; volume, in voxels; automatic, as the "
            "presets say. Of a preset the default is automatic")
        ->check(oneOf(compositionNames()));
    command.add_option("--slabs", arguments.slabs, "Slabs along each ray of --composition slabs")
        ->check(oneOf({"6", "16"}));
    command
        .add_option("--voxels", arguments.voxels, "Voxels along 16 radii of balls of --composition volume")
        ->check(CLI::Range(16, 256));
    command.add_option("--seed", arguments.seed, "Instance k gets the seed N + k instead of the file's")
        ->check(CLI::Validator(
            [](std::string& text) { return text.starts_with('-') ? "must not be negative" : ""; }, "UINT"));
    command
        .add_option("--compute", arguments.compute,
                    "What computes the particles of all emitters instead of what presets say; the GPU does "
                    "where it can, see fx explain")
        ->check(oneOf({"cpu", "gpu", "auto"}));
    command.add_option("--exposure", arguments.exposureEv100, "Exposure [EV100] instead of the scene's")
        ->check(CLI::Range(-20.0, 40.0));
    command.add_option("--lights", arguments.lights,
                       "Lights, sky and exposure of this scene file instead of the scene's");
    command
        .add_option("--stage", arguments.stage,
                    "Where a preset is shown, instead of mesh, light, background and exposure of its preview")
        ->check(oneOf(stageNames()));
    command.add_option(
        "--figure", arguments.figure,
        "Where a person of 1.8 m stands, X,Y,Z [m], to show the size of the effect; off: nowhere. "
        "Default: as the preset's preview says");
    command.add_flag("--no-dazzle", arguments.noDazzle, "Without glare (EXR never has it)");
    command.add_flag("--no-shimmer", arguments.noShimmer, "Without heat shimmer (EXR never has it)");
    command
        .add_option(
            "--renderer", arguments.renderer,
            "gl; reference: the ray integral on the processor, exact and slow; path: light scattered any "
            "number of times, without bias. The last two write EXR")
        ->check(oneOf({"gl", "reference", "path"}))
        ->capture_default_str();
    command.add_flag(
        "--overlay", arguments.overlay,
        "Look through the scene's camera only, and draw the boxes of all effects in the color of "
        "their state: green active, red hidden, blue resting");
}

std::string checkLightSlices(const std::string& text)
{
    if (text == "off")
        return "";
    char* end = nullptr;
    const long planes = std::strtol(text.c_str(), &end, 10);
    return end != text.c_str() && *end == '\0' && planes >= 2 && planes <= 128
               ? ""
               : "expected off, or a number of planes from 2 to 128, found " + text;
}

/// What may be saved in drawing.
void addEconomyOptions(CLI::App& command, RenderArguments& arguments)
{
    command
        .add_option(
            "--light-slices", arguments.lightSlices,
            "Planes across the sun that hold the shadow of media, 2 to 128 (default: 32); off: media cast "
            "no shadows")
        ->check(CLI::Validator(checkLightSlices, "N|off"));
    command
        .add_option("--light-refresh", arguments.lightRefresh,
                    "Frames after which the shadow of media follows media that move, 1 to 16")
        ->check(CLI::Range(1, 16))
        ->capture_default_str();
    command
        .add_option("--layer-scale", arguments.layerScale,
                    "Width and height at which particles are drawn, over those of the picture")
        ->check(oneOf({"1", "0.5", "0.25"}))
        ->capture_default_str();
    command
        .add_option("--fragment-budget", arguments.fragmentBudget,
                    "Estimated fragments a frame above which the layer scale falls; 0: never")
        ->check(CLI::Range(uint32_t(0), std::numeric_limits<uint32_t>::max()))
        ->capture_default_str();
    command
        .add_option("--lod-bias", arguments.lodBias,
                    "Pixels of a far effect for which one particle of its media is drawn; 0: all are")
        ->check(CLI::Range(0.0f, 256.0f))
        ->capture_default_str();
    command
        .add_option("--impostors", arguments.impostorPixels,
                    "[pixel] Radius below which effects are drawn as pictures of themselves; 0: none")
        ->check(CLI::Range(0.0f, 13.0f))
        ->capture_default_str();
    command
        .add_option("--block-parallax", arguments.blockParallax,
                    "[pixel] Error up to which blocks are drawn as impostors; 0: ball by ball")
        ->check(CLI::Range(0.0f, 16.0f))
        ->capture_default_str();
    command
        .add_option("--block-error", arguments.blockError,
                    "[1] Root mean square error, in units of white, up to which blocks are drawn as "
                    "impostors; 0: not limited; default 4/255")
        ->check(CLI::Range(0.0f, 1.0f));
}

void addReportOptions(CLI::App& command, RenderArguments& arguments)
{
    command.add_option("--stats", arguments.statistics, "Write one JSON object a frame to this file");
    command.add_flag("--overdraw", arguments.overdraw,
                     "Count shaded fragments and covered pixels in the statistics");
    command.add_flag("--json", arguments.json, "Print one JSON object a frame");
}

} // namespace

void addRenderOptions(CLI::App& command, RenderArguments& arguments)
{
    addOutputOptions(command, arguments);
    addLookOptions(command, arguments);
    addEconomyOptions(command, arguments);
    addReportOptions(command, arguments);
    addReferenceOptions(command, arguments.reference);
    addPathOptions(command, arguments.reference);
}

int RenderPlan::sheetColumns() const
{
    return int(std::ceil(std::sqrt(double(frames.size()))));
}

base::Result<RenderPlan> planRender(const RenderArguments& arguments)
{
    RenderPlan plan;
    auto output = parseOutputTarget(arguments.output);
    if (!output.ok())
        return output.status();
    plan.output = *output;
    const auto size = parsePair(arguments.size, 'x');
    if (!size || size->first < 1 || size->second < 1 || size->first > kMaxSize || size->second > kMaxSize)
        return usage("--size " + arguments.size + ": expected WIDTHxHEIGHT, each from 1 to 16384");
    plan.width = int(size->first);
    plan.height = int(size->second);
    // CLI11's ranges let NaN through.
    if (!std::isfinite(arguments.time.value_or(kDefaultTime)) || !std::isfinite(arguments.framesPerSecond) ||
        !std::isfinite(arguments.exposureEv100.value_or(0.0f)))
        return usage("--time, --fps and --exposure must be numbers");
    const ReferenceArguments& tiled = arguments.reference;
    if (arguments.renderer != "path" && (tiled.paths || tiled.error || tiled.bounces))
        return usage("--spp, --error and --bounces need --renderer path");
    if (arguments.renderer == "gl" && tiled.scattering == "none")
        return usage("--scattering none needs --renderer reference; with gl it is single, multiple, network "
                     "or automatic");
    if (arguments.renderer != "gl" && (tiled.scattering == "network" || tiled.scattering == "automatic"))
        return usage("--scattering " + tiled.scattering + " needs --renderer gl");
    if (arguments.renderer == "reference" && tiled.scattering == "multiple")
        return usage("--scattering multiple needs --renderer gl or path");
    if (!arguments.outputs.empty() && (plan.output.kind != OutputKind::Exr || arguments.renderer == "path"))
        return usage("--outputs needs an EXR file (-o NAME.exr) of --renderer gl or reference");
    plan.framesPerSecond = arguments.framesPerSecond;
    plan.stepsPerSecond = arguments.quality == "reference" ? 120 : 60;
    if (arguments.quality == "reference" || arguments.quality == "low")
        plan.simulationQuality = arguments.quality == "low" ? FX_QUALITY_LOW : FX_QUALITY_REFERENCE;
    if (base::Status status = planFigure(arguments.figure, plan); !status)
        return status;
    if (base::Status status = planFrames(arguments, plan); !status)
        return status;
    return plan;
}

void applyArguments(const RenderArguments& arguments, OutputKind kind, render::ViewSettings& settings)
{
    const bool coarse = arguments.quality == "low" || arguments.quality == "medium";
    if (coarse) {
        settings.form = render::BillboardForm::Constant;
        settings.detail = false;
    }
    if (arguments.form == "planar")
        settings.form = render::BillboardForm::Planar;
    else if (arguments.form == "constant")
        settings.form = render::BillboardForm::Constant;
    else if (arguments.form == "kernel")
        settings.form = render::BillboardForm::Kernel;

    for (const auto& [name, value] : render::kCompositionNames)
        if (arguments.composition == name)
            settings.composition = value;
    if (!arguments.slabs.empty())
        settings.slabs = std::stoi(arguments.slabs);
    if (!arguments.voxels.empty())
        settings.voxels = std::stoi(arguments.voxels);

    const bool linear = kind == OutputKind::Exr;
    if (linear || arguments.noShimmer || arguments.quality == "low")
        settings.shimmer.strength = 0.0f;
    if (linear || arguments.noDazzle)
        settings.dazzle.enabled = false;
    settings.toneMap = !linear;
    settings.layerOutputs = linear;
    settings.outputs = outputsOf(arguments.outputs).value_or(0);
    settings.countOverdraw = arguments.overdraw;
    settings.overlay = arguments.overlay;
    settings.layerDivisor = int(std::lround(1.0 / std::stod(arguments.layerScale)));
    settings.lod = {arguments.lodBias, arguments.impostorPixels};
    settings.blocks.parallax = arguments.blockParallax;
    settings.blocks.error = arguments.blockError;
    settings.fragmentBudget = arguments.fragmentBudget;
    settings.slices.enabled = arguments.lightSlices != "off";
    if (settings.slices.enabled && !arguments.lightSlices.empty())
        settings.slices.resolution.planes = std::stoi(arguments.lightSlices);
    settings.slices.refreshFrames = arguments.lightRefresh;
    const std::string& scattering = arguments.reference.scattering;
    if (scattering == "automatic")
        settings.slices.automatic = true;
    if (scattering == "single" || scattering == "multiple" || scattering == "network") {
        settings.slices.automatic = false;
        settings.slices.multiple = scattering != "single";
        settings.slices.network = scattering == "network";
    }
    settings.exposureEv100 = arguments.exposureEv100.value_or(settings.exposureEv100);
}

void printRendered(const RenderArguments& arguments, const RenderPlan& plan, const std::string& machine)
{
    if (!arguments.json)
        std::printf("%s: %zu %s of %dx%d on %s\n", arguments.output.c_str(), plan.frames.size(),
                    plan.frames.size() == 1 ? "frame" : "frames", plan.width, plan.height, machine.c_str());
}

} // namespace fx::cli
