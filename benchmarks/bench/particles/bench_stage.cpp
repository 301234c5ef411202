#include "benchmarks/bench/particles/bench_stage.h"

#include "foundation/math/hash.h"
#include "fxsdk/techniques.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr base::Ticks kFrame = base::kTicksPerSecond / 60;
constexpr size_t kCopyBytes = size_t(128) << 20;
constexpr size_t kMinCopy = 4096;
constexpr size_t kMinPart = size_t(64) << 10;
constexpr uint32_t kCopyParts = 64;

base::SnapshotSchema allKinds()
{
    base::SnapshotSchema schema;
    preset::registerKinds(schema);
    return schema;
}

double secondsSince(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

BenchStage::BenchStage(uint32_t threads)
    : schema_(allKinds()), tasks_(threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(threads)),
      world_(&schema_, tasks_.get(), &memory_), ring_(&schema_, &memory_)
{}

void BenchStage::add(std::shared_ptr<const sim::EffectDef> effect, uint64_t seed)
{
    sim::InstanceStart start;
    start.instance = slots_.size() + 1;
    start.seed = seed;
    slots_.push_back(world_.add(std::move(effect), start));
}

const base::FrameSnapshot& BenchStage::frame()
{
    counters_ += world_.step(slots_, now_, kFrame);
    now_ += kFrame;
    base::FrameSnapshot& snapshot = ring_.beginWrite(now_, kFrame);
    world_.publish(slots_, snapshot);
    ring_.publish();
    return snapshot;
}

void BenchStage::play(uint32_t steps)
{
    for (uint32_t i = 0; i < steps; ++i)
        frame();
}

void BenchStage::playTimed()
{
    const Clock::time_point start = Clock::now();
    const base::FrameSnapshot& snapshot = frame();
    times_.push_back(secondsSince(start));
    const Clock::time_point published = Clock::now();
    hash_ = base::hashWord(hash_, snapshot.hash());
    hashTimes_.push_back(secondsSince(published));
}

uint64_t BenchStage::particles() const
{
    uint64_t count = 0;
    for (const sim::Slot slot : slots_)
        count += world_.elementCount(slot);
    return count;
}

double copyGigabytes(base::TaskRunner& tasks, double bytes)
{
    const size_t half = size_t(std::clamp(0.5 * bytes, double(kMinCopy), double(kCopyBytes)));
    const uint32_t parts = uint32_t(std::clamp<size_t>(half / kMinPart, 1, kCopyParts));
    const size_t part = half / parts;
    const size_t repeats = std::max<size_t>(kCopyBytes / 4 / half, 1);
    std::vector<char> from(half, 1);
    std::vector<char> to(half, 2);
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
        const Clock::time_point start = Clock::now();
        for (size_t k = 0; k < repeats; ++k) {
            tasks.parallelFor(parts, 1, [&](uint32_t begin, uint32_t end) {
                std::memcpy(to.data() + begin * part, from.data() + begin * part, (end - begin) * part);
            });
            from[k % half] = to[half - 1]; // keeps the compiler from removing copies
        }
        best = std::min(best, secondsSince(start));
    }
    return 2e-9 * double(part * parts) * double(repeats) / best;
}

double quantile(std::vector<double> times, double part)
{
    if (times.empty())
        return 0;
    const size_t place = std::min(size_t(part * double(times.size())), times.size() - 1);
    std::nth_element(times.begin(), times.begin() + std::ptrdiff_t(place), times.end());
    return times[place];
}

} // namespace fx::cli
