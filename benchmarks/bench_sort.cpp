// bench_sort [--count=N] [--repeat=N]
//
// The order of drawing, one thread: elements in random order; the same again; with one in a hundred moved
// anywhere; with one in a hundred replaced by newcomers; after the camera has gone a little on; and the
// standard sort beside them. One JSON object a case: nanoseconds of processor time per element, least and
// median of N, in caches that hold what the sort before left in them; a hash of all orders. Fails when an
// order is not that of the standard sort.
#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "rendering/view/depth_sort.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <time.h>
#include <vector>

namespace {

using namespace fx;

double seconds()
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

float unit(uint64_t stream, size_t i)
{
    return base::randomUnit4(stream, 0, i, base::RandomPurpose::Position)[0];
}

std::vector<uint32_t> expected(const std::vector<float>& distances)
{
    std::vector<uint32_t> order(distances.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return distances[a] > distances[b]; });
    return order;
}

/// Distances of a cloud of particles, 3 m to 40 m away.
std::vector<float> cloud(size_t count)
{
    std::vector<float> distances(count);
    for (size_t i = 0; i < count; ++i)
        distances[i] = 3.0f + 37.0f * unit(1, i);
    return distances;
}

struct Case
{
    const char* variant;
    bool forget;
    std::function<void(std::vector<float>&, int)> change; ///< what happens before a sort
};

void run(const Case& what, size_t count, int repeat)
{
    render::DepthSort sort(std::pmr::get_default_resource());
    std::vector<float> distances = cloud(count);
    (void)sort.farthestFirst(distances);
    std::vector<double> times;
    uint64_t hash = 0;
    for (int k = 0; k < repeat; ++k) {
        what.change(distances, k);
        if (what.forget)
            sort.forget();
        const double begin = seconds();
        const auto order = sort.farthestFirst(distances);
        times.push_back(seconds() - begin);
        hash = base::hashBytes(hash, order.data(), order.size_bytes());
    }
    const auto order = sort.farthestFirst(distances);
    const auto wanted = expected(distances);
    const bool good = std::equal(order.begin(), order.end(), wanted.begin(), wanted.end());
    std::sort(times.begin(), times.end());
    const double scale = 1e9 / double(count);
    std::printf("{\"name\":\"sort\",\"variant\":\"%s\",\"count\":%zu,\"ns_per_particle_least\":%.3f,"
                "\"ns_per_particle_median\":%.3f,\"sorted\":%zu,\"hash\":\"0x%016llx\",\"correct\":%s}\n",
                what.variant, count, times.front() * scale, times[times.size() / 2] * scale,
                sort.sortedElements(), static_cast<unsigned long long>(hash), good ? "true" : "false");
    if (!good) {
        std::fprintf(stderr, "bench_sort: %s: the order is wrong\n", what.variant);
        std::exit(1);
    }
}

void runStandard(size_t count, int repeat)
{
    std::vector<double> times;
    for (int k = 0; k < repeat; ++k) {
        const std::vector<float> distances = cloud(count);
        std::vector<std::pair<float, uint32_t>> pairs(count);
        const double begin = seconds();
        for (size_t i = 0; i < count; ++i)
            pairs[i] = {-distances[i], uint32_t(i)};
        std::sort(pairs.begin(), pairs.end());
        times.push_back(seconds() - begin);
    }
    std::sort(times.begin(), times.end());
    std::printf("{\"name\":\"sort\",\"variant\":\"standard\",\"count\":%zu,\"ns_per_particle_least\":%.3f,"
                "\"ns_per_particle_median\":%.3f}\n",
                count, times.front() * 1e9 / double(count), times[times.size() / 2] * 1e9 / double(count));
}

} // namespace

int main(int argc, char** argv)
{
    size_t count = 400'000;
    int repeat = 15;
    for (int i = 1; i < argc; ++i) {
        if (std::strncmp(argv[i], "--count=", 8) == 0) {
            count = size_t(std::max(std::atoll(argv[i] + 8), 1LL));
        } else if (std::strncmp(argv[i], "--repeat=", 9) == 0) {
            repeat = std::max(std::atoi(argv[i] + 9), 1);
        } else {
            std::fprintf(stderr, "usage: bench_sort [--count=N] [--repeat=N]\n");
            return 2;
        }
    }
    const auto nothing = [](std::vector<float>&, int) {};
    const auto hundredth = [](std::vector<float>& d, int k) {
        for (size_t i = size_t(k) % 100; i < d.size(); i += 100)
            d[i] = 3.0f + 37.0f * unit(uint64_t(k) + 2, i);
    };
    const auto nudge = [](std::vector<float>& d, int) { // all by the same, most rounded alike
        for (float& x : d)
            x -= 0.002f;
    };
    run({"random", true, nothing}, count, repeat);
    run({"same", false, nothing}, count, repeat);
    run({"hundredth_moved", false, hundredth}, count, repeat);
    run({"all_nearer", false, nudge}, count, repeat);
    runStandard(count, std::min(repeat, 5));
    return 0;
}
