#include "simulation/sph/neighbors/morton.h"
#include "simulation/sph/neighbors/morton_sort.h"
#include "tests/simulation/neighbors/neighbor_stage.h"

using namespace fx;
using namespace fx::test;

namespace {

std::vector<uint32_t> sortedOrder(const Cloud<float>& cloud, uint32_t threads)
{
    sim::MortonSort<float> sort(std::pmr::get_default_resource(), cloud.count());
    const auto tasks = runner(threads);
    sort.sort({cloud.x.data(), cloud.y.data(), cloud.z.data()}, cloud.count(), {}, *tasks);
    EXPECT_TRUE(std::is_sorted(sort.keys().begin(), sort.keys().end()));
    return {sort.order().begin(), sort.order().end()};
}

/// Keys written again: coordinates cut into 2^21 cells of the smallest cube.
std::vector<uint32_t> expectedOrder(const Cloud<float>& cloud)
{
    const std::vector<float>* const axes[3] = {&cloud.x, &cloud.y, &cloud.z};
    double low[3];
    double extent = 0;
    for (int a = 0; a < 3; ++a) {
        const auto [least, most] = std::minmax_element(axes[a]->begin(), axes[a]->end());
        low[a] = double(*least);
        extent = std::max(extent, double(*most) - low[a]);
    }
    std::vector<uint64_t> keys(cloud.count(), 0);
    for (uint32_t i = 0; i < cloud.count() && extent > 0; ++i)
        for (int a = 0; a < 3; ++a) {
            const double cell = (double((*axes[a])[i]) - low[a]) * (2097152.0 / extent);
            const uint64_t bits = uint64_t(std::min(cell, 2097151.0));
            for (int b = 0; b < 21; ++b)
                keys[i] |= (bits >> b & 1) << (3 * b + a);
        }
    std::vector<uint32_t> order = everyone(cloud.count());
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return keys[a] < keys[b]; });
    return order;
}

} // namespace

TEST(MortonSort, bitsOfThreeAxesTakeTurns)
{
    EXPECT_EQ(sim::mortonKey(1, 0, 0), 1u);
    EXPECT_EQ(sim::mortonKey(0, 1, 0), 2u);
    EXPECT_EQ(sim::mortonKey(0, 0, 1), 4u);
    EXPECT_EQ(sim::mortonKey(0x1FFFFF, 0x1FFFFF, 0x1FFFFF), (uint64_t(1) << 63) - 1);
    EXPECT_EQ(sim::mortonKey(0x100000, 0, 0), uint64_t(1) << 60);
    EXPECT_EQ(sim::differingBits(5, 5), 0u);
    EXPECT_EQ(sim::differingBits(8, 7), 4u);
}

TEST(MortonSort, sortsByKeyAndThenByIndexForAnyNumberOfWorkers)
{
    Cloud<float> even;
    even.addRandom(70'000, 1, -3, 8, 1, 1);
    Cloud<float> lattice; // particles on borders of cells, and each twice
    lattice.addLattice(24, -1, 0.125, 1);
    lattice.addLattice(24, -1, 0.125, 1);
    Cloud<float> cluster; // in a wide cloud, smaller than a cell of the first digits
    cluster.addRandom(500, 2, -1e6, 2e6, 1, 1);
    cluster.addRandom(40'000, 3, 17.0, 10'000.0, 1, 1);
    for (const Cloud<float>& cloud : {even, lattice, cluster}) {
        const auto expected = expectedOrder(cloud);
        for (const uint32_t threads : {1u, 2u, 3u, 7u, kBackwards})
            EXPECT_EQ(sortedOrder(cloud, threads), expected) << threads << " threads";
    }
}

TEST(MortonSort, aCrowdedCellGetsACurveOfItsOwn)
{
    Cloud<float> cloud; // cells are 1 m wide
    cloud.addRandom(500, 2, -1e6, 2e6, 1, 1);
    cloud.addRandom(50'000, 4, 0.25, 1e-3, 1, 1);
    cloud.addRandom(50'000, 5, 0.25, 1e-8, 1, 1); // coincide, or are 3e-8 apart
    const auto order = sortedOrder(cloud, 1);
    double way = 0;
    for (size_t k = 1; k < order.size(); ++k) {
        const uint32_t a = order[k - 1];
        const uint32_t b = order[k];
        if (std::abs(cloud.x[a] - 0.25f) < 0.1f && std::abs(cloud.x[b] - 0.25f) < 0.1f)
            way += std::abs(double(cloud.x[a] - cloud.x[b]));
    }
    EXPECT_LT(way / 50'000, 0.1 * 1e-3) << "neighbors in order are not near each other";
    for (const uint32_t threads : {2u, 3u, 7u, kBackwards})
        EXPECT_EQ(sortedOrder(cloud, threads), order);
}

TEST(MortonSort, coincidentParticlesKeepTheirOrder)
{
    Cloud<float> cloud;
    for (int i = 0; i < 5000; ++i)
        cloud.add(3, -4, 5, 1);
    EXPECT_EQ(sortedOrder(cloud, 1), everyone(5000));
}

TEST(MortonSort, nobodyAndOneAloneAreSorted)
{
    EXPECT_TRUE(sortedOrder({}, 1).empty());
    Cloud<float> alone;
    alone.add(-1e30, 1e30, 0, 1);
    EXPECT_EQ(sortedOrder(alone, 1), everyone(1));
}
