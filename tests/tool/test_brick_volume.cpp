// Where the voxels of an imported volume are: their centers are the places that the grid states.
#include "fxsdk/cli/import/brick_volume.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace fx;

namespace {

/// Blocks around a smooth lump at `center` [m] of a grid with this lattice.
render::MediumGrid lump(const glm::dmat3& axes, const glm::dvec3& origin, const glm::dvec3& center,
                        double radius)
{
    render::MediumGrid grid;
    grid.axes = axes;
    grid.origin = origin;
    for (int b = 0; b < 8 * 8 * 8; ++b) {
        const glm::ivec3 block = 8 * (glm::ivec3(b / 64, b / 8 % 8, b % 8) - 4);
        std::vector<float> density;
        bool isEmpty = true;
        for (int v = 0; v < 512; ++v) {
            const glm::dvec3 place = grid.place(glm::dvec3(block + glm::ivec3(v / 64, v / 8 % 8, v % 8)));
            const double q = 1.0 - glm::dot(place - center, place - center) / (radius * radius);
            density.push_back(q > 0.0 ? float(q * q) : 0.0f);
            isEmpty = isEmpty && !(q > 0.0);
        }
        if (isEmpty)
            continue;
        grid.blocks.push_back(block);
        for (const float value : density) {
            grid.density.push_back(value);
            grid.velocity.push_back(value > 0.0f ? glm::vec3(1.0f, -2.0f, 3.0f) : glm::vec3(0.0f));
        }
    }
    return grid;
}

/// [m] Center of the extinction of voxels.
glm::dvec3 centerOf(const base::VoxelVolume& volume)
{
    glm::dvec3 moment(0.0);
    double sum = 0.0;
    for (size_t b = 0; b < volume.bricks.size(); ++b)
        for (int v = 0; v < 512; ++v) {
            const glm::ivec3 voxel = 8 * volume.bricks[b] + glm::ivec3(v % 8, v / 8 % 8, v / 64);
            const auto density = double(volume.extinction[512 * b + size_t(v)]);
            sum += density;
            moment += density * (glm::dvec3(volume.origin) + double(volume.side) * glm::dvec3(voxel));
        }
    return moment / sum;
}

constexpr double kVoxel = 0.25; // [m]

} // namespace

TEST(BrickVolume, cubesAlongTheAxesAreCopiedToTheirPlaces)
{
    const glm::dvec3 origin(0.03, -0.11, 0.07); // no multiple of the side
    for (const glm::dvec3& center : {glm::dvec3(0.4, 1.1, -0.9), glm::dvec3(-2.2, 0.3, 1.7)}) {
        const render::MediumGrid grid = lump(glm::dmat3(kVoxel), origin, center, 1.5);
        const auto volume = cli::voxelVolumeOf(grid, 0.5);
        ASSERT_TRUE(volume.ok()) << volume.status().message();
        const glm::dvec3 wanted = render::sumsOf(grid).center, found = centerOf(*volume);
        for (int a = 0; a < 3; ++a) {
            EXPECT_NEAR(found[a], wanted[a], 1e-5 * kVoxel) << a;
            EXPECT_NEAR(found[a], center[a], 0.02 * kVoxel) << a; // the lump itself, by its samples
        }
        EXPECT_TRUE(volume->velocity.empty()) << "of a volume that does not move";
    }
}

TEST(BrickVolume, turnedVoxelsOfUnequalSidesAreInterpolatedAtTheirPlaces)
{
    glm::dmat3 axes(glm::rotate(glm::dmat4(1.0), 0.6, glm::normalize(glm::dvec3(1.0, 2.0, -0.5))));
    axes[0] *= 0.3;
    axes[1] *= kVoxel;
    axes[2] *= 0.28;
    const glm::dvec3 center(0.4, 0.2, -0.3);
    const auto volume = cli::voxelVolumeOf(lump(axes, {0.1, 0.2, 0.3}, center, 1.8), 0.5);
    ASSERT_TRUE(volume.ok()) << volume.status().message();
    EXPECT_NEAR(double(volume->side), kVoxel, 1e-6);
    const glm::dvec3 found = centerOf(*volume);
    for (int a = 0; a < 3; ++a)
        EXPECT_NEAR(found[a], center[a], 0.05 * kVoxel) << a;
}

TEST(BrickVolume, voxelsOfASequenceHaveTheRatesOfTheGridAndItsVelocitiesWhichSpread)
{
    render::MediumGrid grid = lump(glm::dmat3(kVoxel), glm::dvec3(0.0), glm::dvec3(0.1), 1.0);
    grid.flame = grid.density;
    grid.flameRate.assign(grid.flame.size(), -7.0f);
    EXPECT_TRUE(cli::voxelVolumeOf(grid, 0.5)->emissionRate.empty());
    const auto volume = cli::voxelVolumeOf(grid, 0.5, true);
    ASSERT_TRUE(volume.ok()) << volume.status().message();
    ASSERT_EQ(volume->emissionRate.size(), volume->extinction.size());
    for (size_t v = 0; v < volume->emissionRate.size(); ++v)
        EXPECT_EQ(volume->emissionRate[v], volume->extinction[v] > 0.0f ? -7.0f : 0.0f) << v;
    ASSERT_EQ(volume->velocity.size(), volume->extinction.size());
    for (size_t v = 0; v < volume->velocity.size(); ++v)
        EXPECT_LT(glm::length(volume->velocity[v] - glm::vec3(1.0f, -2.0f, 3.0f)), 1e-5f) << v;
}
