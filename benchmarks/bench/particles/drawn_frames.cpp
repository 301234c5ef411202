#include "benchmarks/bench/particles/drawn_frames.h"

#include "benchmarks/bench/particles/bench_stage.h"
#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>

namespace fx::cli {
namespace {

base::Status playFrame(BenchScene& scene, double (*now)(), FrameTimes& times)
{
    const double begin = now();
    base::Status status = scene.update();
    const double updated = now();
    if (status.ok())
        status = scene.draw();
    const double drawn = now();
    scene.finish();
    const double finished = now();
    times.view = scene.viewStatistics();
    const double again = now(); // nothing has changed: only submission is left
    if (status.ok())
        status = scene.draw();
    const double submitted = now() - again;
    scene.finish();
    times.update.push_back(updated - begin);
    times.upload.push_back(std::max(drawn - updated - submitted, 0.0));
    times.submit.push_back(submitted);
    times.finish.push_back(finished - drawn);
    times.calls.push_back(drawn - begin);
    times.whole.push_back(finished - begin);
    times.uploadedBytes.push_back(double(times.view.uploadedBytes));
    return status;
}

} // namespace

base::Status playFrames(BenchScene& scene, const FramePlan& plan, FrameTimes& outTimes)
{
    outTimes = {};
    base::Status status;
    for (uint32_t i = 0; i < plan.warmSteps && status.ok(); ++i)
        status = scene.update();
    for (uint32_t i = 0; i < plan.warmFrames + plan.frames && status.ok(); ++i) {
        if (interruptRequested())
            return interruptedStatus();
        if (i == plan.warmFrames)
            outTimes = {};
        if (plan.isCleared)
            scene.clear();
        status = playFrame(scene, plan.now, outTimes);
    }
    return status;
}

double medianMilliseconds(const std::vector<double>& seconds)
{
    return 1e3 * quantile(seconds, 0.5);
}

} // namespace fx::cli
