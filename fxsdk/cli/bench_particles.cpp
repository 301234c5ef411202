#include "fxsdk/cli/bench_emitters.h"
#include "fxsdk/cli/bench_rows.h"
#include "fxsdk/cli/bench_stage.h"
#include "fxsdk/cli/interrupt.h"

#include <algorithm>

namespace fx::cli {
namespace {

constexpr uint32_t kWarmSteps = uint32_t(kSteadyAfter * 60.0);

uint32_t stepsFor(const BenchSettings& settings)
{
    if (settings.steps > 0)
        return settings.steps;
    return uint32_t(std::clamp<uint64_t>(200'000'000 / settings.count, 60, 2000));
}

} // namespace

base::Status timeStage(BenchStage& stage, uint32_t steps, const sim::EffectDef& effect, BenchRow& row)
{
    for (uint32_t i = 0; i < steps; ++i) {
        if (interruptRequested())
            return interruptedStatus();
        stage.playTimed();
    }
    const double alive = double(std::max<uint64_t>(stage.particles(), 1));
    row.medianNanoseconds = 1e9 * quantile(stage.times(), 0.5) / alive;
    row.p95Nanoseconds = 1e9 * quantile(stage.times(), 0.95) / alive;
    row.bytesPerParticle = bytesPerParticle(effect);
    const double bandwidth = copyGigabytes(stage.tasks(), row.bytesPerParticle * alive);
    row.bandwidthFraction = row.bytesPerParticle / row.medianNanoseconds / bandwidth;
    row.hash = stage.hash();
    row.more = {{"ns_per_particle_min", 1e9 * quantile(stage.times(), 0.0) / alive},
                {"hash_ns_per_particle", 1e9 * quantile(stage.hashTimes(), 0.5) / alive},
                {"alive", uint64_t(alive)},
                {"steps", steps},
                {"copy_gb_per_s", bandwidth},
                {"path", "cpu"}};
    return {};
}

base::Result<BenchRow> benchParticles(const BenchSettings& settings, std::string_view variant)
{
    if (settings.gpu)
        return measureOnGpu(settings, variant);
    const std::shared_ptr<const sim::EffectDef> effect = benchEffect(variant, uint32_t(settings.count));
    BenchStage stage(settings.threads);
    stage.add(effect, 1);
    stage.play(kWarmSteps);
    const uint64_t allocations = stage.allocations();
    BenchRow row;
    if (base::Status status = timeStage(stage, stepsFor(settings), *effect, row); !status)
        return status;
    row.more["dropped"] = stage.counters().dropped;
    row.more["allocations"] = stage.allocations() - allocations;
    return row;
}

} // namespace fx::cli
