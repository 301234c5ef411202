// fx bench neighbor-search: the search for neighbors alone: sort (keys, order, cells), reorder (the caller's
// four columns), refit (boxes), lists. One JSON object a case: nanoseconds per particle of each part, the
// least of N runs, whose caches hold what 262144 particles leave in them; the mean length of a list; a hash
// of all lists. Search = sort + refit + lists, what a library must do for unsorted particles. Fails when a
// sample of lists is not what a trial of all pairs finds. --small: 8^3 and 16^3 particles once.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/measure/clocks.h"
#include "foundation/math/hash.h"
#include "foundation/random/philox.h"
#include "foundation/simd/instruction_set.h"
#include "fxsdk/cli/support/json_line.h"
#include "simulation/sph/neighbors/neighbor_lists.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    int repeat = 15;
    uint32_t edge = 64;   ///< particles along an edge of the large clouds; of the small one half of it
    uint32_t threads = 0; ///< 0: one and two
    double neighbors = 58;
    double margin = 0;
    bool isSmall = false;
};

template <class T>
struct Cloud
{
    std::vector<T> x, y, z, support;

    uint32_t count() const { return uint32_t(x.size()); }
    sim::PointColumns<T> columns() const { return {x.data(), y.data(), z.data(), support.data(), count()}; }
    void add(double px, double py, double pz, double h)
    {
        x.push_back(T(px));
        y.push_back(T(py));
        z.push_back(T(pz));
        support.push_back(T(h));
    }
    void take(const Cloud& from, std::span<const uint32_t> order)
    {
        for (auto column : {&Cloud::x, &Cloud::y, &Cloud::z, &Cloud::support}) {
            (this->*column).resize(order.size());
            for (size_t k = 0; k < order.size(); ++k)
                (this->*column)[k] = (from.*column)[order[k]];
        }
    }
};

/// Support that holds `neighbors` particles a distance 1 apart: 4/3 pi H^3 = N.
double supportOf(double neighbors)
{
    return std::cbrt(3.0 * neighbors / (4.0 * std::numbers::pi));
}

/// A lattice, a tenth of its spacing disturbed; x fastest.
template <class T>
Cloud<T> lattice(uint32_t edge, double neighbors)
{
    Cloud<T> cloud;
    for (uint32_t i = 0; i < edge * edge * edge; ++i) {
        const auto u = base::randomUnit4(1, 0, i, base::RandomPurpose::Position);
        cloud.add(i % edge + 0.1 * (double(u[0]) - 0.5), i / edge % edge + 0.1 * (double(u[1]) - 0.5),
                  i / edge / edge + 0.1 * (double(u[2]) - 0.5), supportOf(neighbors));
    }
    return cloud;
}

template <class T>
Cloud<T> shuffled(const Cloud<T>& cloud)
{
    std::vector<uint32_t> order(cloud.count());
    std::iota(order.begin(), order.end(), 0u);
    for (uint32_t i = cloud.count(); i-- > 1;)
        std::swap(order[i], order[base::philox({i, 0, 0, 0}, 5)[0] % (i + 1)]);
    Cloud<T> out;
    out.take(cloud, order);
    return out;
}

/// Half of the particles in a ball a hundred times denser in each direction: supports differ by 100,
/// densities by 1e6.
template <class T>
Cloud<T> contrast(uint32_t edge, double neighbors)
{
    const Cloud<T> even = lattice<T>(edge, neighbors);
    Cloud<T> cloud;
    const double middle = 0.5 * edge;
    for (uint32_t i = 0; i < even.count(); ++i) {
        const double scale = i % 2 == 0 ? 1.0 : 0.01;
        cloud.add(middle + scale * (double(even.x[i]) - middle),
                  middle + scale * (double(even.y[i]) - middle),
                  middle + scale * (double(even.z[i]) - middle), 1.26 * scale * supportOf(neighbors));
    }
    return cloud;
}

/// Read once, before anything is dispatched.
const Machine& machine()
{
    static const Machine read = readMachine();
    return read;
}

struct Times
{
    double sort = 1e30, reorder = 1e30, refit = 1e30, lists = 1e30;
};

/// Seconds since the last lap: of the processor with one thread, so that other programs do not count, of the
/// wall with more.
class StopWatch
{
public:
    explicit StopWatch(uint32_t threads) : now_(threads == 1 ? processSeconds : wallSeconds) { lap(); }
    double lap()
    {
        const double seconds = now_();
        return seconds - std::exchange(last_, seconds);
    }

private:
    double (*now_)();
    double last_ = 0;
};

template <class T>
std::vector<uint32_t> listOf(const sim::NeighborLists<T>& lists, uint32_t place)
{
    std::vector<uint32_t> list;
    lists.forEachPiece(place, [&](const uint32_t* entries, uint32_t count, bool) {
        list.insert(list.end(), entries, entries + count);
    });
    return list;
}

template <class T>
void checkSample(const Cloud<T>& cloud, const sim::NeighborLists<T>& lists, double margin)
{
    for (uint32_t i = 0; i < cloud.count(); i += cloud.count() / 50) {
        std::vector<uint32_t> trial;
        for (uint32_t j = 0; j < cloud.count(); ++j) {
            const T dx = cloud.x[i] - cloud.x[j];
            const T dy = cloud.y[i] - cloud.y[j];
            const T dz = cloud.z[i] - cloud.z[j];
            const T reach = (T(1) + T(margin)) * std::max(cloud.support[i], cloud.support[j]);
            if (i != j && dx * dx + dy * dy + dz * dz < reach * reach)
                trial.push_back(j);
        }
        if (listOf(lists, i) != trial)
            fail("the list of place " + std::to_string(i) + " is not that of a trial of all");
    }
}

template <class T>
std::string hashOf(const sim::NeighborLists<T>& lists, uint32_t count)
{
    uint64_t hash = 0;
    for (uint32_t place = 0; place < count; ++place) {
        const auto list = listOf(lists, place);
        hash = base::hashBytes(hash, list.data(), list.size() * sizeof list[0]);
    }
    return hashText(hash);
}

template <class T>
void measure(const std::string& variant, const Cloud<T>& cloud, uint32_t threads, const Options& options)
{
    const uint32_t count = cloud.count();
    auto* const memory = std::pmr::get_default_resource();
    const auto tasks = threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(threads);
    sim::ParticleTree<T> tree(memory, count);
    sim::NeighborLists<T> lists(memory, count, uint32_t(2 * options.neighbors) + 64);
    std::vector<uint32_t> owners(count);
    std::iota(owners.begin(), owners.end(), 0u);
    Cloud<T> sorted = cloud;
    Times best;
    for (int run = 0; run < options.repeat; ++run) {
        StopWatch watch(threads);
        tree.sort(cloud.columns(), {}, *tasks);
        best.sort = std::min(best.sort, watch.lap());
        sorted.take(cloud, tree.order());
        best.reorder = std::min(best.reorder, watch.lap());
        tree.refit(sorted.columns(), *tasks);
        best.refit = std::min(best.refit, watch.lap());
        lists.build(tree, {}, owners, T(options.margin), *tasks);
        best.lists = std::min(best.lists, watch.lap());
    }
    checkSample(sorted, lists, options.margin);
    const double ns = 1e9 / count;
    printJsonLine(withMachine({{"name", "neighbor_search"},
                               {"variant", variant},
                               {"precision", sizeof(T) == 4 ? "float" : "double"},
                               {"simd", std::string(base::instructionSetName(base::instructionSet()))},
                               {"count", count},
                               {"threads", threads},
                               {"clock", threads == 1 ? "processor" : "wall"},
                               {"repeat", options.repeat},
                               {"margin", options.margin},
                               {"ns_sort", best.sort * ns},
                               {"ns_reorder", best.reorder * ns},
                               {"ns_refit", best.refit * ns},
                               {"ns_lists", best.lists * ns},
                               {"ns_search", (best.sort + best.refit + best.lists) * ns},
                               {"neighbors", double(lists.entries()) / count},
                               {"unlisted", lists.unlisted()},
                               {"hash", hashOf(lists, count)}},
                              machine()));
}

template <class T>
void measureAll(uint32_t threads, const Options& options)
{
    const std::string large = std::to_string(options.edge);
    const uint32_t half = options.edge / 2;
    measure("lattice." + std::to_string(half), lattice<T>(half, options.neighbors), threads, options);
    const Cloud<T> even = lattice<T>(options.edge, options.neighbors);
    measure("lattice." + large, even, threads, options);
    measure("shuffled." + large, shuffled(even), threads, options);
    measure("contrast1e6." + large, contrast<T>(options.edge, options.neighbors), threads, options);
}

void measure(Options options)
{
    if (options.isSmall)
        options.edge = 16, options.repeat = 1;
    machine();
    for (const uint32_t threads : {1u, 2u}) {
        if (options.threads != 0 && options.threads != threads)
            continue;
        measureAll<float>(threads, options);
        measureAll<double>(threads, options);
    }
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--repeat", options->repeat, "Runs of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--threads", options->threads, "1 or 2; 0, the default, for both")
        ->check(CLI::Range(0u, 2u));
    command.add_option("--neighbors", options->neighbors, "4/3 pi n H^3, the neighbors within the support")
        ->check(CLI::Range(1.0, 1000.0));
    command.add_option("--margin", options->margin, "[1] Lists reach so much farther than supports")
        ->check(CLI::Range(0.0, 10.0));
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement neighborSearchBench()
{
    return {"neighbor-search",
            "The search for neighbors alone: nanoseconds a particle of sorting, boxes and lists", addOptions};
}

} // namespace fx::cli
