// fx bench idle: instructions, time, GL calls and allocations of frames in which nothing is to be seen.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/measure/callgrind.h"
#include "benchmarks/measure/clocks.h"
#include "benchmarks/scenes/bench_scene.h"
#include "fxsdk/cli/support/exit_code.h"
#include "fxsdk/cli/support/json_line.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct BenchIdleOptions
{
    uint32_t dormant = 0;  ///< instances before their start
    uint32_t hidden = 0;   ///< instances behind the camera
    bool gl = false;       ///< a view draws each frame as well
    bool turn = false;     ///< the camera moves each frame
    bool visitAll = false; ///< reads the state of every instance in each frame: the control of the limits
    bool check = false;    ///< compares the costs of few and many against the gates
    bool json = false;
    bool countWork = false; ///< runs the frames that callgrind counts, and prints nothing
};

} // namespace
} // namespace fx::cli

namespace {

/// Frames that callgrind counts: it collects inside this function and nowhere else.
struct IdleFrames
{
    fx::cli::BenchScene* scene;
    const fx::cli::BenchIdleOptions* options;
    int count;
    bool failed;
};

} // namespace

extern "C" [[gnu::noinline]] void fxIdleFrames(IdleFrames* frames)
{
    for (int i = 0; i < frames->count; ++i) {
        if (frames->options->turn)
            frames->failed |= !frames->scene->look(0.01 * (i % 10)).ok();
        frames->failed |= fxScene_Update(frames->scene->scene(), 1.0 / 60.0) != FX_OK;
        if (frames->options->gl)
            frames->failed |= fxView_Render(frames->scene->view(), &frames->scene->frameDef()) != FX_OK;
        if (!frames->options->visitAll)
            continue;
        for (const FxInstanceId id : frames->scene->instances())
            frames->failed |= fxScene_GetInstanceState(frames->scene->scene(), id, nullptr, nullptr) != FX_OK;
    }
}

namespace fx::cli {
namespace {

constexpr int kFrames = 100;
constexpr double kMaxIdle = 500;  ///< instructions of an empty scene at rest
constexpr double kMaxGrowth = 10; ///< instructions that many instances add to a thousand
constexpr uint32_t kFew = 1000;

constexpr const char* kFountain = R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64,
    "shape": "sphere", "size": 0.5, "emission": {"rate": 60}, "lifetime": 1, "speed": 1, "radius": 0.2}]})";

struct IdleRow
{
    double instructions = -1; ///< of a frame; negative without callgrind
    double nanoseconds = 0;   ///< [ns] of a frame, the least of several measurements
    uint64_t glCalls = 0;
    uint64_t allocations = 0;
    base::Status status;
};

base::Result<std::unique_ptr<BenchScene>> makeScene(const BenchIdleOptions& options)
{
    auto made = BenchScene::create({options.gl, true, 64, false}); // the compiler is slow under valgrind
    if (!made.ok())
        return made.status();
    BenchScene& scene = **made;
    const auto preset = scene.load(kFountain);
    if (!preset.ok())
        return preset.status();
    if (base::Status status = scene.look(0); !status)
        return status;
    base::Status status;
    for (uint32_t i = 0; i < options.dormant && status.ok(); ++i)
        status = scene.add(*preset, i % 300, i / 300 % 300, i, 1000 * FX_TICKS_PER_SECOND + i);
    for (uint32_t i = 0; i < options.hidden && status.ok(); ++i)
        status = scene.add(*preset, double(i % 300) - 150, 20.0 + i / 300 % 400, i, 0);
    IdleFrames warmUp{made->get(), &options, 8, false};
    fxIdleFrames(&warmUp);
    if (!status || warmUp.failed)
        return status ? base::Status(base::Code::Internal, fxGetLastErrorMessage()) : status;
    return std::move(*made);
}

std::vector<std::string> argumentsOf(const BenchIdleOptions& options)
{
    std::vector<std::string> words{"bench",
                                   "idle",
                                   "--count-work",
                                   "--dormant",
                                   std::to_string(options.dormant),
                                   "--hidden",
                                   std::to_string(options.hidden)};
    for (const auto& [isSet, word] : {std::pair(options.gl, "--gl"), std::pair(options.turn, "--turn"),
                                      std::pair(options.visitAll, "--visit-all")})
        if (isSet)
            words.push_back(word);
    return words;
}

/// The calls that callgrind counts: warm-up, a hundred frames, two hundred frames.
int countWork(const BenchIdleOptions& options)
{
    auto scene = makeScene(options);
    if (!scene.ok())
        return kFailed;
    for (const int frames : {kFrames, 2 * kFrames}) {
        IdleFrames run{scene->get(), &options, frames, false};
        fxIdleFrames(&run);
        if (run.failed)
            return kFailed;
    }
    return kSuccess;
}

IdleRow measure(const BenchIdleOptions& options)
{
    IdleRow row;
    auto scene = makeScene(options);
    if (!scene.ok())
        return {-1, 0, 0, 0, scene.status()};
    row.nanoseconds = 1e30;
    for (int repeat = 0; repeat < 7; ++repeat) {
        IdleFrames run{scene->get(), &options, kFrames, false};
        const double before = threadSeconds();
        fxIdleFrames(&run);
        row.nanoseconds = std::min(row.nanoseconds, 1e9 * (threadSeconds() - before) / kFrames);
    }
    row.glCalls = (*scene)->viewStatistics().glCalls;
    row.allocations = (*scene)->statistics().updateAllocations + (*scene)->viewStatistics().allocations;
    if (!hasCallgrind())
        return row;
    const auto counts = countUnderCallgrind(argumentsOf(options), "fxIdleFrames", 3);
    if (!counts.ok())
        row.status = counts.status();
    else
        row.instructions = ((*counts)[2] - (*counts)[1]) / kFrames;
    return row;
}

void print(const BenchIdleOptions& options, const IdleRow& row)
{
    nlohmann::json line = {
        {"dormant", options.dormant}, {"hidden", options.hidden},      {"visible", 0},
        {"gl", options.gl},           {"turn", options.turn},          {"ns_per_frame", row.nanoseconds},
        {"gl_calls", row.glCalls},    {"allocations", row.allocations}};
    line["instructions_per_frame"] =
        row.instructions < 0 ? nlohmann::json(nullptr) : nlohmann::json(row.instructions);
    if (options.json) {
        printJsonLine(withMachine(std::move(line), readMachine()));
        return;
    }
    std::printf("%8u dormant %8u hidden%s%s: %8.0f instructions, %8.0f ns, %llu GL calls, %llu allocations\n",
                options.dormant, options.hidden, options.gl ? ", GL" : "", options.turn ? ", turning" : "",
                row.instructions, row.nanoseconds, static_cast<unsigned long long>(row.glCalls),
                static_cast<unsigned long long>(row.allocations));
}

/// @return false when it could not be measured
bool measureAndPrint(const BenchIdleOptions& options, IdleRow& outRow)
{
    outRow = measure(options);
    if (!outRow.status.ok()) {
        std::fprintf(stderr, "fx bench idle: %s\n", outRow.status.message().c_str());
        return false;
    }
    print(options, outRow);
    return true;
}

bool gate(const char* what, double value, double most)
{
    if (value <= most)
        return true;
    std::fprintf(stderr, "fx bench idle: %s: %.1f, at most %.1f is allowed\n", what, value, most);
    return false;
}

/// An empty scene, and many against a thousand.
int checkGates(const BenchIdleOptions& options)
{
    if (!hasCallgrind()) {
        std::fprintf(stderr, "fx bench idle: --check counts instructions with valgrind, which is missing or "
                             "cannot run fx on this processor\n");
        return kFailed;
    }
    BenchIdleOptions few = options, many = options, empty = options;
    empty.dormant = empty.hidden = 0;
    bool ok = true;
    IdleRow base, less, more;
    if (!measureAndPrint(empty, base))
        return kFailed;
    ok &= gate("instructions of an empty frame", base.instructions, kMaxIdle);
    ok &= gate("GL calls of an empty frame", double(base.glCalls), 0);
    ok &= gate("allocations of an empty frame", double(base.allocations), 0);
    for (uint32_t BenchIdleOptions::*kind : {&BenchIdleOptions::dormant, &BenchIdleOptions::hidden}) {
        few = many = empty;
        few.*kind = kFew;
        many.*kind = std::max(options.*kind, 2 * kFew);
        if (!measureAndPrint(few, less) || !measureAndPrint(many, more))
            return kFailed;
        ok &= gate("instructions that more instances add", more.instructions - less.instructions, kMaxGrowth);
        ok &= gate("allocations of a frame", double(more.allocations), 0);
    }
    return ok ? kSuccess : kFailed;
}

int runBenchIdle(const BenchIdleOptions& options)
{
    if (options.countWork)
        return countWork(options);
    if (options.check)
        return checkGates(options);
    IdleRow row;
    return measureAndPrint(options, row) ? kSuccess : kFailed;
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<BenchIdleOptions>();
    command.add_option("--dormant", options->dormant, "Instances before their start")
        ->check(CLI::Range(0, 1000000));
    command.add_option("--hidden", options->hidden, "Instances behind the camera")
        ->check(CLI::Range(0, 1000000));
    command.add_flag("--gl", options->gl, "A view draws each frame as well");
    command.add_flag("--turn", options->turn, "The camera moves each frame");
    command.add_flag("--visit-all", options->visitAll,
                     "Ask every instance for its state: the gates' control");
    command.add_flag("--check", options->check,
                     "Compare an empty scene, a thousand and many with the gates; fail beyond them");
    command.add_flag("--json", options->json, "One object a line");
    command.add_flag("--count-work", options->countWork)->group(""); // for callgrind
    command.callback([options, &outExitCode] { outExitCode = runBenchIdle(*options); });
}

} // namespace

BenchMeasurement idleBench()
{
    return {"idle",
            "Instructions, time, GL calls and allocations of frames in which nothing is to be seen; "
            "counts instructions with valgrind when it is installed",
            addOptions};
}

} // namespace fx::cli
