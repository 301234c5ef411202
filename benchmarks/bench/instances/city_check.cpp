// fx bench city --check: what hiding changes. Hashes, memory, and pictures of the frames in which effects
// come into sight.
#include "benchmarks/bench/instances/city.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace fx::cli {
namespace {

constexpr int kWarmUp = 60;                ///< steps before the camera turns
constexpr double kTurn = 2.0 * 3.14159265; ///< [rad] in all frames together
constexpr int kReleased = 720;             ///< steps after which memory has been given back
constexpr float kVisible = 1.0f / 255.0f;  ///< smallest visible difference of the picture

/// How the effects of a city are treated out of sight.
struct Policy
{
    const char* name;
    const char* preset; ///< value of "offscreen"
    bool ballistic;
    bool exact; ///< hiding leaves no trace
};

constexpr std::array kPolicies{
    Policy{"analytic", "analytic", true, true}, Policy{"replay", "replay", false, true},
    Policy{"authoritative", "authoritative", false, true}, Policy{"coarse", "coarse", false, false},
    Policy{"skip", "skip", false, false}};

struct Played
{
    std::vector<std::vector<float>> pictures; ///< of each frame
    std::vector<uint32_t> cameBack;           ///< by frame
    std::vector<uint32_t> waking;             ///< by frame: in sight, but not there yet
    uint64_t hash = 0;
    uint64_t bytes = 0; ///< [byte] of the context, after the last frame
    uint64_t hidden = 0;
    base::Status status;
};

/// The camera turns once in all frames, and rests for `more` steps.
Played play(const BenchCityOptions& options, const Policy& policy, bool culling, int more = 0)
{
    Played played;
    auto made = BenchScene::create({options.gl, culling, 96});
    played.status = made.status();
    if (!made.ok())
        return played;
    BenchScene& scene = **made;
    std::vector<FxPresetId> presets;
    for (int i = 0; i < kCityPresets; ++i) {
        const auto preset = scene.load(cityPreset(i, policy.preset, policy.ballistic));
        if (played.status = preset.status(); !preset.ok())
            return played;
        presets.push_back(*preset);
    }
    base::Status& status = played.status;
    status = scene.look(0);
    for (const CityPlace& place : cityPlaces(options.instances))
        if (status.ok())
            status = scene.add(presets[place.number % kCityPresets], place.x, place.z, place.number, 0);
    for (int i = 0; i < kWarmUp && status.ok(); ++i)
        status = scene.update();
    for (uint32_t i = 0; i < options.frames && status.ok(); ++i) {
        status = scene.look(kTurn * (i + 1) / options.frames);
        if (status.ok())
            status = scene.update();
        played.cameBack.push_back(scene.frameStats().cameBack);
        played.waking.push_back(scene.frameStats().waking);
        scene.clearPicture();
        if (status.ok())
            status = scene.draw();
        played.pictures.push_back(scene.picture());
    }
    for (int i = 0; i < more && status.ok(); ++i)
        status = scene.update();
    played.bytes = scene.bytesInUse();
    played.hidden = scene.frameStats().hidden;
    if (status.ok())
        status = toStatus(fxScene_GetSimulationHash(scene.scene(), &played.hash));
    return played;
}

/// How much two runs differ on the frames on which something came into sight.
struct Popping
{
    uint32_t frames = 0;  ///< on which something came
    uint32_t entries = 0; ///< instances that did
    double largest = 0;   ///< [1] of a channel, white is 1; in frames without pending replays
    double late = 0;      ///< [1] the same with pending replays: the replay budget was used up
    double mean = 0;      ///< [1] over the pixels of those frames
    double seen = 0;      ///< [1] largest difference from the background: what could have been missed
};

Popping compare(const Played& culled, const Played& all)
{
    Popping popping;
    double sum = 0;
    size_t values = 0;
    for (size_t frame = 0; frame < culled.pictures.size(); ++frame) {
        popping.entries += culled.cameBack[frame];
        popping.frames += culled.cameBack[frame] > 0;
        const auto& a = culled.pictures[frame];
        const auto& b = all.pictures[frame];
        for (size_t i = 0; i < a.size() && culled.cameBack[frame] > 0; ++i) {
            if (i % 4 == 3)
                continue;
            const double difference = std::abs(double(a[i]) - double(b[i]));
            double& largest = culled.waking[frame] > 0 ? popping.late : popping.largest;
            largest = std::max(largest, difference);
            popping.seen = std::max(popping.seen, std::abs(double(b[i]) - 0.5));
            sum += difference;
            ++values;
        }
    }
    popping.mean = values > 0 ? sum / double(values) : 0;
    return popping;
}

bool report(const BenchCityOptions& options, const Policy& policy, const Played& culled, const Played& all)
{
    const bool isEqual = culled.hash == all.hash;
    const Popping popping = compare(culled, all);
    const bool ok = !policy.exact || (isEqual && popping.largest <= double(kVisible));
    if (options.json)
        printJsonLine(withMachine({{"name", "city check"},
                                   {"variant", policy.name},
                                   {"count", options.instances},
                                   {"hash_equal", isEqual},
                                   {"hidden", culled.hidden},
                                   {"bytes", culled.bytes},
                                   {"bytes_hiding_nothing", all.bytes},
                                   {"entries", popping.entries},
                                   {"popping_largest", popping.largest},
                                   {"popping_late", popping.late},
                                   {"popping_mean", popping.mean},
                                   {"seen_largest", popping.seen}},
                                  readMachine()));
    else
        std::printf(
            "%-13s hash %s; %llu of %u hidden; %.2f MB, %.2f MB when nothing is; %u entries on %u "
            "frames: largest difference %.5f, while a replay was not done %.5f, mean %.2g (effects change "
            "the picture by %.2f)%s\n",
            policy.name, isEqual ? "equal" : "other", static_cast<unsigned long long>(culled.hidden),
            options.instances, 1e-6 * double(culled.bytes), 1e-6 * double(all.bytes), popping.entries,
            popping.frames, popping.largest, popping.late, popping.mean, popping.seen, ok ? "" : "  FAILED");
    return ok;
}

/// Memory of the whole city over that of one that has only as many as are in sight.
bool checkMemory(const BenchCityOptions& options)
{
    BenchCityOptions few = options;
    few.instances = 50;
    const Played many = play(options, kPolicies[0], true, kReleased),
                 alone = play(few, kPolicies[0], false, kReleased);
    if (!many.status.ok() || !alone.status.ok())
        return false;
    const double more = double(many.bytes) - double(alone.bytes);
    const double each = more / (double(options.instances) - 50.0);
    std::printf(
        "memory: %.2f MB with %u instances, %llu of them hidden, %.2f MB with 50 of which all are stepped: "
        "%.0f bytes for each of the others\n",
        1e-6 * double(many.bytes), options.instances, static_cast<unsigned long long>(many.hidden),
        1e-6 * double(alone.bytes), each);
    return true;
}

} // namespace

int checkCity(const BenchCityOptions& options)
{
    bool ok = true;
    for (const Policy& policy : kPolicies) {
        const Played culled = play(options, policy, true), all = play(options, policy, false);
        for (const base::Status& status : {culled.status, all.status})
            if (!status.ok()) {
                std::fprintf(stderr, "fx bench city: %s\n", status.message().c_str());
                return kFailed;
            }
        ok &= report(options, policy, culled, all);
    }
    if (!options.json)
        ok &= checkMemory(options);
    return ok ? kSuccess : kFailed;
}

} // namespace fx::cli
