// When generations of coordinates are born, and how strain is found from vorticity.
#include "foundation/random/philox.h"
#include "simulation/detail/material_coordinates.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

using namespace fx;

TEST(GenerationClock, aGenerationIsBornEachTimeShearHasGrownByAHalf)
{
    sim::GenerationClock clock;
    EXPECT_EQ(clock.younger(), 1u);
    EXPECT_EQ(clock.fade(), 0.0);
    uint64_t born = 0;
    for (int i = 0; i < 1000; ++i)
        born += clock.advance(0.01, 1.0);
    EXPECT_EQ(born, 20u); // 10 / 0.5, up to rounding of the last
    EXPECT_EQ(clock.younger(), 21u);
    EXPECT_NEAR(clock.fade(), 0.0, 1e-9);
}

TEST(GenerationClock, itsWeightRisesEvenlyFromZero)
{
    sim::GenerationClock clock;
    clock.advance(0.125, 1.0);
    EXPECT_DOUBLE_EQ(clock.fade(), 0.25);
    clock.advance(0.25, 1.0);
    EXPECT_DOUBLE_EQ(clock.fade(), 0.75);
    EXPECT_EQ(clock.advance(0.25, 1.0), 1u);
    EXPECT_DOUBLE_EQ(clock.fade(), 0.25);
}

TEST(GenerationClock, howeverStrongTheShearItLivesAQuarterOfASecond)
{
    sim::GenerationClock clock;
    uint64_t born = 0;
    for (int i = 0; i < 60; ++i)
        born += clock.advance(1e9, 1.0 / 60.0);
    EXPECT_LE(born, uint64_t(sim::kMaxGenerationRate));
    EXPECT_GE(born, uint64_t(sim::kMaxGenerationRate) - 1);
}

// (1) of material-coordinates: in homogeneous flow without divergence the mean squares are tied.
TEST(GenerationClock, strainFollowsFromVorticityInTurbulence)
{
    double strain = 0, vorticity = 0;
    for (uint64_t mode = 0; mode < 20000; ++mode) {
        const auto r = base::randomUnit4(3, 0, mode, base::RandomPurpose::Attributes);
        const auto q = base::randomUnit4(4, 0, mode, base::RandomPurpose::Attributes);
        const glm::dvec3 k(r[0] - 0.5f, r[1] - 0.5f, r[2] - 0.5f); // wave vector
        const glm::dvec3 amplitude = glm::cross(k, glm::dvec3(q[0] - 0.5f, q[1] - 0.5f, q[2] - 0.5f));
        const double slope = std::cos(6.283185307 * double(r[3])); // of sin(k x + phase)
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                const double s = 0.5 * slope * (amplitude[a] * k[b] + amplitude[b] * k[a]);
                strain += s * s;
            }
        const glm::dvec3 w = slope * glm::cross(k, amplitude);
        vorticity += glm::dot(w, w);
    }
    EXPECT_NEAR(strain, 0.5 * vorticity, 1e-9 * vorticity);
}
