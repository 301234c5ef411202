// fx bench sort: the order of drawing on one thread. random: elements in random order; same: once more as
// they are; hundredth-moved: one in a hundred moved anywhere; all-nearer: the camera has gone a little on;
// nearer-and-moved: both; standard: std::sort of distance and index beside them. Fails when an order is not
// that of a stable standard sort.
#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "fxsdk/cli/bench_rows.h"
#include "fxsdk/cli/bench_stage.h"
#include "fxsdk/cli/interrupt.h"
#include "rendering/view/depth_sort.h"

#include <algorithm>
#include <ctime>
#include <memory_resource>
#include <numeric>
#include <span>
#include <utility>

namespace fx::cli {
namespace {

double threadSeconds()
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

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
    std::vector<uint32_t> standard;
    Sorting result;
    for (uint32_t k = 0; k < steps && !interruptRequested(); ++k) {
        change(variant, distances, k);
        if (variant == "standard") {
            result.seconds.push_back(timeStandard(distances, standard));
            result.hash = base::hashBytes(result.hash, standard.data(), standard.size() * sizeof(uint32_t));
            continue;
        }
        if (variant == "random")
            sort.forget();
        const double begin = threadSeconds();
        const auto order = sort.farthestFirst(distances);
        result.seconds.push_back(threadSeconds() - begin);
        result.hash = base::hashBytes(result.hash, order.data(), order.size_bytes());
    }
    const auto order =
        variant == "standard" ? std::span<const uint32_t>(standard) : sort.farthestFirst(distances);
    const auto wanted = expected(distances);
    result.isRight =
        interruptRequested() || std::equal(order.begin(), order.end(), wanted.begin(), wanted.end());
    return result;
}

} // namespace

base::Result<BenchRow> benchSort(const BenchSettings& settings, std::string_view variant)
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

} // namespace fx::cli
