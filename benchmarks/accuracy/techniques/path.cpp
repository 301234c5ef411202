/// @file path.cpp
/// Light that is scattered any number of times: noise against time of the path tracer's estimators, and how
/// the error falls with the number of paths.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/lit_ball.h"
#include "benchmarks/accuracy/techniques/path_scenes.h"
#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace fx::cli {
namespace {

using render::FlightEstimator;
using render::ShadowEstimator;

constexpr double kDarkest = 0.02; // of the brightest pixel: darker ones are left out
constexpr uint64_t kReferenceSeed = 77;

struct PathEstimator
{
    const char* name;
    const char* flight;
    const char* shadow;
    render::PathSettings settings;
};

const std::vector<PathEstimator>& estimators()
{
    static const std::vector<PathEstimator> kAll{
        {"delta",
         "one majorant",
         "delta",
         {.flight = FlightEstimator::Analog, .shadow = ShadowEstimator::Delta}},
        {"local",
         "local majorants",
         "ratio",
         {.flight = FlightEstimator::LocalMajorants, .shadow = ShadowEstimator::Ratio}},
        {"depth", "inverse depth", "exact", {.forcedFlights = 0}},
        {"forced", "inverse depth", "exact", {}}};
    return kAll;
}

/// Mean luminance of each pixel, and the variance of one path.
struct PathPicture
{
    std::vector<double> means;
    double variance = 0.0; ///< mean over pixels [cd2/m4]
};

class PathAccuracy final : public AccuracyTechnique
{
public:
    explicit PathAccuracy(const std::string& scene)
        : scene_(scene), parameters_(*pathSceneParameters(scene)), stage_(parameters_)
    {
        for (const PathEstimator& estimator : estimators())
            if (&estimator != &estimators().back())
                add(estimator, parameters_.samples, "");
        for (uint32_t samples = 4; samples <= parameters_.mostSamples; samples *= 4)
            add(estimators().back(), samples, samples == parameters_.samples ? "default" : "");
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    struct Choice
    {
        const PathEstimator* estimator;
        uint32_t samples;
    };

    void add(const PathEstimator& estimator, uint32_t samples, const char* tier)
    {
        settings_.push_back({std::string(estimator.name) + "-" + std::to_string(samples),
                             tier,
                             {{"flight", estimator.flight},
                              {"shadow", estimator.shadow},
                              {"forced_flights", estimator.settings.forcedFlights},
                              {"samples", samples},
                              {"blobs", parameters_.blobs},
                              {"tau", parameters_.opticalDepth},
                              {"albedo", parameters_.albedo},
                              {"g", parameters_.anisotropy}}});
        choices_.push_back({&estimator, samples});
        errors_.push_back(0.0);
    }

    /// @return false: stopped
    bool picture(render::PathIntegrator& integrator, uint64_t seed, uint32_t samples,
                 const std::function<bool()>& stop, PathPicture& out) const;
    void judge(size_t setting, const PathPicture& picture, AccuracySample& outSample);
    /// Of log root mean square error against log samples, by least squares, over the settings of the last
    /// estimator.
    double slope() const;

    std::string scene_;
    PathSceneParameters parameters_;
    PathStage stage_;
    std::vector<AccuracySetting> settings_;
    std::vector<Choice> choices_;
    PathPicture reference_;
    std::vector<double> errors_; ///< root mean square of each setting, relative to the mean light
};

bool PathAccuracy::picture(render::PathIntegrator& integrator, uint64_t seed, uint32_t samples,
                           const std::function<bool()>& stop, PathPicture& out) const
{
    for (int pixel = 0; pixel < stage_.pixels(); ++pixel) {
        if (stop())
            return false;
        double sum = 0.0, squares = 0.0;
        for (uint32_t i = 0; i < samples; ++i) {
            render::PathSampler sampler(seed, uint32_t(pixel), i);
            const auto [x, y] = sampler.pair();
            const double light = integrator.trace(stage_.ray(pixel, x, y), 0.0, sampler).luminance.y;
            sum += light;
            squares += light * light;
        }
        out.means.push_back(sum / samples);
        out.variance += (squares - sum * sum / samples) / (samples - 1.0) / stage_.pixels();
    }
    return true;
}

void PathAccuracy::judge(size_t setting, const PathPicture& picture, AccuracySample& outSample)
{
    const double brightest = *std::max_element(reference_.means.begin(), reference_.means.end());
    const double pixels = double(reference_.means.size());
    double mean = 0.0, squares = -reference_.variance / parameters_.referenceSamples;
    std::vector<double> errors;
    for (size_t pixel = 0; pixel < reference_.means.size(); ++pixel) {
        const double difference = picture.means[pixel] - reference_.means[pixel];
        mean += reference_.means[pixel] / pixels;
        squares += difference * difference / pixels;
        if (reference_.means[pixel] > kDarkest * brightest)
            errors.push_back(difference / reference_.means[pixel]);
    }
    storeErrors(std::move(errors), outSample);
    outSample.variance = picture.variance / (mean * mean);
    errors_[setting] = std::sqrt(std::max(squares, 0.0)) / mean;
    outSample.work["error_rms"] = errors_[setting];
}

double PathAccuracy::slope() const
{
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (size_t k = 0; k < choices_.size(); ++k) {
        if (choices_[k].estimator != &estimators().back())
            continue;
        const double a = std::log(choices_[k].samples), b = std::log(errors_[k]);
        n += 1.0;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

base::Result<AccuracySample> PathAccuracy::run(size_t setting, const std::function<bool()>& stop)
{
    if (reference_.means.empty()) {
        render::PathIntegrator integrator(stage_.scene(), estimators().back().settings);
        PathPicture reference;
        if (!picture(integrator, kReferenceSeed, parameters_.referenceSamples, stop, reference))
            return interruptedStatus();
        reference_ = std::move(reference);
    }
    const Choice& choice = choices_[setting];
    render::PathIntegrator integrator(stage_.scene(), choice.estimator->settings);
    PathPicture found;
    bool isDone = false;
    const MeasuredWork measured =
        measureWork([&] { isDone = picture(integrator, 1, choice.samples, stop, found); });
    if (!isDone)
        return interruptedStatus();
    AccuracySample sample;
    sample.seconds = measured.seconds;
    sample.instructions = measured.instructions;
    sample.items = double(stage_.pixels()) * choice.samples;
    sample.work = {{"paths", sample.items}, {"collisions", integrator.collisions()}};
    judge(setting, found, sample);
    if (setting + 1 == choices_.size()) {
        sample.work["slope"] = slope();
        char note[32];
        std::snprintf(note, sizeof note, "rms error ~ paths^%.2f", slope());
        sample.note = note;
    }
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    if (scene == "lit-ball")
        return makeLitBallAccuracy();
    return std::make_unique<PathAccuracy>(scene);
}

} // namespace

AccuracyTechniqueEntry pathAccuracy()
{
    return {"path",
            "paths of light by plain delta tracking, local majorants and the inverse of the optical depth",
            "path",
            ShownError::Mean,
            {"blobs-270", "cloud", "fire", "lit-ball", "blobs-270-small"},
            3,
            false,
            make};
}

} // namespace fx::cli
