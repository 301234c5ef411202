#include "fxsdk/cli/bench_emitters.h"
#include "fxsdk/cli/bench_rows.h"

#include <algorithm>

namespace fx::cli {
namespace {

constexpr uint64_t kUsualCount = 10000;
constexpr uint32_t kPerSmall = 10;   // particles of an effect in "many"
constexpr uint32_t kPerLarge = 1000; // in "few"
constexpr uint32_t kWarmSteps = uint32_t(kSteadyAfter * 60.0);

base::Result<BenchRow> measure(const BenchSettings& settings, std::string_view variant)
{
    const uint32_t each = variant == "many" ? kPerSmall : kPerLarge;
    const std::shared_ptr<const sim::EffectDef> effect = benchEffect("lean", each);
    BenchStage stage(settings.threads);
    const uint64_t instances = std::max<uint64_t>(settings.count / each, 1);
    for (uint64_t i = 0; i < instances; ++i)
        stage.add(effect, i + 1); // different seeds: none is simulated together with another
    stage.play(kWarmSteps);
    BenchRow row;
    row.name = "many-small";
    row.variant = variant;
    row.count = settings.count;
    const uint32_t steps = settings.steps > 0 ? settings.steps : 2000;
    if (base::Status status = timeStage(stage, steps, *effect, row); !status)
        return status;
    row.more["instances"] = instances;
    return row;
}

} // namespace

base::Result<std::vector<BenchRow>> benchManySmall(const BenchSettings& asked)
{
    BenchSettings settings = asked;
    if (settings.count == 0)
        settings.count = kUsualCount;
    std::vector<BenchRow> rows;
    for (const std::string_view variant : findBenchEntry("many-small")->variants) {
        if (!settings.variant.empty() && settings.variant != variant)
            continue;
        base::Result<BenchRow> row = measure(settings, variant);
        if (!row)
            return row.status();
        rows.push_back(std::move(*row));
    }
    return rows;
}

} // namespace fx::cli
