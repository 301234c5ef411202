// The bench row of markers: nanoseconds of a step.
#include "benchmarks/bench/bench_row.h"
#include "tests/marker/marker_kind.h"
#include "tests/marker/marker_solver.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <vector>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 1> kVariants{"rising"};

base::Result<BenchRow> measure(const BenchSettings& settings, std::string_view)
{
    base::SnapshotSchema schema;
    schema.add(test::kMarkerKind);
    test::MarkerDef def;
    std::vector<std::unique_ptr<sim::Solver>> markers(settings.count);
    for (auto& marker : markers)
        marker = def.create(schema, {}, std::pmr::get_default_resource());
    sim::StepCounters counters;
    sim::StepContext context{};
    context.stepTicks = base::toTicks(1.0 / 60.0);
    context.counters = &counters;
    std::vector<double> times;
    for (uint32_t step = 0; step < std::max(settings.steps, 1u); ++step) {
        const auto start = std::chrono::steady_clock::now();
        for (auto& marker : markers)
            marker->step(context);
        context.tick += context.stepTicks;
        times.push_back(
            std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
    }
    std::sort(times.begin(), times.end());
    BenchRow row;
    row.medianNanoseconds = times[times.size() / 2] / double(settings.count);
    row.p95Nanoseconds = times[times.size() * 19 / 20] / double(settings.count);
    row.more["steps"] = counters.particleSteps;
    return row;
}

constexpr BenchEntry kEntry{"marker", "Steps of markers", kVariants, false,  false, false,
                            1000,     1'000'000,          "markers", measure};

} // namespace

BenchMeasurement markerStepsBench()
{
    return measurementOf(kEntry);
}

} // namespace fx::cli
