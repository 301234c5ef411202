/// @file fit.cpp
/// Balls fitted to a grid: pictures of opacity against the number of balls, the form of the fit, and its
/// time.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/volume_scene.h"
#include "rendering/voxelization/opacity_view.h"

#include <array>
#include <chrono>
#include <cmath>
#include <string>

namespace fx::cli {
namespace {

constexpr double kDepth = 5.0;      // [1] optical depth through the middle of the cloud
constexpr double kVoxelSize = 0.02; // [m]
constexpr int kPixels = 128;        // along the longer side of a picture
constexpr std::array<uint32_t, 3> kCounts{100, 1000, 10'000};

struct Form
{
    const char* name;
    render::FitForm form;
    uint32_t iterations;
};
constexpr std::array<Form, 4> kForms{{{"uniform", render::FitForm::Uniform, 0},
                                      {"adaptive", render::FitForm::Adaptive, 0},
                                      {"optimized-8", render::FitForm::Optimized, 8},
                                      {"optimized-24", render::FitForm::Optimized, 24}}};

class FitAccuracy final : public AccuracyTechnique
{
public:
    explicit FitAccuracy(const AccuracyScale& scale) : tasks_(base::makeTbbRunner(scale.threads))
    {
        for (const uint32_t count : kCounts)
            for (const Form& form : kForms) {
                const bool isDefault =
                    count == kCounts.back() && form.iterations == render::FitOptions().iterations;
                settings_.push_back(
                    {std::string(form.name) + "-" + std::to_string(count),
                     isDefault ? "default" : "",
                     {{"form", form.name}, {"balls", count}, {"iterations", form.iterations}}});
            }
    }

    std::string_view scene() const override { return "lumps"; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override
    {
        if (grid_.blocks.empty())
            grid_ = lumpyGrid(kDepth, kVoxelSize, *tasks_);
        const Form& form = kForms[setting % kForms.size()];
        const render::FitOptions options{
            .count = kCounts[setting / kForms.size()], .form = form.form, .iterations = form.iterations};
        const auto start = std::chrono::steady_clock::now();
        const auto balls =
            render::fitBalls(grid_, options, *tasks_, [&](uint32_t, uint32_t) { return !stop(); });
        AccuracySample sample;
        sample.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (balls.empty())
            return base::Status(base::Code::Interrupted, "interrupted");
        storeErrors(render::viewErrors(grid_, balls, kPixels, *tasks_), sample);
        const render::MediumGridSums sums = render::sumsOf(grid_);
        double mass = 0.0;
        for (const render::FitBall& ball : balls)
            mass += ball.crossSection;
        sample.items = double(sums.voxels);
        sample.work = {
            {"balls", balls.size()}, {"voxels", sums.voxels}, {"mass_error", mass / sums.crossSection - 1.0}};
        return sample;
    }

private:
    std::unique_ptr<base::TaskRunner> tasks_;
    std::vector<AccuracySetting> settings_;
    render::MediumGrid grid_;
};

} // namespace

AccuracyTechniqueEntry fitAccuracy()
{
    return {"fit",
            "balls fitted to a grid of voxels: pictures of opacity from three sides against integrals of the "
            "grid",
            "voxel",
            ShownError::Mean,
            {"lumps"},
            1,
            false,
            [](const std::string&, const AccuracyScale& scale) -> std::unique_ptr<AccuracyTechnique> {
                return std::make_unique<FitAccuracy>(scale);
            }};
}

} // namespace fx::cli
