// fx bench work-units: how long the work units of base::WorkBudget take, on one thread: presets in which one
// kind of work dominates, N updates each. Prints one JSON object a kind: units and nanoseconds of processor
// time an update at the median, and their quotient, which is meant to be about 10. What the kinds count was
// fitted with it.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/fxsdk.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    int updates = 60;
    bool isSmall = false;
};

struct Kind
{
    const char* name;
    const char* parts; ///< of the preset
};

constexpr Kind kKinds[] = {
    {"birth", R"("emitters":[{"maxParticles":100000,"lifetime":0.02,"emission":{"rate":4000000}}])"},
    {"ballistic",
     R"("emitters":[{"maxParticles":200000,"lifetime":20,"emission":{"bursts":[{"time":0,"count":200000}]}}])"},
    {"moved",
     R"("emitters":[{"maxParticles":100000,"lifetime":20,"emission":{"bursts":[{"time":0,"count":100000}]},
        "forces":{"drag":1,"quadraticDrag":0.1}}])"},
    {"octaves",
     R"("emitters":[{"maxParticles":50000,"lifetime":20,"emission":{"bursts":[{"time":0,"count":50000}]},
        "forces":{"drag":1,"curlStrength":1,"curlOctaves":8}}])"},
    {"events",
     R"("emitters":[{"name":"a","maxParticles":20000,"lifetime":20,"emission":{"bursts":[{"time":0,"count":20000}]},
        "events":[{"on":"age","age":0.001,"every":0.1,"emit":"b"},{"on":"age","age":0.002,"every":0.1,"emit":"b"}]},
        {"name":"b","maxParticles":1,"lifetime":0.01}])"},
    {"gas", R"("gas":[{"particles":5000}])"},
    {"gasAtFullSound", R"("gas":[{"particles":1000,"soundSpeed":0,"material":"tnt","pressureRatio":100}])"},
    {"fragments",
     R"("fragments":[{"count":2000,"lifetime":30,"speed":50,"trail":{"spacing":0.05,"maxBlobs":50000,"lifetime":30}}])"},
};

void check(FxResult result)
{
    if (result != FX_OK)
        fail(fxGetLastErrorMessage());
}

template <class T>
T medianOf(std::vector<T> values)
{
    std::nth_element(values.begin(), values.begin() + ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

nlohmann::json measureKind(const Kind& kind, int updates)
{
    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.workers = 1;
    FxContext* context = nullptr;
    check(fxCreateContext(&contextDef, &context));
    const std::string text = R"({"version":1,"duration":60,)" + std::string(kind.parts) + "}";
    FxInstanceDef instance = fxDefaultInstanceDef();
    check(fxLoadPresetText(context, text.data(), text.size(), kind.name, &instance.preset));
    FxSceneDef def = fxDefaultSceneDef();
    def.workBudget = 0;
    FxScene* scene = nullptr;
    check(fxCreateScene(context, &def, &scene));
    FxInstanceId id{};
    check(fxScene_CreateInstance(scene, &instance, &id));
    std::vector<double> seconds;
    std::vector<uint64_t> units;
    for (int i = 0; i < updates; ++i) {
        const double start = processSeconds();
        check(fxScene_Update(scene, 1.0 / 60.0));
        seconds.push_back(processSeconds() - start);
        FxSceneStatistics statistics{};
        statistics.structSize = sizeof statistics;
        check(fxScene_GetStatistics(scene, &statistics));
        units.push_back(statistics.updateWork);
    }
    fxDestroyContext(context);
    const double ns = 1e9 * medianOf(seconds);
    const uint64_t work = medianOf(units);
    if (work == 0)
        fail(std::string(kind.name) + " counts no work");
    return {{"name", "work_units"}, {"kind", kind.name}, {"updates", updates},
            {"units", work},        {"ns", ns},          {"ns_per_unit", ns / double(work)}};
}

void measure(Options options)
{
    if (options.isSmall)
        options.updates = 2;
    const Machine machine = readMachine();
    for (const Kind& kind : kKinds)
        printJsonLine(withMachine(measureKind(kind, options.updates), machine));
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--updates", options->updates, "Of each kind")->check(CLI::Range(1, 1000));
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement workUnitsBench()
{
    return {"work-units",
            "What the units take in which the work of updates is counted, for each kind of work", addOptions};
}

} // namespace fx::cli
