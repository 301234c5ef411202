#include "fxsdk/cli/bench_emitters.h"
#include "fxsdk/cli/bench_rows.h"

#include <algorithm>

namespace fx::cli {
namespace {

constexpr uint32_t kPerSmall = 10;   // particles of an effect in "many"
constexpr uint32_t kPerLarge = 1000; // in "few"
constexpr uint32_t kWarmSteps = uint32_t(kSteadyAfter * 60.0);

} // namespace

base::Result<BenchRow> benchManySmall(const BenchSettings& settings, std::string_view variant)
{
    if (settings.gl)
        return benchManyDrawn(settings, variant);
    const uint32_t each = variant == "many" ? kPerSmall : kPerLarge;
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

} // namespace fx::cli
