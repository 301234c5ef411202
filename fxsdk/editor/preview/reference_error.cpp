#include "fxsdk/editor/preview/reference_error.h"

#include "fxsdk/cli/render/reference_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace fx::editor {

namespace {

constexpr double kStepsShare = 0.1;     // of the progress
constexpr double kSecondsAtOnce = 0.25; // [s] simulated between two looks at the request to stop
constexpr int kSkyRings = 2;            // 16 directions of the sky
constexpr std::array<double, 3> kLuminance{0.2126, 0.7152, 0.0722}; // of linear Rec. 709

/// Not finite where a color is not.
double luminanceOf(const float* rgb)
{
    double sum = 0.0;
    for (size_t i = 0; i < 3; ++i)
        sum += kLuminance[i] * double(rgb[i]);
    return std::isfinite(sum) ? std::clamp(sum, 0.0, 1.0) : sum;
}

base::Status stopped()
{
    return {base::Code::Interrupted, "the comparison with the reference renderer was cancelled"};
}

} // namespace

ErrorPicture errorOf(const std::vector<float>& picture, const std::vector<float>& reference, int width,
                     int height)
{
    ErrorPicture error;
    error.width = width;
    error.height = height;
    const size_t count = std::min(picture.size(), reference.size()) / 3;
    error.errors.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        const double difference = luminanceOf(&picture[3 * i]) - luminanceOf(&reference[3 * i]);
        const bool isNumber = std::isfinite(difference);
        error.notFinite += isNumber ? 0 : 1;
        error.errors.push_back(isNumber ? float(std::abs(difference)) : 1.0f);
        error.mean += double(error.errors.back());
    }
    if (count == 0)
        return error;
    error.mean /= double(count);
    std::vector<float> sorted = error.errors;
    std::sort(sorted.begin(), sorted.end());
    error.p99 = double(sorted[std::min(size_t(std::ceil(0.99 * double(count))), count) - 1]);
    error.largest = double(sorted.back());
    return error;
}

std::vector<uint8_t> errorColors(const ErrorPicture& error)
{
    struct Stop
    {
        double error;
        std::array<double, 3> color;
    };
    constexpr std::array<Stop, 6> kStops{{{0.001, {0, 0, 0}},
                                          {0.01, {20, 40, 190}},
                                          {0.03, {170, 30, 160}},
                                          {0.1, {245, 110, 30}},
                                          {0.3, {255, 235, 70}},
                                          {1.0, {255, 255, 255}}}};
    std::vector<uint8_t> colors;
    colors.reserve(4 * error.errors.size());
    for (const float value : error.errors) {
        size_t k = 1;
        while (k + 1 < kStops.size() && double(value) > kStops[k].error)
            ++k;
        const Stop &low = kStops[k - 1], &high = kStops[k];
        const double share = std::clamp(
            std::log(std::max(double(value), 1e-6) / low.error) / std::log(high.error / low.error), 0.0, 1.0);
        for (size_t i = 0; i < 3; ++i)
            colors.push_back(uint8_t(std::lround(low.color[i] + share * (high.color[i] - low.color[i]))));
        colors.push_back(255);
    }
    return colors;
}

ReferenceRun::ReferenceRun(const scene_file::SceneFile& scene, double time, const PreviewFrame& frame,
                           std::vector<float> picture)
    : scene_(scene), time_(time), frame_(frame), picture_(std::move(picture)), thread_([this] { run(); })
{}

ReferenceRun::~ReferenceRun()
{
    stop();
    if (thread_.joinable())
        thread_.join();
}

const base::Result<ErrorPicture>& ReferenceRun::result()
{
    if (thread_.joinable())
        thread_.join();
    return *result_;
}

void ReferenceRun::run()
{
    try {
        result_ = compute();
    } catch (const std::exception& error) { // of the memory: the thread is none of the caller's
        result_ = base::Status(base::Code::OutOfMemory, std::string("reference renderer: ") + error.what());
    }
    isDone_ = true;
}

base::Result<ErrorPicture> ReferenceRun::compute()
{
    scene_.meshCollides = false; // as in the editor
    scene_.camera = {};
    scene_.camera.position = frame_.pose.position;
    scene_.camera.target = frame_.pose.target;
    scene_.camera.fovYDegrees = frame_.fovYDegrees;
    cli::EffectSceneOptions options;
    options.compute = "cpu"; // also reads the edited text instead of the file
    auto source = cli::ReferenceSceneSource::create(scene_, options);
    if (!source)
        return source.status();
    const base::Ticks end = base::toTicks(time_), step = base::toTicks(kSecondsAtOnce);
    for (base::Ticks tick = step; tick < end; tick += step) {
        if (isStopped_)
            return stopped();
        if (auto moment = (*source)->frameAt(tick); !moment)
            return moment.status();
        progress_ = kStepsShare * double(tick) / double(end);
    }
    auto frame = (*source)->frameAt(end);
    if (!frame)
        return frame.status();
    render::ReferenceSettings settings;
    settings.width = frame_.width;
    settings.height = frame_.height;
    settings.exposure =
        1.0 / (1.2 * std::exp2(double(frame_.exposureEv100.value_or(scene_.view.exposureEv100))));
    settings.scattering = render::ScatteringMode::Single;
    settings.skyRings = kSkyRings;
    const std::unique_ptr<base::TaskRunner> tasks = base::makeTbbRunner();
    render::ReferenceRenderer renderer;
    if (base::Status status = renderer.build(frame->scene, settings, *tasks); !status)
        return status;
    const auto progress = [&](uint32_t done, uint32_t total) {
        progress_ = kStepsShare + (1.0 - kStepsShare) * double(done) / double(std::max(total, 1u));
    };
    if (base::Status status = renderer.render(nullptr, {progress, [this] { return isStopped_.load(); }});
        !status)
        return isStopped_ ? stopped() : status;
    const std::vector<float> rgba = renderer.interleaved(render::reference_channel::Color);
    std::vector<float> reference;
    reference.reserve(rgba.size() / 4 * 3);
    for (size_t i = 0; i + 3 < rgba.size(); i += 4)
        reference.insert(reference.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    return errorOf(picture_, reference, frame_.width, frame_.height);
}

} // namespace fx::editor
