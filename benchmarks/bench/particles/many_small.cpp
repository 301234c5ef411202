#include "benchmarks/bench/particles/bench_emitters.h"
#include "benchmarks/bench/particles/particle_rows.h"

#include <algorithm>
#include <array>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 2> kVariants{"many", "few"};
constexpr uint32_t kWarmSteps = uint32_t(kSteadyAfter * 60.0);

base::Result<BenchRow> measure(const BenchSettings& settings, std::string_view variant)
{
    if (settings.gl)
        return benchManyDrawn(settings, variant);
    const uint32_t each = manySmallParticles(variant);
    const std::shared_ptr<const sim::EffectDef> effect = benchEffect("lean", each);
    BenchStage stage(settings.threads);
    const uint64_t instances = std::max<uint64_t>(settings.count / each, 1);
    for (uint64_t i = 0; i < instances; ++i)
        stage.add(effect, i + 1); // different seeds: none is simulated together with another
    stage.play(kWarmSteps);
    BenchRow row;
    const uint32_t steps = settings.steps > 0 ? settings.steps : 2000;
    if (base::Status status = timeStage(stage, steps, *effect, row); !status)
        return status;
    row.more["instances"] = instances;
    return row;
}

constexpr BenchEntry kEntry{"many-small", "The same number of particles in many small effects and in few",
                            kVariants,    true,
                            false,        true,
                            10'000,       uint64_t(1) << 32,
                            "particles",  measure};

} // namespace

BenchMeasurement manySmallBench()
{
    return measurementOf(kEntry);
}

} // namespace fx::cli
