// fx bench soak: rounds of equal frames in which effects come and go; what they cost at the begin and at the
// end.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/measure/callgrind.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace {

/// Frames that callgrind counts: it collects inside fxSoakFrames() and nowhere else.
struct SoakFrames
{
    fx::cli::BenchScene* scene;
    const FxPresetId* presets;
    uint32_t count;
    bool failed;
};

constexpr int kRound = 600; ///< frames after which everything begins again
constexpr int kLife = 200;  ///< frames that an instance is there
constexpr size_t kAround = 24;
constexpr uint32_t kPresets = 4;

/// One frame of a round: the camera turns, every few frames an effect is taken away and another one added.
bool soakFrame(SoakFrames& frames, int frame)
{
    fx::cli::BenchScene& scene = *frames.scene;
    bool ok = scene.look(2.0 * 3.14159265 * frame / kRound).ok();
    if (frame % (kLife / int(kAround)) == 0) {
        const int place = frame / (kLife / int(kAround));
        if (scene.instances().size() >= kAround)
            scene.remove(0);
        const double angle = 0.2618 * place;
        const int64_t now = scene.statistics().nowTick;
        ok = ok && scene
                       .add(frames.presets[uint32_t(place) % kPresets], 20 * std::sin(angle),
                            20 * std::cos(angle), uint64_t(place), now)
                       .ok();
    }
    scene.clearPicture();
    return ok && scene.update().ok() && scene.draw().ok();
}

} // namespace

extern "C" [[gnu::noinline]] void fxSoakFrames(SoakFrames* frames)
{
    for (int i = 0; i < int(frames->count); ++i)
        frames->failed |= !soakFrame(*frames, i % kRound);
}

namespace fx::cli {
namespace {

constexpr double kMaxGrowth = 0.02;    ///< [1] of memory and instructions, last over first
constexpr uint64_t kSlack = 256 << 10; ///< [byte] of the process, whose pages are not ours alone
constexpr uint32_t kCountedRounds = 6; ///< under callgrind

/// Jumping, replayed, bursting and linked: each way of being out of sight and at rest.
constexpr std::array<const char*, kPresets> kTexts{
    R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64, "shape": "sphere", "size": 0.5,
        "emission": {"rate": 40}, "lifetime": 1, "speed": 1, "radius": 0.2}]})",
    R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64, "shape": "sphere", "size": 0.5,
        "emission": {"rate": 40}, "lifetime": 1, "speed": 1, "radius": 0.2,
        "forces": {"curlStrength": 1, "drag": 1}}]})",
    R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64, "shape": "sphere", "size": 0.5,
        "emission": {"bursts": [{"time": 0, "count": 20, "cycles": 0, "interval": 1.3}]}, "lifetime": 0.4,
        "speed": 1, "radius": 0.2, "trail": {"lifetime": 0.3}}]})",
    R"({"version": 1, "ground": false, "duration": 2, "emitters": [{"maxParticles": 64, "shape": "sphere",
        "size": 0.5, "emission": {"rate": 60}, "lifetime": 1, "speed": 1, "radius": 0.2,
        "appearance": {"kind": "sprite"}}]})"};

struct BenchSoakOptions
{
    uint32_t frames = 100'000;
    bool gl = false;   ///< draw each frame as well
    bool leak = false; ///< leaves an instance behind each round: the control of the gates
    bool check = false;
    bool json = false;
    bool countWork = false; ///< runs the frames that callgrind counts, and prints nothing
};

struct Soak
{
    std::unique_ptr<BenchScene> scene;
    std::vector<FxPresetId> presets;

    SoakFrames frames(uint32_t count) { return {scene.get(), presets.data(), count, false}; }
};

base::Result<Soak> makeSoak(const BenchSoakOptions& options)
{
    auto made = BenchScene::create({options.gl, true, 64});
    if (!made.ok())
        return made.status();
    Soak soak;
    soak.scene = std::move(*made);
    for (const char* text : kTexts) {
        const auto preset = soak.scene->load(text);
        if (!preset.ok())
            return preset.status();
        soak.presets.push_back(*preset);
    }
    return soak;
}

/// [byte] of the process that lie in memory.
uint64_t residentBytes()
{
    std::ifstream file("/proc/self/status");
    std::string word;
    while (file >> word)
        if (word == "VmRSS:") {
            uint64_t kilobytes = 0;
            file >> kilobytes;
            return kilobytes << 10;
        }
    return 0;
}

/// An effect far behind the camera that is never removed.
bool leakOne(Soak& soak)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = soak.presets[0];
    def.position[2] = 1e5;
    FxInstanceId id = {};
    return fxScene_CreateInstance(soak.scene->scene(), &def, &id) == FX_OK;
}

/// The calls that callgrind counts: two rounds to warm up and then one round each.
int countWork(const BenchSoakOptions& options)
{
    auto soak = makeSoak(options);
    if (!soak.ok())
        return kFailed;
    for (uint32_t k = 0; k < kCountedRounds; ++k) {
        SoakFrames frames = soak->frames(k == 0 ? 2 * kRound : kRound);
        fxSoakFrames(&frames);
        if (frames.failed || (options.leak && !leakOne(*soak)))
            return kFailed;
    }
    return kSuccess;
}

struct SoakRow
{
    uint64_t bytesFirst = 0, bytesLast = 0;               ///< [byte] of the context
    uint64_t residentFirst = 0, residentLast = 0;         ///< [byte] of the process
    double instructionsFirst = -1, instructionsLast = -1; ///< of a frame; negative without callgrind
    base::Status status;
};

/// The first figures are of the third round: by then every list has had its size.
SoakRow measure(const BenchSoakOptions& options)
{
    SoakRow row;
    auto soak = makeSoak(options);
    if (row.status = soak.status(); !soak.ok())
        return row;
    const uint32_t rounds = std::max(options.frames / uint32_t(kRound), 4u);
    for (uint32_t k = 0; k < rounds; ++k) {
        SoakFrames frames = soak->frames(kRound);
        fxSoakFrames(&frames);
        if (frames.failed || (options.leak && !leakOne(*soak))) {
            row.status = {base::Code::Internal, fxGetLastErrorMessage()};
            return row;
        }
        const uint64_t bytes = soak->scene->bytesInUse(), resident = residentBytes();
        if (k == 2) {
            row.bytesFirst = bytes;
            row.residentFirst = resident;
        }
        row.bytesLast = bytes;
        row.residentLast = resident;
    }
    if (!hasCallgrind())
        return row;
    std::vector<std::string> words{"bench", "soak", "--count-work"};
    if (options.leak)
        words.push_back("--leak");
    const auto counts = countUnderCallgrind(words, "fxSoakFrames", kCountedRounds);
    if (row.status = counts.status(); !counts.ok())
        return row;
    row.instructionsFirst = (*counts)[1] / kRound;
    row.instructionsLast = (*counts)[kCountedRounds - 1] / kRound;
    return row;
}

bool gate(const char* what, double first, double last, double slack)
{
    if (last <= first * (1.0 + kMaxGrowth) + slack)
        return true;
    std::fprintf(stderr, "fx bench soak: %s grew from %.0f to %.0f\n", what, first, last);
    return false;
}

void print(const BenchSoakOptions& options, const SoakRow& row)
{
    if (options.json)
        printJsonLine(withMachine({{"name", "soak"},
                                   {"variant", options.gl ? "gl" : "update"},
                                   {"count", options.frames},
                                   {"bytes_first", row.bytesFirst},
                                   {"bytes_last", row.bytesLast},
                                   {"resident_first", row.residentFirst},
                                   {"resident_last", row.residentLast},
                                   {"instructions_first", row.instructionsFirst},
                                   {"instructions_last", row.instructionsLast}},
                                  readMachine()));
    else
        std::printf(
            "%u frames: %llu bytes after 1800 frames, %llu at the end; process %llu and %llu; %.0f and "
            "%.0f instructions a frame\n",
            options.frames, static_cast<unsigned long long>(row.bytesFirst),
            static_cast<unsigned long long>(row.bytesLast),
            static_cast<unsigned long long>(row.residentFirst),
            static_cast<unsigned long long>(row.residentLast), row.instructionsFirst, row.instructionsLast);
}

int runBenchSoak(const BenchSoakOptions& options)
{
    if (options.countWork)
        return countWork(options);
    const SoakRow row = measure(options);
    if (!row.status.ok()) {
        std::fprintf(stderr, "fx bench soak: %s\n", row.status.message().c_str());
        return kFailed;
    }
    print(options, row);
    if (!options.check)
        return kSuccess;
    bool ok = gate("memory", double(row.bytesFirst), double(row.bytesLast), 0);
    ok &= gate("the process", double(row.residentFirst), double(row.residentLast), double(kSlack));
    if (row.instructionsFirst >= 0)
        ok &= gate("instructions", row.instructionsFirst, row.instructionsLast, 0);
    else
        std::fprintf(stderr, "fx bench soak: instructions are not counted without valgrind\n");
    return ok ? kSuccess : kFailed;
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<BenchSoakOptions>();
    command.add_option("--frames", options->frames, "To play; a whole number of rounds of 600 is used")
        ->check(CLI::Range(2400, 100000000));
    command.add_flag("--gl", options->gl, "A view draws each frame as well");
    command.add_flag("--leak", options->leak, "Leave an instance behind each round: the gates' control");
    command.add_flag("--check", options->check, "Fail when memory or instructions grow");
    command.add_flag("--json", options->json, "One object");
    command.add_flag("--count-work", options->countWork)->group(""); // for callgrind
    command.callback([options, &outExitCode] { outExitCode = runBenchSoak(*options); });
}

} // namespace

BenchMeasurement soakBench()
{
    return {"soak",
            "Many frames of coming and going: memory and instructions a frame, at the begin and at the end",
            addOptions};
}

} // namespace fx::cli
