#include "foundation/assets/volume_lattice.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

using namespace fx;
using base::LatticeMap;
using base::VolumeLattice;

namespace {

const VolumeLattice kCoarse{{-4.0, 1.0, 0.25}, 0.11};
const VolumeLattice kFine{{-4.3, 0.6, -0.1}, 0.08};

/// Some bricks with voxels of which some have no medium.
base::VoxelVolume volumeOn(const VolumeLattice& lattice)
{
    base::VoxelVolume volume;
    volume.side = float(lattice.side);
    volume.origin = glm::vec3(lattice.origin);
    volume.bricks = {{2, 2, 2}, {3, 2, 2}, {2, 4, 3}};
    for (size_t v = 0; v < volume.bricks.size() * base::kVolumeBrickVoxels; ++v) {
        volume.extinction.push_back(v % 7 < 4 ? 1.0f + float(v % 11) : 0.0f);
        volume.temperature.push_back(1000.0f + float(v / 512));
        volume.albedo.emplace_back(0.25f);
    }
    return volume;
}

struct Sums
{
    double section = 0.0, heat = 0.0;
    glm::dvec3 center{0.0};
};

Sums sumsOf(const std::vector<base::VolumeCells>& cells, const VolumeLattice& lattice)
{
    Sums sums;
    for (const base::VolumeCells& own : cells) {
        const auto section = double(own.crossSection);
        sums.section += section;
        sums.heat += section * double(own.temperature);
        sums.center += section * (lattice.origin + lattice.side * 8.0 * (glm::dvec3(own.brick) + 0.5));
    }
    sums.heat /= sums.section;
    sums.center /= sums.section;
    return sums;
}

bool isIn(const std::vector<glm::ivec3>& bricks, const glm::ivec3& brick)
{
    return std::ranges::find(bricks, brick) != bricks.end();
}

} // namespace

TEST(VolumeLattice, mapsThroughTheWorldAndBack)
{
    const glm::dvec3 place(3.0, 7.5, -2.0);
    const glm::dvec3 world = kFine.origin + kFine.side * place;
    const LatticeMap there(kFine, kCoarse), back(kCoarse, kFine);
    for (int a = 0; a < 3; ++a) {
        EXPECT_NEAR((kCoarse.origin + kCoarse.side * there(place))[a], world[a], 1e-12);
        EXPECT_NEAR(back(there(place))[a], place[a], 1e-12);
    }
    EXPECT_TRUE(LatticeMap(kFine, kFine).isSame());
}

TEST(VolumeLattice, cellsOnAnotherKeepCrossSectionHeatAndPlace)
{
    for (const auto& [from, to] : {std::pair(kCoarse, kFine), std::pair(kFine, kCoarse)}) {
        const auto cells = base::volumeCells(volumeOn(from));
        const auto moved = base::cellsOn(to, cells, from);
        const Sums before = sumsOf(cells, from), after = sumsOf(moved, to);
        EXPECT_NEAR(after.section / before.section, 1.0, 1e-5);
        EXPECT_NEAR(after.heat / before.heat, 1.0, 1e-6);
        for (int a = 0; a < 3; ++a)
            EXPECT_NEAR(after.center[a], before.center[a], 1.5 * to.side);
        EXPECT_TRUE(std::ranges::is_sorted(moved, base::isBefore, &base::VolumeCells::brick));
    }
}

/// Whether there is medium at a place of an interpolated volume.
bool hasMedium(const base::VoxelVolume& volume, const base::BrickIndex& index, const glm::dvec3& place)
{
    const glm::ivec3 low(glm::floor(place));
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 corner = low + glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
        const uint32_t brick = index.find({corner.x >> 3, corner.y >> 3, corner.z >> 3});
        const int v = (corner.x & 7) + 8 * (corner.y & 7) + 64 * (corner.z & 7);
        if (brick != base::BrickIndex::kNone && volume.extinction[512 * size_t(brick) + size_t(v)] > 0.0f)
            return true;
    }
    return false;
}

/// The first voxels of bricks are empty, so that bricks before them have no cells. Each voxel of another
/// lattice that has medium is in a brick that is found, and so are the cells around it.
TEST(VolumeLattice, noMediumIsOutsideOfTheBricksAndCellsThatAreFound)
{
    base::VoxelVolume volume = volumeOn(kFine);
    for (size_t v = 0; v < volume.extinction.size(); ++v)
        volume.extinction[v] = v % 8 == 0 || v / 8 % 8 == 0 || v / 64 % 8 == 0 ? 0.0f : 1.0f;
    const base::BrickIndex index(volume.bricks);
    const auto cells = base::volumeCells(volume);
    for (int i = 0; i < 24; ++i) {
        VolumeLattice to{kFine.origin - 0.037 * double(i) * glm::dvec3(1.0, 0.7, 0.9),
                         i % 2 == 0 ? 0.1 : 0.07};
        const LatticeMap map(to, kFine);
        const auto reached = base::bricksReached(volume.bricks, map);
        std::vector<glm::ivec3> found;
        for (const base::VolumeCells& own : base::cellsOn(to, cells, kFine))
            found.push_back(own.brick);
        size_t inside = 0, outside = 0;
        for (int v = 0; v < 64 * 64 * 64; ++v) {
            const glm::ivec3 voxel(v % 64, v / 64 % 64, v / 4096);
            if (!hasMedium(volume, index, map(glm::dvec3(voxel))))
                continue;
            ++inside;
            outside += isIn(reached, {voxel.x >> 3, voxel.y >> 3, voxel.z >> 3}) ? 0 : 1;
            for (int k = 0; k < 8; ++k) { // cells that it is a corner of
                const glm::ivec3 cell = voxel - glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
                outside += isIn(found, {cell.x >> 3, cell.y >> 3, cell.z >> 3}) ? 0 : 1;
            }
        }
        EXPECT_GT(inside, 500u);
        EXPECT_EQ(outside, 0u) << i;
    }
}

TEST(VolumeLattice, onItsOwnLatticeBricksStay)
{
    const base::VoxelVolume volume = volumeOn(kFine);
    EXPECT_EQ(base::bricksReached(volume.bricks, {}), volume.bricks);
}
