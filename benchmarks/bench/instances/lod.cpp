// fx bench lod: what a level of detail saves, what it changes, and whether flying in shows it.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/instances/lod_flight.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr std::array<LodCase, 7> kCases{{{0, 0}, {1, 0}, {4, 0}, {16, 0}, {0, 13}, {4, 13}, {16, 0, true}}};
constexpr std::array<const char*, 4> kPresets{"smoke-column", "campfire", "steam", "gas-fire"};
constexpr double kSpacing = 18.0; ///< [m]
constexpr uint32_t kSeeds = 16;   ///< instances with the same seed share a simulation
constexpr int kSettleSteps = 420; ///< until as many die as are born

struct BenchLodOptions
{
    uint32_t instances = 1000;
    int pixels = 512;      ///< width and height of the picture
    uint32_t repeats = 12; ///< frames of which the mean time is taken
    uint32_t flight = 48;  ///< frames
    bool json = false;
    bool check = false; ///< fail when a change of level is seen, or when the control's are not
};

/// Of one case.
struct LodRow
{
    LodCase what{};
    double milliseconds = 0; ///< a frame, processor time of all threads
    double submit = 0;       ///< [ms] a frame, of the calling thread
    FxViewStatistics view = {};
    double meanError = 0; ///< [1] sum of differences over sum of light
    double mostError = 0; ///< [1] largest difference over the brightest value
    LodFlight flight{};
};

base::Status addField(BenchScene& scene, uint32_t count)
{
    std::array<FxPresetId, kPresets.size()> presets{};
    for (size_t i = 0; i < kPresets.size(); ++i) {
        const auto preset = scene.loadLibrary(kPresets[i]);
        if (!preset.ok())
            return preset.status();
        presets[i] = *preset;
    }
    uint32_t placed = 0;
    for (uint32_t row = 0; placed < count; ++row) { // as wide as the view at that distance
        const double distance = kLodNearest + kSpacing * row;
        const int half = int(kLodWidest * distance / kSpacing);
        for (int column = -half; column <= half && placed < count; ++column, ++placed)
            if (base::Status status = scene.add(presets[placed % presets.size()], kSpacing * column,
                                                -distance, placed / presets.size() % kSeeds, 0);
                !status)
                return status;
    }
    return {};
}

/// Largest difference of two pictures in units of the brightest value, and the mean one of the light.
void compare(const std::vector<float>& a, const std::vector<float>& b, double& outMost, double& outMean)
{
    double difference = 0, light = 0, most = 0, brightest = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        if (i % 4 == 3)
            continue;
        const double d = std::abs(double(a[i]) - double(b[i]));
        difference += d;
        light += std::abs(double(b[i]));
        most = std::max(most, d);
        brightest = std::max(brightest, std::abs(double(b[i])));
    }
    outMost = brightest > 0 ? most / brightest : 0.0;
    outMean = light > 0 ? difference / light : 0.0;
}

/// Frames as a running scene has them: each shows another moment.
base::Status drawTimed(BenchScene& scene, uint32_t frames, LodRow& row)
{
    const uint32_t warm = warmFrames(row.what);
    for (uint32_t i = 0; i < frames + warm; ++i) {
        if (base::Status status = scene.update(); !status)
            return status;
        scene.clear();
        scene.finish();
        const double all = processSeconds(), own = threadSeconds();
        if (base::Status status = scene.draw(); !status)
            return status;
        const double submit = threadSeconds() - own;
        scene.finish();
        if (i < warm)
            continue;
        row.submit += 1e3 * submit / frames;
        row.milliseconds += 1e3 * (processSeconds() - all) / frames;
        row.view = scene.viewStatistics();
    }
    return {};
}

base::Status measure(const BenchLodOptions& options, std::vector<LodRow>& outRows)
{
    auto made = BenchScene::create({true, true, options.pixels});
    if (!made.ok())
        return made.status();
    BenchScene& scene = **made;
    base::Status status = addField(scene, options.instances);
    for (int i = 0; i < kSettleSteps && status.ok(); ++i)
        status = scene.update();
    for (const LodCase& what : kCases)
        outRows.push_back({what});
    if (status.ok())
        status = scene.look(0.0);
    scene.moveTo(0.0, kLodEyeHeight, 0.0);
    const auto forAll = [&](auto&& measureRow) {
        for (LodRow& row : outRows) {
            if (status.ok())
                status = scene.setView(lodSettings(row.what));
            if (status.ok())
                status = measureRow(row);
        }
    };
    forAll([&](LodRow& row) { return drawTimed(scene, options.repeats, row); });
    std::vector<float> reference;
    forAll([&](LodRow& row) {
        std::vector<float> picture;
        base::Status drawn = drawStill(scene, row.what, picture);
        if (reference.empty())
            reference = picture;
        compare(picture, reference, row.mostError, row.meanError);
        return drawn;
    });
    std::vector<std::vector<float>> flight;
    forAll([&](LodRow& row) {
        return fly(scene, {options.pixels, options.flight}, row.what, flight, row.flight);
    });
    return status;
}

/// What is wrong with the flights; empty: nothing.
std::string findFault(const std::vector<LodRow>& rows)
{
    for (const LodRow& row : rows) {
        const bool hasLevels = row.what.bias > 0.0f || row.what.impostorPixels > 0.0f;
        if (hasLevels && row.flight.changedFrames == 0)
            return "no level has changed in the flight: use more --flight frames or --instances";
        if (row.what.isHard && isSmall(row.flight))
            return "hard switches have not been seen: the flight shows nothing";
        if (!row.what.isHard && !isSmall(row.flight)) {
            char text[200];
            std::snprintf(text, sizeof text,
                          "bias %g, pictures %g: one pop in 100 is over %.3f and one is %.3f; allowed are %g "
                          "and %.3f",
                          double(row.what.bias), double(row.what.impostorPixels), row.flight.pop.p99(),
                          row.flight.pop.largest(), kLodPopP99, kMaxLodPop * row.flight.pop.motionLargest());
            return text;
        }
    }
    return {};
}

void print(const LodRow& row, const LodRow& full, const BenchLodOptions& options)
{
    const uint32_t* g = row.view.lodGroups;
    if (options.json)
        return printJsonLine(withMachine({{"name", "lod"},
                                          {"bias", row.what.bias},
                                          {"impostor_pixels", row.what.impostorPixels},
                                          {"impostors", row.view.impostors},
                                          {"impostors_taken", row.view.impostorsTaken},
                                          {"count", options.instances},
                                          {"pixels", options.pixels},
                                          {"blobs", row.view.blobs},
                                          {"groups", {g[0], g[1], g[2], g[3]}},
                                          {"ms", row.milliseconds},
                                          {"ms_submit", row.submit},
                                          {"ratio", row.milliseconds / full.milliseconds},
                                          {"ratio_submit", row.submit / full.submit},
                                          {"error_mean", row.meanError},
                                          {"error_most", row.mostError},
                                          {"hard", row.what.isHard},
                                          {"flight_changed_frames", row.flight.changedFrames},
                                          {"flight_motion_most", row.flight.pop.motionLargest()},
                                          {"flight_motion_p99", row.flight.pop.motionP99()},
                                          {"flight_pop_most", row.flight.pop.largest()},
                                          {"flight_pop_p99", row.flight.pop.p99()},
                                          {"flight_small", isSmall(row.flight)}},
                                         readMachine()));
    std::printf(
        "%s %3g, pictures %2g: %4u, %6u blobs, groups %4u %4u %4u %4u, %8.2f ms (%.3f), submit "
        "%7.2f ms (%.3f), error mean %.4f most %.4f, flight pop p99 %.4f most %.4f (motion %.4f %.4f) "
        "in %u frames\n",
        row.what.isHard ? "hard" : "bias", double(row.what.bias), double(row.what.impostorPixels),
        row.view.impostors, row.view.blobs, g[0], g[1], g[2], g[3], row.milliseconds,
        row.milliseconds / full.milliseconds, row.submit, row.submit / full.submit, row.meanError,
        row.mostError, row.flight.pop.p99(), row.flight.pop.largest(), row.flight.pop.motionP99(),
        row.flight.pop.motionLargest(), row.flight.changedFrames);
}

int runBenchLod(const BenchLodOptions& options)
{
    std::vector<LodRow> rows;
    if (const base::Status status = measure(options, rows); !status.ok()) {
        std::fprintf(stderr, "fx bench lod: %s\n", status.message().c_str());
        return kFailed;
    }
    for (const LodRow& row : rows)
        print(row, rows.front(), options);
    const std::string fault = options.check ? findFault(rows) : "";
    if (fault.empty())
        return kSuccess;
    std::fprintf(stderr, "fx bench lod: %s\n", fault.c_str());
    return kFailed;
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<BenchLodOptions>();
    command.add_option("--instances", options->instances, "Effects in the field")
        ->check(CLI::Range(1, 100000));
    command.add_option("--size", options->pixels, "[pixel] Width and height of the picture")
        ->check(CLI::Range(64, 4096));
    command.add_option("--repeats", options->repeats, "Frames of which the mean time is taken")
        ->check(CLI::Range(1, 1000));
    command.add_option("--flight", options->flight, "Frames of the flight; 0: none")
        ->check(CLI::Range(0, 100000));
    command.add_flag("--check", options->check,
                     "Fail when a change of level is seen in the flight, or hard switches are not");
    command.add_flag("--json", options->json, "One object a level");
    command.callback([options, &outExitCode] { outExitCode = runBenchLod(*options); });
}

} // namespace

BenchMeasurement lodBench()
{
    return {"lod",
            "A field of far effects drawn with a level of detail: time, picture and a flight towards it",
            addOptions};
}

} // namespace fx::cli
