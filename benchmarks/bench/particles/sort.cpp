// fx bench sort: the order of drawing on one thread. random: elements in random order; same: once more as
// they are; hundredth-moved: one in a hundred moved anywhere; all-nearer: the camera has gone a little on;
// nearer-and-moved: both. Others to compare with, of elements in random order: standard, std::sort of
// distance and index; radix, a plain stable radix sort of three digits of 11 bits. Fails when an order is not
// that of a stable standard sort.
#include "benchmarks/bench/particles/bench_stage.h"
#include "benchmarks/bench/particles/particle_rows.h"
#include "benchmarks/measure/clocks.h"
#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "fxsdk/cli/support/interrupt.h"
#include "rendering/draw_order/depth_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory_resource>
#include <numeric>
#include <span>
#include <utility>

namespace fx::cli {
namespace {

constexpr std::array<std::string_view, 7> kVariants{
    "random", "same", "hundredth-moved", "all-nearer", "nearer-and-moved", "radix", "standard"};

float unit(uint64_t stream, size_t i)
{
    return base::randomUnit4(stream, 0, i, base::RandomPurpose::Position)[0];
}

/// Distances of a cloud of particles, 3 m to 40 m away.
float distanceOf(uint64_t stream, size_t i)
{
    return 3.0f + 37.0f * unit(stream, i);
}

std::vector<uint32_t> expected(const std::vector<float>& distances)
{
    std::vector<uint32_t> order(distances.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return distances[a] > distances[b]; });
    return order;
}

/// What happens before sort number k.
void change(std::string_view variant, std::vector<float>& distances, uint32_t k)
{
    if (variant == "hundredth-moved" || variant == "nearer-and-moved")
        for (size_t i = k % 100; i < distances.size(); i += 100)
            distances[i] = distanceOf(k + 2, i);
    if (variant == "all-nearer" || variant == "nearer-and-moved")
        for (float& distance : distances)
            distance -= 0.002f;
}

/// @param outOrder receives the indices
double timeStandard(const std::vector<float>& distances, std::vector<uint32_t>& outOrder)
{
    std::vector<std::pair<float, uint32_t>> pairs(distances.size());
    const double begin = threadSeconds();
    for (size_t i = 0; i < pairs.size(); ++i)
        pairs[i] = {-distances[i], uint32_t(i)};
    std::sort(pairs.begin(), pairs.end());
    const double seconds = threadSeconds() - begin;
    outOrder.clear();
    for (const auto& [distance, index] : pairs)
        outOrder.push_back(index);
    return seconds;
}

/// A stable sort of pairs by the 32 bits of their keys, lowest digit first, as textbooks have it: all digits
/// are counted in one sweep, and each pass moves all pairs. Memory is kept from sort to sort.
class PlainRadixSort
{
public:
    /// @param outOrder receives the indices, farthest first
    /// @return [s] of the thread
    double sort(const std::vector<float>& distances, std::vector<uint32_t>& outOrder)
    {
        pairs_.resize(distances.size());
        other_.resize(distances.size());
        outOrder.resize(distances.size());
        const double begin = threadSeconds();
        std::array<std::array<uint32_t, kPlaces>, kPasses> starts{};
        for (size_t i = 0; i < distances.size(); ++i) {
            const uint32_t key = keyOf(distances[i]);
            pairs_[i] = {key, uint32_t(i)};
            for (size_t pass = 0; pass < kPasses; ++pass)
                ++starts[pass][digitOf(key, pass)];
        }
        for (size_t pass = 0; pass < kPasses; ++pass) {
            std::exclusive_scan(starts[pass].begin(), starts[pass].end(), starts[pass].begin(), 0u);
            for (const Pair& pair : pairs_)
                other_[starts[pass][digitOf(pair.key, pass)]++] = pair;
            pairs_.swap(other_);
        }
        for (size_t i = 0; i < pairs_.size(); ++i)
            outOrder[i] = pairs_[i].index;
        return threadSeconds() - begin;
    }

private:
    static constexpr uint32_t kBits = 11;
    static constexpr size_t kPlaces = size_t(1) << kBits;
    static constexpr size_t kPasses = 3; ///< 33 bits
    struct Pair
    {
        uint32_t key, index;
    };
    /// Falls as the distance rises, below 0 too.
    static uint32_t keyOf(float distance)
    {
        const uint32_t bits = std::bit_cast<uint32_t>(distance);
        return ~((bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u);
    }
    static uint32_t digitOf(uint32_t key, size_t pass) { return key >> (kBits * pass) & (kPlaces - 1); }

    std::vector<Pair> pairs_, other_;
};

/// Which numbers a row is made of.
struct Sorting
{
    std::vector<double> seconds;
    uint64_t hash = 0;
    bool isRight = true;
};

Sorting sortAgain(std::string_view variant, uint64_t count, uint32_t steps)
{
    render::DepthSort sort(std::pmr::get_default_resource());
    std::vector<float> distances(count);
    for (size_t i = 0; i < distances.size(); ++i)
        distances[i] = distanceOf(1, i);
    static_cast<void>(sort.farthestFirst(distances));
    std::vector<uint32_t> other; ///< order of another sort
    PlainRadixSort radix;
    const bool isOther = variant == "standard" || variant == "radix";
    Sorting result;
    for (uint32_t k = 0; k < steps && !interruptRequested(); ++k) {
        change(variant, distances, k);
        if (isOther) {
            result.seconds.push_back(variant == "radix" ? radix.sort(distances, other)
                                                        : timeStandard(distances, other));
            result.hash = base::hashBytes(result.hash, other.data(), other.size() * sizeof(uint32_t));
            continue;
        }
        if (variant == "random")
            sort.forget();
        const double begin = threadSeconds();
        const auto order = sort.farthestFirst(distances);
        result.seconds.push_back(threadSeconds() - begin);
        result.hash = base::hashBytes(result.hash, order.data(), order.size_bytes());
    }
    const auto order = isOther ? std::span<const uint32_t>(other) : sort.farthestFirst(distances);
    const auto wanted = expected(distances);
    result.isRight =
        interruptRequested() || std::equal(order.begin(), order.end(), wanted.begin(), wanted.end());
    return result;
}

base::Result<BenchRow> measure(const BenchSettings& settings, std::string_view variant)
{
    const Sorting sorting = sortAgain(variant, settings.count, settings.steps > 0 ? settings.steps : 15);
    if (interruptRequested())
        return interruptedStatus();
    if (!sorting.isRight)
        return base::Status{base::Code::Internal,
                            "sort: the order of '" + std::string(variant) + "' is wrong"};
    const double perElement = 1e9 / double(settings.count); // [ns]
    BenchRow row;
    row.medianNanoseconds = perElement * quantile(sorting.seconds, 0.5);
    row.p95Nanoseconds = perElement * quantile(sorting.seconds, 0.95);
    row.hash = sorting.hash;
    row.bytesPerParticle = sizeof(float) + sizeof(uint32_t); // a distance is read, an index written
    row.bandwidthFraction =
        row.bytesPerParticle / row.medianNanoseconds /
        copyGigabytes(*base::makeSerialRunner(), row.bytesPerParticle * double(settings.count));
    row.more = {{"ns_per_particle_min", perElement * quantile(sorting.seconds, 0.0)}};
    return row;
}

constexpr BenchEntry kEntry{"sort",     "The order of drawing, on one thread",
                            kVariants,  false,
                            false,      false,
                            400'000,    100'000'000,
                            "elements", measure};

} // namespace

BenchMeasurement sortBench()
{
    return measurementOf(kEntry);
}

} // namespace fx::cli
