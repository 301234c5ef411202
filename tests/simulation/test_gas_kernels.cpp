#include "foundation/random/philox.h"
#include "simulation/sph/gas_density.h"
#include "simulation/sph/gas_forces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::sim;
namespace sorted = gas_sorted;

namespace {

/// Particles that are their own sorted order, for calling the kernels alone.
struct Sample
{
    explicit Sample(uint32_t count)
        : gas(std::pmr::get_default_resource(), count), grid(std::pmr::get_default_resource(), count)
    {
        gas.count = count;
        for (size_t c = 0; c < sorted::Count; ++c)
            std::fill_n(gas.sortedAt(c), count, 0.0f);
        std::fill_n(gas.sortedAt(sorted::Sound), count, 30.0f);
        std::fill_n(gas.sortedAt(sorted::Equilibrium), count, 0.2f);
    }

    void place(uint32_t i, float x, float y, float z, float h)
    {
        gas.sortedAt(sorted::X)[i] = x;
        gas.sortedAt(sorted::Y)[i] = y;
        gas.sortedAt(sorted::Z)[i] = z;
        gas.sortedAt(sorted::Smoothing)[i] = h;
        gas.kernels[i] = Wendland(h);
    }

    /// Sorts the columns by the grid, then sums. Particles lose their numbers, which no test here needs.
    void sum(float viscosity)
    {
        const auto axis = [&](size_t c) { return std::span<const float>(gas.sortedAt(c), gas.count); };
        const float* h = gas.sortedAt(sorted::Smoothing);
        grid.build({axis(sorted::X), axis(sorted::Y), axis(sorted::Z)},
                   2.0f * *std::max_element(h, h + gas.count));
        for (size_t c = 0; c < sorted::Count; ++c) {
            const std::vector<float> old(gas.sortedAt(c), gas.sortedAt(c) + gas.count);
            for (uint32_t i = 0; i < gas.count; ++i)
                gas.sortedAt(c)[i] = old[grid.order()[i]];
        }
        for (uint32_t i = 0; i < gas.count; ++i)
            gas.kernels[i] = Wendland(gas.sortedAt(sorted::Smoothing)[i]);
        sumDensity(grid, gas, 0, gas.count);
        for (uint32_t i = 0; i < gas.count; ++i)
            gas.sortedAt(sorted::Push)[i] =
                pressurePush(gas.sortedAt(sorted::Density)[i], gas.sortedAt(sorted::Equilibrium)[i],
                             gas.sortedAt(sorted::Sound)[i]);
        sumForces(grid, gas, viscosity, 0, gas.count);
    }

    float at(size_t column, uint32_t i) const { return gas.sortedAt(column)[i]; }

    GasStore gas;
    NeighborGrid grid;
};

constexpr int kSide = 11;
constexpr uint32_t kMiddle = (5 * kSide + 5) * kSide + 5;

/// A cubic lattice of spacing 1 and particle mass 1, so that its density is 1.
Sample lattice(float offset = 0)
{
    Sample sample(kSide * kSide * kSide);
    uint32_t i = 0;
    for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                sample.place(i++, float(x) + offset, float(y), float(z), kNeighborhood);
    return sample;
}

/// The sorted place of the lattice's middle.
uint32_t middleOf(const Sample& sample)
{
    for (uint32_t i = 0; i < sample.gas.count; ++i)
        if (sample.grid.order()[i] == kMiddle)
            return i;
    return 0;
}

} // namespace

TEST(GasDensity, aUniformLatticeHasItsDensityAndNoSurfaceInside)
{
    Sample sample = lattice();
    sample.sum(0.0f);
    const uint32_t middle = middleOf(sample);
    EXPECT_NEAR(sample.at(sorted::Density, middle), 1.0f, 0.03f);
    EXPECT_LT(sample.at(sorted::Exposure, middle), 0.01f);
    EXPECT_EQ(sample.gas.pairs[middle], 56u); // lattice points nearer than 2.4 spacings, without itself
}

TEST(GasDensity, theGradientSumOfASymmetricNeighborhoodIsZero)
{
    Sample sample = lattice();
    sample.sum(0.0f);
    const uint32_t middle = middleOf(sample);
    EXPECT_NEAR(sample.at(sorted::AccelerationX, middle), 0.0f, 1e-3f);
    EXPECT_NEAR(sample.at(sorted::AccelerationY, middle), 0.0f, 1e-3f);
    EXPECT_NEAR(sample.at(sorted::AccelerationZ, middle), 0.0f, 1e-3f);
}

TEST(GasDensity, cornersAndLoneParticlesAreExposed)
{
    Sample sample = lattice();
    sample.sum(0.0f);
    float mostExposed = 0;
    for (uint32_t i = 0; i < sample.gas.count; ++i)
        mostExposed = std::max(mostExposed, sample.at(sorted::Exposure, i));
    EXPECT_GT(mostExposed, 0.95f);

    Sample lone(1);
    lone.place(0, 0, 0, 0, 1);
    lone.sum(0.0f);
    EXPECT_EQ(lone.at(sorted::Exposure, 0), 1.0f);
    EXPECT_EQ(lone.gas.pairs[0], 0u);
    EXPECT_EQ(lone.at(sorted::AccelerationX, 0), 0.0f);
}

TEST(GasDensity, smoothingFollowsDensityWithinItsLimits)
{
    EXPECT_NEAR(adaptSmoothing(1.2f, 1.0f, 1.0f, 1.0f), 1.2f, 1e-5f);           // at home
    EXPECT_NEAR(adaptSmoothing(1.2f, 1.0f, 1e-9f, 1e-3f), 1.2f * 1.26f, 1e-5f); // one step at a time
    EXPECT_NEAR(adaptSmoothing(1.2f, 1.0f, 1e9f, 1.0f), 1.2f / 1.26f, 1e-5f);
    float h = 1.2f;
    for (int i = 0; i < 100; ++i)
        h = adaptSmoothing(h, 1.0f, 1e-9f, 1.0f);
    EXPECT_NEAR(h, 1.6f * 1.2f, 1e-4f); // a lone particle stops swelling
    for (int i = 0; i < 100; ++i)
        h = adaptSmoothing(h, 1.0f, 1e12f, 1.0f);
    EXPECT_NEAR(h, 0.02f * 1.2f, 1e-5f); // coincident ones do not vanish
}

TEST(GasForces, compressedGasPushesApartAndThinGasDoesNotPull)
{
    for (const float equilibrium : {0.001f, 1e6f}) {
        Sample pair(2);
        pair.place(0, 0, 0, 0, 1);
        pair.place(1, 0.5f, 0, 0, 1);
        std::fill_n(pair.gas.sortedAt(sorted::Equilibrium), 2, equilibrium);
        pair.sum(1.0f);
        if (equilibrium < 1.0f) {
            EXPECT_LT(pair.at(sorted::AccelerationX, 0), -1.0f);
        } else {
            EXPECT_EQ(pair.at(sorted::AccelerationX, 0), 0.0f);
        }
        EXPECT_EQ(pair.at(sorted::AccelerationX, 1), -pair.at(sorted::AccelerationX, 0));
    }
}

TEST(GasForces, pressureIsThatOfTheEquationOfState)
{
    EXPECT_FLOAT_EQ(pressurePush(2.0f, 0.5f, 3.0f), 9.0f * 1.5f / 4.0f);
    EXPECT_EQ(pressurePush(0.5f, 2.0f, 3.0f), 0.0f);
}

TEST(GasForces, viscosityActsOnApproachOnly)
{
    for (const float speed : {-2.0f, 2.0f}) {
        Sample pair(2);
        pair.place(0, 0, 0, 0, 1);
        pair.place(1, 0.5f, 0, 0, 1);
        std::fill_n(pair.gas.sortedAt(sorted::Equilibrium), 2, 1e6f); // no pressure
        pair.gas.sortedAt(sorted::VelocityX)[1] = speed;
        pair.sum(1.0f);
        if (speed < 0.0f) {
            EXPECT_LT(pair.at(sorted::AccelerationX, 0), -1.0f); // pushed ahead of what approaches
            EXPECT_GT(pair.at(sorted::Approach, 0), 0.0f);
        } else {
            EXPECT_EQ(pair.at(sorted::AccelerationX, 0), 0.0f);
        }
    }
}

TEST(GasForces, whatOneFeelsIsTheOppositeOfWhatTheOtherFeelsBitForBit)
{
    for (uint32_t trial = 0; trial < 200; ++trial) {
        Sample pair(2);
        for (uint32_t i = 0; i < 2; ++i) {
            const auto p = base::randomUnit4(1, i, trial, base::RandomPurpose::Position);
            const auto v = base::randomUnit4(1, i, trial, base::RandomPurpose::Direction);
            pair.place(i, p[0], p[1], p[2], 0.8f + p[3]);
            pair.gas.sortedAt(sorted::VelocityX)[i] = v[0] * 50.0f;
            pair.gas.sortedAt(sorted::VelocityY)[i] = v[1] * 50.0f;
            pair.gas.sortedAt(sorted::Sound)[i] = 10.0f + v[3];
        }
        pair.sum(1.0f);
        for (const size_t c : {sorted::AccelerationX, sorted::AccelerationY, sorted::AccelerationZ})
            ASSERT_EQ(pair.at(c, 0), -pair.at(c, 1)) << trial;
    }
}

TEST(GasForces, coincidentParticlesSeparateWithoutMakingMomentum)
{
    for (const uint32_t count : {2u, 32u, 500u}) {
        Sample heap(count);
        for (uint32_t i = 0; i < count; ++i)
            heap.place(i, 1, 2, 3, 0.5f);
        heap.sum(1.0f);
        double sum = 0;
        double size = 0;
        for (uint32_t i = 0; i < count; ++i) {
            ASSERT_TRUE(std::isfinite(heap.at(sorted::Density, i)));
            ASSERT_TRUE(std::isfinite(heap.at(sorted::AccelerationX, i)));
            sum += double(heap.at(sorted::AccelerationX, i));
            size += std::abs(double(heap.at(sorted::AccelerationX, i)));
        }
        EXPECT_GT(size, 0.0) << count;
        EXPECT_LE(std::abs(sum), 1e-5 * size) << count;
    }
}
