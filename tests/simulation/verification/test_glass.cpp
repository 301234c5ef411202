#include "simulation/verification/glass.h"

#include "simulation/sph/dynamics/gas_dynamics.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory_resource>

namespace fx::sim {
namespace {

const glm::u32vec3 kCount{8, 8, 8};

double distance(const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 d = a - b;
    return glm::length(d - glm::dvec3(kCount) * glm::round(d / glm::dvec3(kCount)));
}

TEST(Glass, particlesKeepTheirDistanceWithoutBeingALattice)
{
    const std::vector<glm::dvec3> box = glassBox(kCount, 58);
    ASSERT_EQ(box.size(), 512u);
    double least = 1e9;
    double offLattice = 0;
    for (size_t i = 0; i < box.size(); ++i) {
        EXPECT_TRUE(box[i].x >= 0 && box[i].x <= 8 && box[i].y >= 0 && box[i].y <= 8 && box[i].z >= 0 &&
                    box[i].z <= 8);
        const double plane = box[i].x - 0.5;
        offLattice += std::abs(plane - std::round(plane)) / double(box.size());
        for (size_t j = i + 1; j < box.size(); ++j)
            least = std::min(least, distance(box[i], box[j]));
    }
    EXPECT_GT(least, 0.6);
    EXPECT_GT(offLattice, 0.1); // 0.25 for evenly spread places
}

TEST(Glass, theDensityIsEven)
{
    GasDynamicsDef def;
    def.capacity = 512;
    def.domain.axes.fill(AxisKind::Periodic);
    def.domain.low = glm::dvec3(0);
    def.domain.high = glm::dvec3(kCount);
    GasDynamics<double> gas(def, std::pmr::get_default_resource());
    std::vector<GasParticle> particles;
    for (const glm::dvec3& place : glassBox(kCount, 58))
        particles.push_back({place, glm::dvec3(0), 1, 1});
    ASSERT_TRUE(gas.add(particles).ok());
    const auto tasks = base::makeSerialRunner();
    gas.initialize(*tasks);
    double spread = 0;
    for (uint32_t id = 0; id < gas.count(); ++id)
        spread += std::pow(gas.densityOf(id) - 1, 2) / gas.count();
    EXPECT_LT(std::sqrt(spread), 0.02);
}

TEST(Glass, isTheSameEveryTime)
{
    EXPECT_EQ(glassBox({6, 6, 6}, 58), glassBox({6, 6, 6}, 58));
}

} // namespace
} // namespace fx::sim
