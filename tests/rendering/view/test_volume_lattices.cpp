// Sequences whose frames have voxels of different sides: OpenGL against the reference, and both against the
// medium.
#include "volume_voxels_fixture.h"

using namespace fx;
using namespace fx::test;

namespace {

constexpr double kWidth = 0.6;          ///< [m] radius of the medium
const glm::dvec3 kWay(0.35, -0.2, 0.1); ///< [m] from frame to frame
const glm::quat kUpright(1.0f, 0.0f, 0.0f, 0.0f);

/// A smooth ball that glows and moves, on voxels that have the given side and are on no lattice of others.
base::VoxelVolume ballOn(float side, const glm::dvec3& center)
{
    constexpr int kBricks = 3;
    base::VoxelVolume volume;
    volume.side = side;
    volume.origin = glm::vec3(center) - side * (8.0f * (1.0f + 0.5f * kBricks) + 0.37f);
    for (int b = 0; b < kBricks * kBricks * kBricks; ++b)
        volume.bricks.emplace_back(1 + b % kBricks, 1 + b / kBricks % kBricks, 1 + b / kBricks / kBricks);
    for (const glm::ivec3& brick : volume.bricks)
        for (int v = 0; v < 512; ++v) {
            const glm::vec3 voxel = glm::vec3(8 * brick + glm::ivec3(v % 8, v / 8 % 8, v / 64));
            const glm::dvec3 away = glm::dvec3(volume.origin + side * voxel) - center;
            const double q = std::max(1.0 - glm::dot(away, away) / (kWidth * kWidth), 0.0);
            volume.extinction.push_back(float(3.0 * q * q));
            volume.emission.push_back(volume.extinction.back() * glm::vec3(300.0f, 500.0f, 800.0f));
            volume.albedo.emplace_back(0.0f);
            volume.velocity.push_back(glm::vec3(kWay / kFrameSeconds));
        }
    return volume;
}

/// Three frames whose voxels become larger, and then smaller.
std::vector<base::VoxelVolume> frames()
{
    return {ballOn(0.07f, -0.5 * kWay), ballOn(0.09f, 0.5 * kWay), ballOn(0.08f, 1.5 * kWay)};
}

double integralOf(const std::vector<double>& picture, size_t channel)
{
    double sum = 0.0;
    for (size_t i = channel; i < picture.size(); i += 4)
        sum += picture[i];
    return sum;
}

} // namespace

using VolumeLatticesTest = VolumeVoxelsTest;

TEST_F(VolumeLatticesTest, eachFrameIsShownOnItsOwnVoxels)
{
    const std::vector<base::VoxelVolume> all = frames();
    for (const size_t frame : {0u, 1u, 2u}) {
        const Picture picture =
            renderAlone(publishBetween(all, 4, base::toTicks(double(frame) * kFrameSeconds)));
        EXPECT_EQ(played_.sequence->largestSide(), double(0.09f));
        expectEqual(picture, integrals(all[frame], kUpright, 1.0, 5.0), 0.01);
    }
}

TEST_F(VolumeLatticesTest, betweenTwoFramesAreTheMomentOfTheReferenceInTheWorld)
{
    const std::vector<base::VoxelVolume> all = frames();
    for (const double time : {0.5, 1.25}) {
        const auto first = size_t(time);
        const double part = time - double(first);
        const base::VoxelVolume &a = all[first], &b = all[first + 1], &finer = a.side < b.side ? a : b;
        const Picture picture = renderAlone(publishBetween(all, 4, base::toTicks(time * kFrameSeconds)));
        const auto between = render::MediumVolume::between(
            render::MediumVolume(a), render::MediumVolume(b),
            {part, kFrameSeconds, {latticeOf(finer), latticeOf(a)}, {latticeOf(finer), latticeOf(b)}});
        expectEqual(picture, integrals(between, finer, kUpright, 1.0, 5.0), 0.01);
        const std::vector<double> moment = integrals(ballOn(0.05f, (time - 0.5) * kWay), kUpright, 1.0, 5.0);
        expectEqual(picture, moment, 0.03);
        EXPECT_NEAR(sumOf(picture, 3) / integralOf(moment, 3), 1.0, 0.03) << "no medium is lost";
    }
}

TEST_F(VolumeLatticesTest, coarserVoxelsOfBothKeepMassAndPlace)
{
    const std::vector<base::VoxelVolume> all = frames();
    played_.density = 0.02f; // opacities are as the mass
    const auto atTime = [&](double time) {
        const base::FrameSnapshot snapshot = publishBetween(all, 4, base::toTicks(time * kFrameSeconds));
        played_.sequence->setWaits(true);
        return renderAlone(snapshot, kFar);
    };
    const Picture picture = atTime(0.5);
    const double before = sumOf(atTime(0.0), 3), behind = sumOf(atTime(1.0), 3);
    EXPECT_NEAR(sumOf(picture, 3) / (0.5 * (before + behind)), 1.0, 0.06) << "the ball is three voxels wide";
    double moved = 0.0, all3 = 0.0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const double opacity = double(picture.texels[size_t(4 * (y * kSize + x) + 3)]);
            moved += opacity * (x + 0.5 - 0.5 * kSize);
            all3 += opacity;
        }
    EXPECT_NEAR(moved / all3, 0.0, 0.1) << "[pixel] halfway the ball is in the middle";
}
