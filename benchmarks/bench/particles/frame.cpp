// fx bench frame: everything that a frame of sprites costs, through the C API: update of the scene, upload,
// submission of the draws, and the wait until the picture is there. A snapshot goes to the GPU once, so that
// upload is what the first drawing of a step takes longer than the second.
#include "benchmarks/bench/particles/bench_stage.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <string>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 2> kVariants{"unsorted", "sorted"};
constexpr int kPixels = 512;
constexpr uint32_t kWarmFrames = 200; // a life and some more
constexpr uint32_t kPoolFrames = 4;   // with drawing, until emitters have moved to the GPU

using Clock = std::chrono::steady_clock;

double since(Clock::time_point begin)
{
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::string presetText(std::string_view variant, uint64_t count, bool gpu)
{
    return R"({"version": 1, "ground": false, "emitters": [{"compute": ")" +
           std::string(gpu ? "gpu" : "cpu") + R"(", "maxParticles": )" +
           std::to_string(count + count / 100 + 16) +
           R"(, "shape": "box", "position": [0, 0, -6], "size": [2, 2, 2], "emission": {"rate": )" +
           std::to_string(double(count) / 2.0) +
           R"(}, "lifetime": 2, "speed": {"min": 0.1, "max": 0.4}, "radius": 0.01, "forces": {"gravity": 0, )" +
           R"("drag": 0.5}, "appearance": {"kind": "sprite", "blend": "additive", "luminance": 4000, "lit": 0, )" +
           R"("order": ")" + (variant == "sorted" ? "depth" : "none") + "\"}}]}";
}

/// What the timed frames took.
struct Times
{
    std::vector<double> update, upload, submit, finish, whole; ///< [s]
    std::vector<double> bytes;                                 ///< uploaded
};

base::Status playFrame(BenchScene& scene, Times& times)
{
    const Clock::time_point begin = Clock::now();
    base::Status status = scene.update();
    times.update.push_back(since(begin));
    const Clock::time_point drawn = Clock::now();
    if (status.ok())
        status = scene.draw();
    const double first = since(drawn);
    scene.finish();
    times.finish.push_back(since(drawn) - first);
    times.whole.push_back(since(begin));
    times.bytes.push_back(double(scene.viewStatistics().uploadedBytes));
    const Clock::time_point again = Clock::now();
    if (status.ok())
        status = scene.draw();
    times.submit.push_back(since(again));
    times.upload.push_back(std::max(first - times.submit.back(), 0.0));
    scene.finish();
    return status;
}

base::Result<BenchRow> measure(const BenchSettings& settings, std::string_view variant)
{
    BenchScene::Options options;
    options.gl = true;
    options.pixels = kPixels;
    auto scene = BenchScene::create(options);
    if (!scene.ok())
        return scene.status();
    auto preset = (*scene)->load(presetText(variant, settings.count, settings.gpu));
    if (!preset.ok())
        return preset.status();
    base::Status status = (*scene)->add(*preset, 0, 0, 1, 0);
    if (status.ok())
        status = (*scene)->look(0);
    for (uint32_t i = 0; i < kWarmFrames && status.ok(); ++i)
        status = (*scene)->update();
    Times times;
    const uint32_t frames = settings.steps > 0 ? settings.steps : 30;
    for (uint32_t i = 0; i < frames + kPoolFrames && status.ok(); ++i) {
        if (interruptRequested())
            return interruptedStatus();
        if (i == kPoolFrames)
            times = {}; // what came before has filled pools
        status = playFrame(**scene, times);
    }
    if (!status)
        return status;
    const FxViewStatistics view = (*scene)->viewStatistics();
    const auto milliseconds = [](const std::vector<double>& t) { return 1e3 * quantile(t, 0.5); };
    BenchRow row;
    row.medianNanoseconds = 1e9 * quantile(times.whole, 0.5) / double(settings.count);
    row.p95Nanoseconds = 1e9 * quantile(times.whole, 0.95) / double(settings.count);
    row.bytesPerParticle = quantile(times.bytes, 0.5) / double(settings.count);
    if (fxScene_GetSimulationHash((*scene)->scene(), &row.hash) != FX_OK)
        return base::Status{base::Code::Internal, fxGetLastErrorMessage()};
    row.more = {{"ms_update", milliseconds(times.update)},
                {"ms_upload", milliseconds(times.upload)},
                {"ms_submit", milliseconds(times.submit)},
                {"ms_finish", milliseconds(times.finish)},
                {"ms_frame", milliseconds(times.whole)},
                {"overdraw", double(view.estimatedFragments) / (double(kPixels) * kPixels)},
                {"draw_calls", view.drawCalls},
                {"gl_calls", view.glCalls},
                {"path", view.gpuParticles > 0 ? "gpu" : "cpu"},
                {"renderer", (*scene)->renderer()}};
    return row;
}

constexpr BenchEntry kEntry{"frame",   "Update, upload, submission and drawing of sprites with OpenGL",
                            kVariants, false,
                            true,      false,
                            20'000,    16'000'000,
                            "sprites", measure};

} // namespace

BenchMeasurement frameBench()
{
    return measurementOf(kEntry);
}

} // namespace fx::cli
