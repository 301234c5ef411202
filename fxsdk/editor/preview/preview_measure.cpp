/// @file preview_measure.cpp
/// Frames of a preview, and the time that their stages take.

#include "fxsdk/editor/preview/preview.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <chrono>

namespace fx::editor {

namespace {

base::Status statusOf(const fxsdk::Error& error)
{
    return {base::Code(error.code()), error.what()};
}

constexpr size_t kLaps = 5; // frames and steps

using Laps = std::array<double, kLaps>;

double medianOf(Laps values)
{
    std::sort(values.begin(), values.end());
    return values[kLaps / 2];
}

double halfRangeOf(const Laps& values)
{
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    return 0.5 * (*most - *least);
}

double millisecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

base::Status Preview::measureStep(double& outMilliseconds, double* outRange)
{
    Laps laps{};
    try {
        for (double& lap : laps) {
            const auto start = std::chrono::steady_clock::now();
            if (base::Status status = step(); !status)
                return status;
            lap = millisecondsSince(start);
        }
    } catch (const fxsdk::Error& error) {
        return statusOf(error);
    }
    outMilliseconds = medianOf(laps);
    if (outRange)
        *outRange = halfRangeOf(laps);
    for (Shown& shown : shown_)
        shown.at = -1.0; // it is elsewhere now
    return {};
}

base::Status Preview::measure(const PreviewFrame& frame, StageTimes& outTimes, double* outRange)
{
    if (base::Status status = renderStages(frame, nullptr); !status) // makes textures
        return status;
    std::array<StageTimes, kLaps> laps;
    for (StageTimes& lap : laps)
        if (base::Status status = renderStages(frame, &lap); !status)
            return status;
    const auto lapsOf = [&](auto&& value) {
        Laps values{};
        std::transform(laps.begin(), laps.end(), values.begin(), value);
        return values;
    };
    for (double StageTimes::*member : {&StageTimes::lights, &StageTimes::stage, &StageTimes::effects})
        outTimes.*member = medianOf(lapsOf([&](const StageTimes& lap) { return lap.*member; }));
    double range = 0.0;
    const base::Status status = measureStep(outTimes.simulation, &range);
    if (outRange)
        *outRange =
            range + halfRangeOf(lapsOf([](const StageTimes& lap) { return lap.lights + lap.effects; }));
    return status;
}

/// @param outTimes receives the time of each stage, for which the GPU finishes it; null: no time is measured
base::Status Preview::renderStages(const PreviewFrame& frame, StageTimes* outTimes)
{
    const render::CameraView camera = cameraOf(frame);
    const FxViewSettings settings = settingsOf(frame);
    FxFrameDef def = frameOf(camera, frame);
    auto start = std::chrono::steady_clock::now();
    const auto lap = [&](double StageTimes::*member) {
        if (!outTimes)
            return;
        device_->gl.Finish();
        outTimes->*member = millisecondsSince(start);
        start = std::chrono::steady_clock::now();
    };
    try {
        view_->setSettings(settings);
        if (base::Status status = lightStage(def); !status)
            return status;
        lap(&StageTimes::lights);
        if (base::Status status =
                stage_->render(camera, lit_.lighting(), settings.exposureEv100, frame.width, frame.height);
            !status)
            return status;
        lap(&StageTimes::stage);
        def.colorTexture = stage_->colorTexture();
        def.depthTexture = stage_->depthTexture();
        const render::HostShadowMap map = stage_->sunShadow(camera.origin);
        def.sunShadowTexture = map.texture;
        std::copy_n(glm::value_ptr(map.fromWorld), 16, def.sunShadowMatrix);
        def.sunShadowEdge = map.edge;
        view_->render(def);
        lap(&StageTimes::effects);
    } catch (const fxsdk::Error& error) {
        return statusOf(error);
    }
    return {};
}

} // namespace fx::editor
