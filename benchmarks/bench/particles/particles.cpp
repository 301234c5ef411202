#include "benchmarks/bench/particles/bench_emitters.h"
#include "benchmarks/bench/particles/bench_stage.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "fxsdk/cli/support/interrupt.h"

#include <algorithm>
#include <array>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 3> kVariants{"lean", "typical", "heavy"};
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

namespace {

constexpr BenchEntry kEntry{"particles", "One emitter: step it, publish the snapshot",
                            kVariants,   true,
                            true,        false,
                            40'000,      50'000'000,
                            "particles", benchParticles};

} // namespace

std::span<const std::string_view> particleVariants()
{
    return kVariants;
}

BenchMeasurement particlesBench()
{
    return measurementOf(kEntry);
}

} // namespace fx::cli
