#include "rendering/optics/black_body.h"
#include "rendering/volumes/medium_volume.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;

namespace {

/// Bricks (1, 1, 1) and (2, 1, 1) with the extinction f(x, y, z) at the voxel (x, y, z).
template <class F>
base::VoxelVolume filled(F f)
{
    base::VoxelVolume volume;
    volume.bricks = {{1, 1, 1}, {2, 1, 1}};
    for (const glm::ivec3& brick : volume.bricks)
        for (int v = 0; v < 512; ++v)
            volume.extinction.push_back(
                f(8 * brick.x + v % 8, 8 * brick.y + v / 8 % 8, 8 * brick.z + v / 64));
    return volume;
}

double sumOf(const render::MediumVolume& volume, int low, int high)
{
    double sum = 0.0;
    for (int z = low; z <= high; ++z)
        for (int y = low; y <= high; ++y)
            for (int x = low; x <= high; ++x)
                sum += volume.at(glm::dvec3(x, y, z)).extinction;
    return sum;
}

} // namespace

TEST(MediumVolume, aFunctionThatIsLinearAlongTheAxesIsExactWithinTheBricks)
{
    const auto f = [](double x, double y, double z) { return 1.0 + 0.5 * x + 0.25 * y + 0.125 * x * z; };
    const render::MediumVolume volume(
        filled([&](int x, int y, int z) { return float(f(double(x), double(y), double(z))); }));
    for (const glm::dvec3 p :
         {glm::dvec3(8, 8, 8), glm::dvec3(15.5, 9.25, 10.75), glm::dvec3(22.9, 14.9, 8.1)})
        EXPECT_NEAR(volume.at(p).extinction, f(p.x, p.y, p.z), 1e-9) << p.x;
}

TEST(MediumVolume, endsOneVoxelBeyondTheLastVoxels)
{
    const render::MediumVolume volume(filled([](int, int, int) { return 2.0f; }));
    EXPECT_EQ(volume.at({7.0, 10, 10}).extinction, 0.0);
    EXPECT_DOUBLE_EQ(volume.at({7.5, 10, 10}).extinction, 1.0);
    EXPECT_DOUBLE_EQ(volume.at({23.75, 10, 10}).extinction, 0.5);
    EXPECT_EQ(volume.at({24.0, 10, 10}).extinction, 0.0);
    EXPECT_EQ(volume.at({1e300, -1e300, NAN}).extinction, 0.0);
}

TEST(MediumVolume, voxelsOfTwiceTheSideHaveTheSameIntegral)
{
    const render::MediumVolume fine(
        filled([](int x, int y, int z) { return float((x * 7 + y * 5 + z * 3) % 11); }));
    const render::MediumVolume coarse = fine.halved();
    EXPECT_NEAR(8.0 * sumOf(coarse, 0, 14), sumOf(fine, 0, 26), 1e-4 * sumOf(fine, 0, 26));
    const render::MediumVolume even =
        render::MediumVolume(filled([](int, int, int) { return 3.0f; })).halved();
    EXPECT_NEAR(even.at({5.5, 5.5, 5.5}).extinction, 3.0, 1e-6);  // inside, nothing changes
    EXPECT_NEAR(even.at({4.0, 5.5, 5.5}).extinction, 2.25, 1e-6); // voxels 7, 8, 9, of which 7 is empty
}

TEST(MediumVolume, theLargestExtinctionOfABrickBoundsAllPlacesInItsCells)
{
    const render::MediumVolume volume(filled([](int x, int, int) { return x == 16 ? 9.0f : 1.0f; }));
    EXPECT_EQ(volume.largestIn({1, 1, 1}), 9.0f); // its last cells reach to the next brick
    EXPECT_EQ(volume.largestIn({2, 1, 1}), 9.0f);
    EXPECT_EQ(volume.largestIn({0, 0, 0}), 1.0f);
    EXPECT_EQ(volume.largestIn({3, 1, 1}), 0.0f);
    EXPECT_EQ(volume.largest(), 9.0f);
}

TEST(MediumVolume, glowsAsAGrayBodyAndByItsEmission)
{
    base::VoxelVolume voxels = filled([](int, int, int) { return 2.0f; });
    voxels.temperature.assign(1024, 1500.0f);
    voxels.emission.assign(1024, glm::vec3(5.0f, 0.0f, 0.0f));
    voxels.evenAlbedo = glm::vec3(0.25f);
    const render::MediumVolume::Sample sample = render::MediumVolume(voxels).at({12, 12, 12});
    const glm::vec3 light = render::blackBodyLuminance(1500.0f);
    EXPECT_NEAR(sample.emitted.x, 1.5 * double(light.x) + 5.0, 1e-4 * sample.emitted.x);
    EXPECT_NEAR(sample.emitted.y, 1.5 * double(light.y), 1e-4 * sample.emitted.y);
    EXPECT_NEAR(sample.scattered.z, 0.5, 1e-6);
}
