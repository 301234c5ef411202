// Coarser levels of volumes, as they are prepared for OpenGL.
#include "rendering/volumes/volume_levels.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

using namespace fx;

namespace {

/// Bricks here and there, of which every other has medium in all of its voxels.
base::VoxelVolume scattered()
{
    base::VoxelVolume volume;
    volume.side = 0.1f;
    volume.bricks = {{1, 1, 1}, {2, 1, 1}, {9, 3, 1}, {1, 2, 2}, {40, 17, 5}, {126, 1, 90}};
    for (size_t b = 0; b < volume.bricks.size(); ++b)
        for (size_t v = 0; v < base::kVolumeBrickVoxels; ++v) {
            const bool isThere = b % 2 == 0 || v == 77;
            volume.extinction.push_back(isThere ? 1.0f + 0.1f * std::sin(float(v)) : 0.0f);
            volume.emission.push_back(isThere ? glm::vec3(3.0f, 2.0f, 1.0f) : glm::vec3(0.0f));
            volume.velocity.push_back(glm::vec3(1.0f, float(b), 0.0f));
        }
    return volume;
}

double massOf(const base::VolumeLevel& level, double side)
{
    double sum = 0.0;
    for (size_t v = 0; v < level.bricks * base::kVolumeBrickVoxels; ++v)
        sum += double(std::bit_cast<float>(level.voxels[v][0]));
    return sum * side * side * side;
}

} // namespace

TEST(VolumeLevels, areEachHalvedFromTheOneBefore)
{
    const base::VoxelVolume volume = scattered();
    const base::CoarserLevels levels = render::coarserLevels(volume);
    ASSERT_EQ(levels->coarser.size(), size_t(base::kMostVolumeLevel));
    render::MediumVolume medium(volume);
    for (const base::VolumeLevel& level : levels->coarser) {
        medium = medium.halved();
        EXPECT_EQ(level.bricks, medium.bricks());
        EXPECT_EQ(level.brightest, medium.brightest());
        EXPECT_EQ(level.voxels, medium.packedWithVelocities());
        EXPECT_EQ(level.index.table(), medium.index().table());
    }
}

TEST(VolumeLevels, keepTheMassDownToTheCoarsest)
{
    const base::VoxelVolume volume = scattered();
    double mass = 0.0;
    for (const float extinction : volume.extinction)
        mass += double(extinction) * std::pow(double(volume.side), 3.0);
    double side = double(volume.side);
    const base::CoarserLevels levels = render::coarserLevels(volume);
    for (const base::VolumeLevel& level : levels->coarser) {
        side *= 2.0;
        EXPECT_NEAR(massOf(level, side), mass, 1e-5 * mass) << side;
    }
}

TEST(VolumeLevels, theirMemoryIsBoundedBeforehand)
{
    base::VoxelVolume volume = scattered();
    const uint64_t exact = render::coarserLevels(volume)->bytes(),
                   bound = render::mostCoarserBytes(volume.bricks, !volume.velocity.empty());
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 2 * exact);
    for (float& extinction : volume.extinction)
        extinction = 1.0f;
    EXPECT_GE(bound, render::coarserLevels(volume)->bytes()) << "whatever the voxels hold";
}
