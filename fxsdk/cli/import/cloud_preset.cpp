#include "fxsdk/cli/import/cloud_preset.h"

#include "fxsdk/cli/support/atomic_file.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/progress.h"
#include "rendering/optics/black_body.h"
#include "rendering/voxelization/opacity_view.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace fx::cli {
namespace {

constexpr int kPixels = 256; // along the longer side of the pictures that are compared
constexpr float kAir = 293.0f;
constexpr glm::vec3 kLuminance{0.2126f, 0.7152f,
                               0.0722f}; // of linear Rec. 709, as rendering/optics/black_body.h
constexpr std::string_view kPresetSuffix = ".fx.json";

/// A color of luminance 1: that of a black body, where it is hot enough to have one.
glm::vec3 colorOf(double temperature)
{
    const glm::vec3 light = render::blackBodyLuminance(float(temperature));
    const float luminance = glm::dot(light, kLuminance);
    return luminance > 0.0f ? light / luminance : glm::vec3(1.0f);
}

double massOf(const sim::BallList& list)
{
    double sum = 0.0;
    for (const sim::ListedBall& ball : list)
        sum += double(ball.crossSection);
    return sum;
}

std::string presetText(const std::string& name, const std::string& file)
{
    const nlohmann::ordered_json preset{{"version", 1},
                                        {"name", name},
                                        {"composition", "volume"},
                                        {"clouds", {{{"name", name}, {"file", file}}}}};
    return preset.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

} // namespace

sim::BallList ballListOf(const render::MediumGrid& grid, const std::vector<render::FitBall>& balls,
                         double albedo)
{
    const sim::ListedBall limits;
    sim::BallList list;
    list.reserve(balls.size());
    for (const render::FitBall& ball : balls) {
        sim::ListedBall& out = list.emplace_back(limits);
        out.center = glm::vec3(ball.center);
        out.radius = float(ball.radius);
        out.crossSection = float(ball.crossSection);
        out.albedo = grid.albedo.empty()
                         ? glm::vec3(float(albedo))
                         : glm::clamp(glm::vec3(ball.albedo), glm::vec3(0.0f), glm::vec3(1.0f));
        const bool hasFlame = !grid.flame.empty();
        out.temperature =
            hasFlame || grid.temperature.empty() ? kAir : float(std::min(ball.temperature, 1e5));
        if (hasFlame)
            out.emission = float(std::min(ball.luminance, 1e11)) * colorOf(ball.temperature);
    }
    return list;
}

base::Result<CloudFitReport> writeCloudPreset(const render::MediumGrid& grid,
                                              const render::FitOptions& options, double albedo,
                                              const std::filesystem::path& preset, base::TaskRunner& tasks,
                                              bool showProgress)
{
    std::string stem = preset.filename().string();
    if (!stem.ends_with(kPresetSuffix) || stem.size() == kPresetSuffix.size())
        return base::Status(base::Code::InvalidArgument,
                            preset.string() + ": the name of a preset ends in .fx.json");
    stem.resize(stem.size() - kPresetSuffix.size());
    CloudFitReport report;
    const auto start = std::chrono::steady_clock::now();
    std::vector<render::FitBall> balls;
    {
        Progress progress("fitting", options.iterations, showProgress);
        balls = render::fitBalls(grid, options, tasks, [&](uint32_t done, uint32_t) {
            progress.update(done);
            return !interruptRequested();
        });
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (interruptRequested())
        return interruptedStatus();
    if (balls.empty())
        return base::Status(base::Code::InvalidArgument, "the volume has no medium");
    const sim::BallList list = ballListOf(grid, balls, albedo);
    const std::string bytes = sim::writeBallList(list);
    if (const auto readBack = sim::parseBallList(bytes); !readBack)
        return base::Status(readBack.status().code(),
                            readBack.status().message() + "; change --density-scale or --length-scale");
    report.balls = list.size();
    const double mass = render::sumsOf(grid).crossSection;
    report.massError = (massOf(list) - mass) / mass;
    report.viewErrors = render::viewErrors(grid, balls, kPixels, tasks);
    report.ballFile = preset.parent_path() / (stem + ".fxballs");
    if (base::Status status = writeFileAtomically(report.ballFile, bytes); !status)
        return status;
    if (base::Status status = writeFileAtomically(preset, presetText(stem, stem + ".fxballs")); !status)
        return status;
    return report;
}

} // namespace fx::cli
