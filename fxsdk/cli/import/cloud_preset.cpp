#include "fxsdk/cli/import/cloud_preset.h"

#include "fxsdk/cli/import/preset_files.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/cli/support/progress.h"
#include "rendering/optics/color_temperature.h"
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

double massOf(const sim::BallList& list)
{
    double sum = 0.0;
    for (const sim::ListedBall& ball : list)
        sum += double(ball.crossSection);
    return sum;
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
            out.emission =
                float(std::min(ball.luminance, 1e11)) * render::blackBodyColor(float(ball.temperature));
    }
    return list;
}

base::Result<CloudFitReport> writeCloudPreset(const render::MediumGrid& grid,
                                              const render::FitOptions& options, double albedo,
                                              const std::filesystem::path& preset, base::TaskRunner& tasks,
                                              bool showProgress)
{
    const base::Result<std::string> stem = presetStem(preset);
    if (!stem)
        return stem.status();
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
        return base::Status(base::Code::InvalidArgument,
                            grid.balls.empty() ? "the volume has no medium"
                                               : "the voxels have no medium, and a fit leaves out the balls "
                                                 "beside them; export with --balls-below 0");
    const sim::BallList list = ballListOf(grid, balls, albedo);
    const std::string bytes = sim::writeBallList(list);
    if (const auto readBack = sim::parseBallList(bytes); !readBack)
        return base::Status(readBack.status().code(),
                            readBack.status().message() + "; change --density-scale or --length-scale");
    report.balls = list.size();
    const double mass = render::sumsOf(grid).crossSection;
    report.massError = (massOf(list) - mass) / mass;
    report.viewErrors = render::viewErrors(grid, balls, kPixels, tasks);
    report.ballFile = preset.parent_path() / (*stem + ".fxballs");
    nlohmann::ordered_json text{{"version", 1},
                                {"name", *stem},
                                {"composition", "volume"},
                                {"clouds", {{{"name", *stem}, {"file", *stem + ".fxballs"}}}}};
    setAnisotropy(grid.anisotropy, text);
    if (base::Status status = writePresetFiles(preset, text, report.ballFile, bytes); !status)
        return status;
    return report;
}

} // namespace fx::cli
