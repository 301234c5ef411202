#include "simulation/sph/neighbor_grid.h"

#include "foundation/random/philox.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

using namespace fx;
using sim::NeighborGrid;

namespace {

struct Cloud
{
    std::vector<float> x, y, z;

    void add(float px, float py, float pz)
    {
        x.push_back(px);
        y.push_back(py);
        z.push_back(pz);
    }
    sim::PositionSpans spans() const { return {x, y, z}; }
    double distance2(size_t i, size_t j) const
    {
        const double dx = double(x[i]) - double(x[j]);
        const double dy = double(y[i]) - double(y[j]);
        const double dz = double(z[i]) - double(z[j]);
        return dx * dx + dy * dy + dz * dz;
    }
};

Cloud randomCloud(uint32_t count, float extent)
{
    Cloud cloud;
    for (uint32_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(8, 0, i, base::RandomPurpose::Position);
        cloud.add(extent * (u[0] - 0.5f), extent * (u[1] - 0.5f), extent * (u[2] - 0.5f));
    }
    return cloud;
}

/// Compares with the search over all pairs, and sees that no particle comes twice.
void expectAllNeighbors(const Cloud& cloud, float reach)
{
    NeighborGrid grid(std::pmr::get_default_resource(), uint32_t(cloud.x.size()));
    grid.build(cloud.spans(), reach);
    ASSERT_EQ(grid.order().size(), cloud.x.size());
    for (size_t i = 0; i < cloud.x.size(); ++i) {
        std::multiset<uint32_t> found;
        int runs = 0;
        grid.forEachRun({cloud.x[i], cloud.y[i], cloud.z[i]}, [&](uint32_t begin, uint32_t end) {
            ++runs;
            for (uint32_t place = begin; place < end; ++place)
                found.insert(grid.order()[place]);
        });
        ASSERT_LE(runs, 9);
        for (uint32_t j = 0; j < cloud.x.size(); ++j) {
            ASSERT_LE(found.count(j), 1u);
            if (cloud.distance2(i, j) <= double(reach) * double(reach)) {
                ASSERT_EQ(found.count(j), 1u) << i << " " << j;
            }
        }
    }
}

} // namespace

TEST(NeighborGrid, findsWhatTheSearchOverAllPairsFinds)
{
    for (const float reach : {0.05f, 0.3f, 1.0f, 5.0f})
        expectAllNeighbors(randomCloud(300, 3.0f), reach);
}

TEST(NeighborGrid, findsParticlesExactlyOnCellBorders)
{
    Cloud cloud;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            for (int k = 0; k < 6; ++k)
                cloud.add(float(i) * 0.25f, float(j) * 0.25f, float(k) * 0.25f);
    expectAllNeighbors(cloud, 0.25f);
}

TEST(NeighborGrid, survivesEverythingInOnePlaceAndThingsFarAway)
{
    Cloud cloud;
    for (int i = 0; i < 50; ++i)
        cloud.add(1.0f, 1.0f, 1.0f);
    expectAllNeighbors(cloud, 0.1f);
    cloud.add(1e6f, 0.0f, 0.0f);
    cloud.add(-1e6f, 1e6f, -1e6f);
    expectAllNeighbors(cloud, 0.1f);
}

TEST(NeighborGrid, withinACellTheOrderIsThatOfTheNumbers)
{
    Cloud cloud;
    for (int i = 0; i < 20; ++i)
        cloud.add(0.0f, 0.0f, 0.0f);
    NeighborGrid grid(std::pmr::get_default_resource(), 20);
    grid.build(cloud.spans(), 1.0f);
    for (uint32_t i = 0; i < 20; ++i)
        EXPECT_EQ(grid.order()[i], i);
}

TEST(NeighborGrid, nothingIsAllowed)
{
    NeighborGrid grid(std::pmr::get_default_resource(), 4);
    grid.build({}, 1.0f);
    EXPECT_TRUE(grid.order().empty());
}
