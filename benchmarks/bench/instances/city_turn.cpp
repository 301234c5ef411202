// fx bench city --turn: a camera that turns fast, so that in every frame many effects come into sight.
#include "benchmarks/bench/instances/city.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <algorithm>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr int kWarmUp = 900; ///< steps after which what is hidden has given its memory back

struct Turned
{
    std::vector<double> milliseconds; ///< of each update
    uint64_t mostParticleSteps = 0;   ///< of an update, for replays
    uint32_t mostWaking = 0;          ///< in sight and not yet there
    uint32_t mostReturned = 0;        ///< in an update
    uint64_t allocations = 0;         ///< of the second half of the updates
    double bytesEach = 0;             ///< [byte] in use over instances, before the camera turns
    base::Status status;
};

base::Status build(const BenchCityOptions& options, const char* policy, BenchScene& scene)
{
    std::vector<FxPresetId> presets;
    for (int i = 0; i < kCityPresets; ++i) {
        const auto preset = scene.load(cityPreset(i, policy, policy == std::string("analytic")));
        if (!preset.ok())
            return preset.status();
        presets.push_back(*preset);
    }
    base::Status status = scene.look(0);
    FxActivationHints hints = fxDefaultActivationHints();
    hints.maxDistance = 250.0f;
    for (const CityPlace& place : cityPlaces(options.instances)) {
        if (status.ok())
            status = scene.add(presets[place.number % kCityPresets], place.x, place.z, place.number, 0);
        if (status.ok())
            status = toStatus(fxScene_SetActivationHints(scene.scene(), scene.instances().back(), &hints));
    }
    for (int i = 0; i < kWarmUp && status.ok(); ++i)
        status = scene.update();
    return status;
}

Turned play(const BenchCityOptions& options, const char* policy)
{
    Turned turned;
    auto made = BenchScene::create({false, true, 64});
    turned.status = made.status();
    if (!made.ok())
        return turned;
    BenchScene& scene = **made;
    base::Status& status = turned.status;
    const uint64_t empty = scene.bytesInUse();
    status = build(options, policy, scene);
    turned.bytesEach = double(scene.bytesInUse() - empty) / options.instances;
    for (uint32_t i = 0; i < options.frames && status.ok(); ++i) {
        status = scene.look(0.0174533 * options.turn * (i + 1));
        const double start = threadSeconds();
        if (status.ok())
            status = scene.update();
        turned.milliseconds.push_back(1e3 * (threadSeconds() - start));
        const FxFrameStats now = scene.frameStats();
        turned.mostParticleSteps = std::max(turned.mostParticleSteps, now.catchUpParticleSteps);
        turned.mostWaking = std::max(turned.mostWaking, now.waking);
        turned.mostReturned = std::max(turned.mostReturned, now.cameBack);
        turned.allocations += i >= options.frames / 2 ? scene.statistics().updateAllocations : 0;
    }
    std::sort(turned.milliseconds.begin(), turned.milliseconds.end());
    return turned;
}

void print(const BenchCityOptions& options, const char* policy, const Turned& turned)
{
    const auto share = [&](double part) {
        return turned.milliseconds[size_t(part * double(turned.milliseconds.size() - 1))];
    };
    if (options.json)
        printJsonLine(withMachine({{"name", "city turn"},
                                   {"variant", policy},
                                   {"count", options.instances},
                                   {"degrees", options.turn},
                                   {"ms_median", share(0.5)},
                                   {"ms_p99", share(0.99)},
                                   {"ms_most", share(1.0)},
                                   {"replayed_most", turned.mostParticleSteps},
                                   {"returned_most", turned.mostReturned},
                                   {"waking_most", turned.mostWaking},
                                   {"allocations", turned.allocations},
                                   {"bytes_each", turned.bytesEach}},
                                  readMachine()));
    else
        std::printf(
            "%-9s %u instances, %g degrees a frame: update %.3f ms (median), %.3f (99 %%), %.3f (most); "
            "at most %u came back and %llu particle steps were replayed in one, %u waited; "
            "%llu allocations; %.0f bytes each\n",
            policy, options.instances, options.turn, share(0.5), share(0.99), share(1.0), turned.mostReturned,
            static_cast<unsigned long long>(turned.mostParticleSteps), turned.mostWaking,
            static_cast<unsigned long long>(turned.allocations), turned.bytesEach);
}

} // namespace

int turnCity(const BenchCityOptions& options)
{
    for (const char* policy : {"analytic", "replay"}) {
        const Turned turned = play(options, policy);
        if (!turned.status.ok()) {
            std::fprintf(stderr, "fx bench city: %s\n", turned.status.message().c_str());
            return kFailed;
        }
        print(options, policy, turned);
    }
    return kSuccess;
}

} // namespace fx::cli
