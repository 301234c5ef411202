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

namespace {

/// [1] Emitted light over extinction in units of that of the fire, of voxels of twice the side at the face of
/// a medium. @param first, rest [1/m] extinctions of the first layer of voxels and of all behind it
/// @param fireIsFirst the first layer glows, or all behind it
double sourceAtTheFace(float first, float rest, bool fireIsFirst)
{
    base::VoxelVolume volume = filled([&](int x, int, int) { return x == 8 ? first : rest; });
    volume.side = 0.1f;
    volume.evenAlbedo = glm::vec3(0.0f);
    for (size_t v = 0; v < volume.extinction.size(); ++v)
        volume.emission.push_back(
            glm::vec3((v < 512 && v % 8 == 0) == fireIsFirst ? volume.extinction[v] : 0.0f));
    const render::MediumVolume::Sample sample = render::MediumVolume(volume).halved().at({4.0, 6.0, 6.0});
    return sample.emitted.x / sample.extinction;
}

} // namespace

TEST(MediumVolume, largerVoxelsHaveTheLightOfTheSideThatIsSeen)
{
    // The first layer has twice the weight of the second one, and none of the third.
    EXPECT_NEAR(sourceAtTheFace(1e-3f, 1e-3f, true), 2.0 / 3.0, 1e-3); // all of a thin medium is seen
    EXPECT_NEAR(sourceAtTheFace(1e-3f, 1e-3f, false), 1.0 / 3.0, 1e-3);
    EXPECT_LT(sourceAtTheFace(300.0f, 300.0f, false), 1e-4); // behind soot
    EXPECT_GT(sourceAtTheFace(300.0f, 300.0f, true), 1.0 - 1e-4);
    // Of a thin flame before soot as much is seen as it hides of the soot, by rays along the axis, through
    // the corners and within the flame, whose way to its side is about 0.7; layers count 2 to 1.
    const double axis = 1.0 / 15.0, corners = 4.0 * 3.0 / 40.0 / std::sqrt(3.0), within = 4.0 / 15.0;
    const double depth = 0.2, along = std::exp(-depth), across = std::exp(-std::sqrt(3.0) * depth);
    const double flame =
        2.0 * (axis * (1.0 - along) + corners * (1.0 - across) + within * (1.0 - along) * std::exp(-0.7));
    const double soot = axis * along + corners * across;
    EXPECT_NEAR(sourceAtTheFace(float(depth / 0.1), 300.0f, true), flame / (flame + soot), 0.02);
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
