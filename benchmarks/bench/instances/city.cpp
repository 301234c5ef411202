// fx bench city: update and render time of a city of effects against only those that are in sight.
#include "benchmarks/bench/instances/city.h"

#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr double kSpacing = 25.0; ///< [m] between neighbors
constexpr double kNearest = 30.0; ///< [m] a square about the camera is empty
constexpr int kRepeats = 3;

struct CityRun
{
    std::vector<double> update, render; ///< [s] least of the repeats, by frame
    std::vector<bool> wasActive;        ///< by instance
    double visible = 0;                 ///< instances, mean over frames
    uint64_t catchUp = 0;               ///< particle steps
    base::Status status;
};

/// The camera swings by half a degree about -Z and sees 250 m far.
base::Status frame(BenchScene& scene, uint32_t number, CityRun& run)
{
    base::Status status = scene.look(0.5 * 0.01745 * std::sin(0.05 * number));
    const double start = threadSeconds();
    if (status.ok())
        status = scene.update();
    const double updated = threadSeconds();
    if (status.ok())
        status = scene.draw();
    const double drawn = threadSeconds();
    run.update[number] = std::min(run.update[number], updated - start);
    run.render[number] = std::min(run.render[number], drawn - updated);
    return status;
}

base::Status play(const BenchCityOptions& options, const std::vector<CityPlace>& places, CityRun& run)
{
    auto made = BenchScene::create({options.gl, true, 128});
    if (!made.ok())
        return made.status();
    BenchScene& scene = **made;
    std::vector<FxPresetId> presets;
    for (int i = 0; i < kCityPresets; ++i) {
        const auto preset = scene.load(cityPreset(i, "replay", false));
        if (!preset.ok())
            return preset.status();
        presets.push_back(*preset);
    }
    base::Status status = scene.look(0);
    for (const CityPlace& place : places)
        if (status.ok())
            status = scene.add(presets[place.number % kCityPresets], place.x, place.z, place.number, 0);
    FxActivationHints hints = fxDefaultActivationHints();
    hints.maxDistance = 250.0f;
    for (const FxInstanceId id : scene.instances())
        fxScene_SetActivationHints(scene.scene(), id, &hints);
    for (int i = 0; i < 90 && status.ok(); ++i) // until as many die as are born
        status = scene.update();
    for (uint32_t i = 0; i < options.frames && status.ok(); ++i) {
        status = frame(scene, i, run);
        const FxSceneStatistics now = scene.statistics();
        run.visible += double(now.instancesActive) / (double(options.frames) * kRepeats);
        for (size_t k = 0; k < scene.instances().size() && i % 20 == 0; ++k) {
            FxInstanceState state = FX_INSTANCE_DORMANT;
            fxScene_GetInstanceState(scene.scene(), scene.instances()[k], &state, nullptr);
            if (state == FX_INSTANCE_ACTIVE || state == FX_INSTANCE_WAKING)
                run.wasActive[k] = true;
        }
    }
    return status;
}

CityRun measure(const BenchCityOptions& options, const std::vector<CityPlace>& places)
{
    CityRun run;
    run.update.assign(options.frames, 1e30);
    run.render.assign(options.frames, 1e30);
    run.wasActive.assign(places.size(), false);
    for (int repeat = 0; repeat < kRepeats && run.status.ok(); ++repeat)
        run.status = play(options, places, run);
    return run;
}

double sum(const std::vector<double>& values)
{
    double total = 0;
    for (const double value : values)
        total += value;
    return total;
}

/// @param seen instances that are ever in sight  @param few the run of only those
void print(const BenchCityOptions& options, const CityRun& all, size_t seen, const CityRun& few)
{
    const double updateMs = 1e3 * sum(all.update) / options.frames,
                 renderMs = 1e3 * sum(all.render) / options.frames;
    const double fewMs = 1e3 * (sum(few.update) + sum(few.render)) / options.frames;
    const double ratio = (updateMs + renderMs) / fewMs;
    if (options.json)
        printJsonLine(withMachine({{"name", "city"},
                                   {"variant", options.gl ? "gl" : "update"},
                                   {"count", options.instances},
                                   {"visible", all.visible},
                                   {"ever_visible", seen},
                                   {"ms_update", updateMs},
                                   {"ms_submit", renderMs},
                                   {"ms_only_visible", fewMs},
                                   {"ratio", ratio}},
                                  readMachine()));
    else
        std::printf(
            "%u instances, %.1f in sight: %.4f ms update, %.4f ms render; only the %zu that are ever in "
            "sight: %.4f ms; ratio %.3f\n",
            options.instances, all.visible, updateMs, renderMs, seen, fewMs, ratio);
}

} // namespace

std::string cityPreset(int index, const std::string& offscreen, bool ballistic)
{
    const bool curls = !ballistic && index % 3 == 0;
    return R"({"version": 1, "ground": false, "bound": 6, "offscreen": ")" + offscreen +
           R"(", "emitters": [{"maxParticles": )" + std::to_string(64 + 16 * index) +
           R"(, "shape": "sphere", "size": 0.5, "emission": {"rate": )" + std::to_string(20 + 5 * index) +
           R"(}, "lifetime": )" + std::to_string(1.0 + 0.1 * index) +
           R"(, "speed": 1, "radius": 0.2, "forces": {"drag": 0.5, "gravity": 0.1, "curlStrength": )" +
           std::to_string(curls ? 1 : 0) + "}}]}";
}

std::vector<CityPlace> cityPlaces(uint32_t count)
{
    std::vector<CityPlace> places;
    const auto side = int(std::ceil(std::sqrt(double(count)))) + 4;
    for (int row = 0; row < side && places.size() < count; ++row)
        for (int column = 0; column < side && places.size() < count; ++column) {
            const double x = kSpacing * (column - side / 2) + 3.0 * (row % 5);
            const double z = kSpacing * (row - side / 2) + 3.0 * (column % 7);
            if (std::max(std::abs(x), std::abs(z)) > kNearest)
                places.push_back({x, z, uint32_t(places.size())});
        }
    return places;
}

namespace {

int runBenchCity(const BenchCityOptions& options)
{
    if (options.check)
        return checkCity(options);
    if (options.turn > 0)
        return turnCity(options);
    const std::vector<CityPlace> city = cityPlaces(options.instances);
    const CityRun all = measure(options, city);
    std::vector<CityPlace> seen;
    for (size_t i = 0; i < city.size(); ++i)
        if (all.wasActive[i])
            seen.push_back(city[i]);
    const CityRun few = measure(options, seen);
    for (const base::Status& status : {all.status, few.status})
        if (!status.ok()) {
            std::fprintf(stderr, "fx bench city: %s\n", status.message().c_str());
            return kFailed;
        }
    print(options, all, seen.size(), few);
    return kSuccess;
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<BenchCityOptions>();
    command.add_option("--instances", options->instances, "Effects in the city")
        ->check(CLI::Range(100, 1000000));
    command.add_option("--frames", options->frames, "Frames to measure")->check(CLI::Range(1, 100000));
    command.add_option("--turn", options->turn, "Turn by so many degrees a frame: times, replays, memory")
        ->check(CLI::Range(0.0, 180.0));
    command.add_flag("--gl", options->gl, "A view draws each frame as well");
    command.add_flag(
        "--check", options->check,
        "Compare hashes, memory and pictures with a city that hides nothing; fail where an exact "
        "policy differs");
    command.add_flag("--json", options->json, "One object a line");
    command.callback([options, &outExitCode] { outExitCode = runBenchCity(*options); });
}

} // namespace

BenchMeasurement cityBench()
{
    return {"city", "Update and render time of many effects, few in sight, over that of only those in sight",
            addOptions};
}

} // namespace fx::cli
