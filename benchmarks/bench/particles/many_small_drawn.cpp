// fx bench many-small --gl: what a view takes to draw many small effects, and the same particles in few. The
// picture is small: what counts is the way from the snapshot to the GPU, not the pixels.
#include "benchmarks/bench/particles/bench_stage.h"
#include "benchmarks/bench/particles/drawn_frames.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "benchmarks/measure/clocks.h"
#include "foundation/math/hash.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr int kPixels = 64;
constexpr uint32_t kWarmSteps = 250; // a life of 2 s, and until emitters have joined
constexpr uint32_t kWarmDraws = 8;

std::string presetText(uint32_t each)
{
    return R"({"version": 1, "ground": false, "emitters": [{"maxParticles": )" + std::to_string(each + 4) +
           R"(, "emission": {"rate": )" + std::to_string(double(each) / 2.0) +
           R"(}, "lifetime": 2, "speed": {"min": 2, "max": 6}, "radius": 0.05, "forces": {"drag": 0.75}, )" +
           R"("appearance": {"kind": "sprite", "luminance": 4000, "lit": 0, "order": "depth"}}]})";
}

/// In rows before the camera, all in sight.
base::Status addInstances(BenchScene& scene, FxPresetId preset, uint64_t count)
{
    const uint64_t side = uint64_t(std::ceil(std::sqrt(double(count))));
    base::Status status;
    for (uint64_t i = 0; i < count && status.ok(); ++i) {
        const double x = (double(i % side) + 0.5) / double(side), z = double(i / side) / double(side);
        status = scene.add(preset, 10.0 * (x - 0.5), -30.0 - 10.0 * z, i + 1, 0);
    }
    return status;
}

} // namespace

base::Result<BenchRow> benchManyDrawn(const BenchSettings& settings, std::string_view variant)
{
    BenchScene::Options options;
    options.gl = true;
    options.pixels = kPixels;
    auto scene = BenchScene::create(options);
    if (!scene.ok())
        return scene.status();
    const uint32_t each = manySmallParticles(variant);
    const uint64_t instances = std::max<uint64_t>(settings.count / each, 1);
    auto preset = (*scene)->load(presetText(each));
    if (!preset.ok())
        return preset.status();
    base::Status status = addInstances(**scene, *preset, instances);
    if (status.ok())
        status = (*scene)->look(0);
    // By the time of this thread alone: threads that put pixels together do not count.
    const FramePlan plan{threadSeconds, kWarmSteps, kWarmDraws, settings.steps > 0 ? settings.steps : 300,
                         true};
    FrameTimes times;
    if (status.ok())
        status = playFrames(**scene, plan, times);
    if (!status)
        return status;
    const std::vector<float> picture = (*scene)->picture();
    BenchRow row;
    row.medianNanoseconds = 1e9 * quantile(times.calls, 0.5) / double(settings.count);
    row.p95Nanoseconds = 1e9 * quantile(times.calls, 0.95) / double(settings.count);
    row.hash = base::hashBytes(0, picture.data(), picture.size() * sizeof(float));
    row.more = {{"instances", instances},
                {"ms_update", medianMilliseconds(times.update)},
                {"ms_upload", medianMilliseconds(times.upload)},
                {"ms_submit", medianMilliseconds(times.submit)},
                {"draw_calls", times.view.drawCalls},
                {"sorted_particles", times.view.sortedParticles},
                {"uploaded_bytes", times.view.uploadedBytes},
                {"renderer", (*scene)->renderer()}};
    return row;
}

} // namespace fx::cli
