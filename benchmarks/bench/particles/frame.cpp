// fx bench frame: everything that a frame of sprites costs, through the C API: update of the scene, upload,
// submission of the draws, and the wait until the picture is there. A snapshot goes to the GPU once, so that
// upload is what the first drawing of a step takes longer than the second.
#include "benchmarks/bench/particles/bench_stage.h"
#include "benchmarks/bench/particles/drawn_frames.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "benchmarks/measure/clocks.h"

#include <array>
#include <string>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 2> kVariants{"unsorted", "sorted"};
constexpr int kPixels = 512;
constexpr uint32_t kWarmSteps = 200; // a life and some more
constexpr uint32_t kPoolFrames = 4;  // with drawing, until emitters have moved to the GPU

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
    const FramePlan plan{wallSeconds, kWarmSteps, kPoolFrames, settings.steps > 0 ? settings.steps : 30,
                         false};
    FrameTimes times;
    if (status.ok())
        status = playFrames(**scene, plan, times);
    if (!status)
        return status;
    const FxViewStatistics view = (*scene)->viewStatistics();
    BenchRow row;
    row.medianNanoseconds = 1e9 * quantile(times.whole, 0.5) / double(settings.count);
    row.p95Nanoseconds = 1e9 * quantile(times.whole, 0.95) / double(settings.count);
    row.bytesPerParticle = quantile(times.uploadedBytes, 0.5) / double(settings.count);
    if (fxScene_GetSimulationHash((*scene)->scene(), &row.hash) != FX_OK)
        return base::Status{base::Code::Internal, fxGetLastErrorMessage()};
    row.more = {{"ms_update", medianMilliseconds(times.update)},
                {"ms_upload", medianMilliseconds(times.upload)},
                {"ms_submit", medianMilliseconds(times.submit)},
                {"ms_finish", medianMilliseconds(times.finish)},
                {"ms_frame", medianMilliseconds(times.whole)},
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
