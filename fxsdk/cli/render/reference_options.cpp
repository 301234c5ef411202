#include "fxsdk/cli/render/reference_options.h"

#include "fxsdk/cli/support/named_choice.h"

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace fx::cli {
namespace {

constexpr size_t kViewNumbers = 7;
constexpr double kFarthest = 1e12; ///< [m] of eye and target, as of blobs in a list

base::Status usage(const std::string& message)
{
    return {base::Code::InvalidArgument, message};
}

/// Exactly seven finite numbers between commas.
std::optional<std::array<double, kViewNumbers>> parseNumbers(const std::string& text)
{
    std::array<double, kViewNumbers> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (size_t i = 0; i < kViewNumbers; ++i) {
        const auto [rest, error] = std::from_chars(at, end, numbers[i]);
        if (error != std::errc() || !std::isfinite(numbers[i]))
            return std::nullopt;
        const bool isLast = i + 1 == kViewNumbers;
        if (isLast ? rest != end : rest == end || *rest != ',')
            return std::nullopt;
        at = rest + 1;
    }
    return numbers;
}

} // namespace

void addReferenceOptions(CLI::App& command, ReferenceArguments& arguments)
{
    const char* const group = "Reference renderer and path tracer";
    command
        .add_option(
            "--integrator", arguments.integrator,
            "How light is integrated along a ray: paper-N, simpson-N, gauss-3, gauss-5, gauss-8, positive-N, "
            "march-STEP, adaptive-TOLERANCE")
        ->capture_default_str()
        ->group(group);
    command.add_option("--precision", arguments.precision, "Numbers of the integral")
        ->check(oneOf({"double", "float"}))
        ->capture_default_str()
        ->group(group);
    command
        .add_option(
            "--source", arguments.source,
            "per-blob: each blob emits by its own extinction; product: all extinction times all emission")
        ->check(oneOf({"per-blob", "product"}))
        ->capture_default_str()
        ->group(group);
    command
        .add_option(
            "--scattering", arguments.scattering,
            "Light of the scene that is scattered once. centers: as it arrives at the centers of the blobs; "
            "single: by shadow rays to all lights all along each ray and from surfaces, slow. With "
            "--renderer "
            "gl: single; multiple, light that is scattered any number of times, by a formula; network, "
            "the same by an illumination network in the compositions volume and slabs; or automatic, as the "
            "presets ask for")
        ->check(oneOf({"none", "centers", "single", "multiple", "network", "automatic"}))
        ->capture_default_str()
        ->group(group);
    command
        .add_option(
            "--detail", arguments.detail,
            "Detail of fields. auto: where the scene's composition, or --composition, draws it, which "
            "are all but sorted")
        ->check(oneOf({"auto", "on", "off"}))
        ->capture_default_str()
        ->group(group);
    command
        .add_option("--sky-rings", arguments.skyRings,
                    "With --scattering single light of the sky comes from 4 N N directions")
        ->check(CLI::Range(1, 64))
        ->capture_default_str()
        ->group(group);
    command.add_option("--samples", arguments.samples, "A pixel is the mean of N x N rays")
        ->check(CLI::Range(1, 16))
        ->capture_default_str()
        ->group(group);
    command
        .add_option(
            "--view", arguments.view,
            "Camera instead of the scene's: EX,EY,EZ,TX,TY,TZ,FOV, eye and target in metres and the vertical "
            "field of view in degrees")
        ->group(group);
    command.add_option("--camera", arguments.camera, "Camera of this scene file instead of the scene's")
        ->group(group);
    command.add_option("--threads", arguments.threads, "At most so many threads, 0 for all")
        ->check(CLI::Range(0, 1024))
        ->capture_default_str()
        ->group(group);
    command
        .add_flag(
            "--resume", arguments.resume,
            "Go on with the tiles in OUTPUT.journal, which an earlier run of the same command left behind")
        ->group(group);
}

void addPathOptions(CLI::App& command, ReferenceArguments& arguments)
{
    const char* const group = "Path tracer";
    command.add_option("--spp", arguments.paths, "Paths of a pixel; 64, and at most 65536 with --error")
        ->check(CLI::Range(1u, 1u << 24))
        ->group(group);
    command
        .add_option("--error", arguments.error,
                    "As many paths as bring the standard error of written values down to this: 0.01 is one "
                    "percent of white")
        ->check(CLI::Range(1e-6, 1e6))
        ->group(group);
    command
        .add_option("--bounces", arguments.bounces,
                    "Longest path: 1 scatters light once; any number without this option")
        ->check(CLI::Range(0u, 1000000u))
        ->group(group);
    command.add_option("--sun-angle", arguments.sunAngle, "Diameter of the sun in degrees")
        ->check(CLI::Range(0.0, 180.0))
        ->capture_default_str()
        ->group(group);
}

base::Result<render::ReferenceCamera> parseView(const std::string& text)
{
    const auto numbers = parseNumbers(text);
    if (!numbers)
        return usage("--view " + text + ": expected seven numbers EX,EY,EZ,TX,TY,TZ,FOV");
    const auto& n = *numbers;
    const glm::dvec3 eye(n[0], n[1], n[2]);
    const glm::dvec3 target(n[3], n[4], n[5]);
    const glm::dvec3 upwards(0.0, 1.0, 0.0);
    if (std::any_of(n.begin(), n.end() - 1, [](double number) { return std::abs(number) > kFarthest; }))
        return usage("--view " + text + ": eye and target must lie within 1e12 m");
    if (!(n[6] > 0.0 && n[6] < 180.0))
        return usage("--view " + text + ": the field of view must lie between 0 and 180 degrees");
    const glm::dvec3 look = target - eye;
    if (!(glm::length(look) > 0.0))
        return usage("--view " + text + ": eye and target are the same point");
    // Straight up or down there is no upright picture; -Z is then towards its upper edge.
    const bool isVertical = glm::length(glm::cross(glm::normalize(look), upwards)) < 1e-9;
    auto camera =
        render::ReferenceCamera::lookAt(eye, target, isVertical ? glm::dvec3(0.0, 0.0, -1.0) : upwards);
    camera.halfHeight = std::tan(n[6] * std::numbers::pi / 360.0);
    camera.nearDistance = 0.0;
    return camera;
}

base::Status checkPictureMemory(int width, int height, uint64_t memory)
{
    constexpr uint64_t kPlanes = render::reference_channel::Count;
    constexpr uint64_t kInterleaved = render::reference_channel::Depth;
    constexpr uint64_t kPerPixel = sizeof(float) * (kPlanes + kInterleaved + kPlanes); // and the file
    const uint64_t needed = kPerPixel * uint64_t(width) * uint64_t(height);
    if (memory == 0 || needed <= memory)
        return {};
    const double share = std::sqrt(double(memory) / double(needed));
    const auto fitting = [share](int side) { return std::to_string(std::max(1, int(side * share))); };
    const std::string size = std::to_string(width) + "x" + std::to_string(height);
    return {base::Code::OutOfMemory, "--size " + size + " needs " + std::to_string(needed) +
                                         " bytes of memory and this machine has " + std::to_string(memory) +
                                         ": choose a smaller one, at most " + fitting(width) + "x" +
                                         fitting(height)};
}

base::Result<ReferencePlan> planReference(const ReferenceArguments& arguments)
{
    ReferencePlan plan;
    const auto scheme = render::parseScheme(arguments.integrator);
    if (!scheme.ok())
        return usage("--integrator " + arguments.integrator + ": " + scheme.status().message());
    plan.integral.scheme = *scheme;
    plan.integral.model =
        arguments.source == "product" ? render::SourceModel::Product : render::SourceModel::PerBlob;
    plan.isSingle = arguments.precision == "float";
    if (!arguments.view.empty() && !arguments.camera.empty())
        return usage("--view and --camera exclude each other");
    if (!arguments.view.empty()) {
        const auto camera = parseView(arguments.view);
        if (!camera.ok())
            return camera.status();
        plan.camera = *camera;
    }
    plan.scattering = arguments.scattering == "single"    ? render::ScatteringMode::Single
                      : arguments.scattering == "centers" ? render::ScatteringMode::Centers
                                                          : render::ScatteringMode::None;
    return plan;
}

} // namespace fx::cli
