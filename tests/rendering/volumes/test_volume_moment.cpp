// Moments between two volumes: media that move keep their shape, and do not fade.
#include "rendering/optics/black_body.h"
#include "rendering/volumes/medium_volume.h"
#include "rendering/volumes/volume_place.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

using namespace fx;

namespace {

constexpr int kBricks = 5; // along each axis
constexpr float kSide = 0.5f;
constexpr double kSeconds = 0.25;

using Density = std::function<double(const glm::dvec3&)>;
using Velocity = std::function<glm::dvec3(const glm::dvec3&)>;

/// A cube of bricks; places are in voxels, velocities in voxels a second.
base::VoxelVolume volumeOf(const Density& density, const Velocity& velocity)
{
    base::VoxelVolume volume;
    volume.side = kSide;
    volume.evenAlbedo = glm::vec3(0.25f);
    for (int b = 0; b < kBricks * kBricks * kBricks; ++b)
        volume.bricks.emplace_back(1 + b % kBricks, 1 + b / kBricks % kBricks, 1 + b / kBricks / kBricks);
    for (const glm::ivec3& brick : volume.bricks)
        for (int v = 0; v < 512; ++v) {
            const glm::dvec3 place(8 * brick + glm::ivec3(v % 8, v / 8 % 8, v / 64));
            volume.extinction.push_back(float(density(place)));
            volume.emission.push_back(glm::vec3(volume.extinction.back() * 3.0f));
            if (velocity)
                volume.velocity.push_back(kSide * glm::vec3(velocity(place)));
        }
    return volume;
}

const glm::dvec3 kMiddle(8.0 + 4.0 * kBricks);

/// A smooth lump that ends 2.5 widths from its center.
double lump(const glm::dvec3& place, const glm::dvec3& center, double width)
{
    const double q = 1.0 - glm::dot(place - center, place - center) / (6.25 * width * width);
    return q > 0.0 ? q * q : 0.0;
}

/// Root mean square of the difference from `wanted` over that of `wanted`, at all voxels.
double errorOf(const render::MediumVolume& volume, const Density& wanted)
{
    double error = 0.0, all = 0.0;
    for (int z = 8; z < 8 * (kBricks + 1); ++z)
        for (int y = 8; y < 8 * (kBricks + 1); ++y)
            for (int x = 8; x < 8 * (kBricks + 1); ++x) {
                const glm::dvec3 place(x, y, z);
                error += std::pow(volume.at(place).extinction - wanted(place), 2.0);
                all += std::pow(wanted(place), 2.0);
            }
    return std::sqrt(error / all);
}

/// A lump of width 3 that moves by `way` between both volumes.
std::pair<base::VoxelVolume, base::VoxelVolume> moving(const glm::dvec3& way, bool hasVelocities)
{
    Velocity velocity;
    if (hasVelocities)
        velocity = [=](const glm::dvec3&) { return way / kSeconds; };
    const auto at = [=](double part) {
        return [=](const glm::dvec3& p) { return lump(p, kMiddle + (part - 0.5) * way, 3.0); };
    };
    return {volumeOf(at(0.0), velocity), volumeOf(at(1.0), velocity)};
}

double errorOfMoving(const glm::dvec3& way, bool hasVelocities, double part)
{
    const auto [first, second] = moving(way, hasVelocities);
    const render::MediumVolume a(first), b(second);
    const auto between = render::MediumVolume::between(a, b, {part, hasVelocities ? kSeconds : 0.0});
    return errorOf(between, [&](const glm::dvec3& p) { return lump(p, kMiddle + (part - 0.5) * way, 3.0); });
}

// dT/dt = -c T^4: T^-3 is even in time
TEST(VolumeMoment, matterThatCoolsByRadiationGlowsBetweenAsItsTemperatureSays)
{
    const auto lightOf = [](double temperature) {
        return double(render::blackBodyLuminance(float(temperature)).x);
    };
    base::VoxelVolume first;
    first.bricks = {{1, 1, 1}};
    first.extinction.assign(512, 200.0f);
    for (const double temperature : {1000.0, 1500.0, 2000.0, 3000.0})
        for (const double part : {0.25, 0.5, 0.75}) {
            const double hot = 1.075 * temperature, cold = 0.925 * temperature;
            base::VoxelVolume second = first;
            first.emission.assign(512, glm::vec3(200.0f * float(lightOf(hot))));
            second.emission.assign(512, glm::vec3(200.0f * float(lightOf(cold))));
            const auto between = render::MediumVolume::between(render::MediumVolume(first),
                                                               render::MediumVolume(second), {part, 0.0});
            const double now =
                std::pow((1.0 - part) * std::pow(hot, -3.0) + part * std::pow(cold, -3.0), -1.0 / 3.0);
            EXPECT_NEAR(between.at({11, 12, 13}).emitted.x / (200.0 * lightOf(now)), 1.0,
                        temperature < 1500.0 ? 0.2 : 0.06)
                << temperature << " K, " << part;
        }
}

/// A brick of still matter with this emission [cd/m3] and its rate [1/s].
base::VoxelVolume glowing(double light, double rate)
{
    base::VoxelVolume volume;
    volume.bricks = {{1, 1, 1}};
    volume.extinction.assign(512, 200.0f);
    volume.emission.assign(512, glm::vec3(float(light), 0.5f * float(light), 0.0f));
    volume.emissionRate.assign(512, float(rate));
    volume.velocity.assign(512, glm::vec3(0.0f));
    return volume;
}

// It burns: the light rises, and falls again.
TEST(VolumeMoment, lightOfMatterThatBurnsFollowsItsRates)
{
    const auto root = [](double part) { return 1.0 + part * (0.12 - part * (0.1 + 0.01 * part)); };
    const auto slope = [](double part) { return 0.12 - part * (0.2 + 0.03 * part); };
    const auto volumeAt = [&](double part) {
        return glowing(5e4 * std::pow(root(part), 16.0), 16.0 / kSeconds * slope(part) / root(part));
    };
    const render::MediumVolume a(volumeAt(0.0)), b(volumeAt(1.0));
    double most = 0.0;
    for (const double part : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
        const glm::dvec3 light =
            render::MediumVolume::between(a, b, {part, kSeconds}).at({10, 10, 10}).emitted;
        const double wanted = 5e4 * std::pow(root(part), 16.0);
        EXPECT_NEAR(light.x / wanted, 1.0, 1e-4) << part;
        EXPECT_NEAR(light.y / wanted, 0.5, 1e-4) << part;
        EXPECT_EQ(light.z, 0.0);
        most = std::max(most, light.x);
    }
    EXPECT_GT(most, 1.4 * a.at({10, 10, 10}).emitted.x) << "brighter than both";
    EXPECT_GT(most, 1.4 * b.at({10, 10, 10}).emitted.x);
}

TEST(VolumeMoment, ratesThatDoNotFitBothVolumesAreBounded)
{
    const render::MediumVolume a(glowing(5e4, 4096.0)), b(glowing(5e4, -4096.0));
    const double hot = render::MediumVolume::between(a, b, {0.5, kSeconds}).at({10, 10, 10}).emitted.x;
    EXPECT_NEAR(hot / 5e4, std::pow(1.0 + 1.0 / 32.0, 16.0), 1e-4); // slopes of 1/8
    const double cold = render::MediumVolume::between(b, a, {0.5, kSeconds}).at({10, 10, 10}).emitted.x;
    EXPECT_NEAR(cold / 5e4, std::pow(1.0 - 1.0 / 32.0, 16.0), 1e-4);
    const double faded = render::MediumVolume::between(a, b, {0.5, 0.0}).at({10, 10, 10}).emitted.x;
    EXPECT_NEAR(faded / 5e4, 1.0, 1e-4) << "frames that are cross-faded have no time between them";
}

/// The rate between two voxels is the mean, weighted with their light.
TEST(VolumeMoment, theRateOfAPlaceIsThatOfItsLight)
{
    base::VoxelVolume volume = glowing(100.0, 8.0);
    for (size_t v = 0; v < 512; ++v)
        if (v % 8 % 2 == 1) {
            volume.emission[v] *= 3.0f;
            volume.emissionRate[v] = -24.0f;
        }
    const render::MediumVolume fine(volume);
    EXPECT_NEAR(fine.at({10.0, 10.0, 10.0}).rate, 8.0, 1e-6);
    EXPECT_NEAR(fine.at({10.5, 10.0, 10.0}).rate, (8.0 - 3.0 * 24.0) / 4.0, 1e-5);
    const render::MediumVolume thin = [&] { // all of a thin medium is seen
        for (size_t v = 0; v < 512; ++v)
            volume.extinction[v] = 1e-3f;
        return render::MediumVolume(volume).halved();
    }();
    EXPECT_NEAR(thin.at({5.0, 5.0, 5.0}).rate, (8.0 - 3.0 * 24.0) / 4.0, 0.05);
}

TEST(VolumeMoment, whatIsColdInOneVolumeHasLightBetweenZeroAndThatOfTheOther)
{
    base::VoxelVolume hot;
    hot.bricks = {{1, 1, 1}};
    hot.extinction.assign(512, 200.0f);
    base::VoxelVolume cold = hot;
    hot.emission.assign(512, glm::vec3(5e6f, 1e-30f, 0.0f));
    cold.emission.assign(512, glm::vec3(0.0f));
    double last = 5e6;
    for (const double part : {0.0, 1e-9, 0.01, 0.5, 0.99, 1.0}) {
        const glm::dvec3 light =
            render::MediumVolume::between(render::MediumVolume(hot), render::MediumVolume(cold), {part, 0.0})
                .at({10, 10, 10})
                .emitted;
        EXPECT_TRUE(light.x <= last && light.x >= 0.0 && light.y >= 0.0 && light.y <= 1.001e-30 &&
                    light.z == 0.0)
            << part << ": " << light.x << " " << light.y << " " << light.z;
        last = light.x;
    }
    EXPECT_EQ(last, 0.0);
}

TEST(VolumeMoment, lightOfMatterThatOnlyOneVolumeHasIsItsOwnInItsShare)
{
    base::VoxelVolume hot, none;
    hot.bricks = none.bricks = {{1, 1, 1}};
    hot.extinction.assign(512, 8.0f);
    hot.emission.assign(512, glm::vec3(5e6f, 3e5f, 0.0f));
    none.extinction.assign(512, 0.0f);
    const render::MediumVolume a(hot), b(none);
    const glm::dvec3 dying = render::MediumVolume::between(a, b, {0.25, 0.0}).at({10, 10, 10}).emitted;
    const glm::dvec3 born = render::MediumVolume::between(b, a, {0.25, 0.0}).at({10, 10, 10}).emitted;
    EXPECT_NEAR(dying.x, 0.75 * 5e6, 1.0);
    EXPECT_NEAR(dying.y, 0.75 * 3e5, 0.1);
    EXPECT_NEAR(born.x, 0.25 * 5e6, 1.0);
}

} // namespace

TEST(VolumeMoment, aMediumThatMovesIsBetweenItsPlacesAndNotFaded)
{
    const glm::dvec3 way(8.0, -4.0, 2.0); // whole voxels, of which each part is a place of voxels
    EXPECT_LT(errorOfMoving(way, true, 0.5), 1e-3);
    EXPECT_LT(errorOfMoving(way, true, 0.25), 0.02) << "half voxels are interpolated";
    EXPECT_GT(errorOfMoving(way, false, 0.5), 0.5) << "a cross-fade shows two lumps";
}

/// Also of lumps of a few voxels, by parts of a voxel.
TEST(VolumeMoment, aMediumThatMovesKeepsItsMassAndItsLight)
{
    for (const double width : {0.7, 1.2, 3.0})
        for (const glm::dvec3& way : {glm::dvec3(0.9, 0.0, 0.0), glm::dvec3(3.3, -1.7, 0.6)}) {
            const auto at = [&](double part) {
                return [=](const glm::dvec3& p) { return lump(p, kMiddle + (part - 0.5) * way, width); };
            };
            const base::VoxelVolume first =
                volumeOf(at(0.0), [&](const glm::dvec3&) { return way / kSeconds; });
            base::VoxelVolume none = first; // the whole medium comes from the first volume
            none.extinction.assign(first.extinction.size(), 0.0f);
            none.emission.assign(first.extinction.size(), glm::vec3(0.0f));
            const auto between = render::MediumVolume::between(render::MediumVolume(first),
                                                               render::MediumVolume(none), {0.3, kSeconds});
            double mass = 0.0, light = 0.0, all = 0.0;
            for (int v = 0; v < 40 * 40 * 40; ++v) {
                const auto sample = between.at({8 + v % 40, 8 + v / 40 % 40, 8 + v / 1600});
                mass += sample.extinction;
                light += sample.emitted.x;
                all += 0.7 * double(first.extinction[size_t(v)]);
            }
            EXPECT_NEAR(mass / all, 1.0, 1e-5) << width;
            EXPECT_NEAR(light / all, 3.0, 1e-4) << width; // of extinction
        }
}

/// Fire behind soot: no voxel between two moments is brighter or denser than those that it comes from.
TEST(VolumeMoment, betweenVoxelsAreTheirExtremesAtMost)
{
    const glm::dvec3 way(0.5, 0.3, -0.7);
    base::VoxelVolume first =
        volumeOf([](const glm::dvec3& p) { return p.x > 20.0 && p.x < 40.0 ? 300.0 : 0.0; },
                 [&](const glm::dvec3&) { return way / kSeconds; });
    for (size_t v = 0; v < first.emission.size(); ++v) {
        const int x = 8 * first.bricks[v / 512].x + int(v % 8);
        first.emission[v] = first.extinction[v] * glm::vec3(x > 23 && x % 5 < 2 ? 1e4f : 1.0f);
    }
    const render::MediumVolume a(first);
    const auto between = render::MediumVolume::between(a, a, {0.5, kSeconds});
    double most = 0.0, hottest = 0.0, coldest = 1e9;
    for (int x = 8; x < 48; ++x) {
        const auto sample = between.at({x, 28, 28});
        most = std::max(most, sample.extinction);
        if (sample.extinction > 0.0) {
            hottest = std::max(hottest, sample.emitted.x / sample.extinction);
            coldest = std::min(coldest, sample.emitted.x / sample.extinction);
        }
        EXPECT_GE(sample.extinction, 0.0);
    }
    EXPECT_NEAR(most, 300.0, 1e-3);
    EXPECT_LE(hottest, 1e4 * (1.0 + 1e-5));
    EXPECT_GE(coldest, 1.0 - 1e-5);
}

TEST(VolumeMoment, atItsEndsIsEachVolumeItself)
{
    const auto [first, second] = moving({7.0, 1.0, 3.0}, true);
    const render::MediumVolume a(first), b(second);
    for (const double part : {0.0, 1.0}) {
        const auto between = render::MediumVolume::between(a, b, {part, kSeconds});
        const render::MediumVolume& end = part == 0.0 ? a : b;
        for (int i = 9; i < 40; ++i) {
            const glm::dvec3 place(i, 0.5 * i + 10.0, 28.0);
            EXPECT_DOUBLE_EQ(between.at(place).extinction, end.at(place).extinction);
            EXPECT_EQ(between.at(place).emitted, end.at(place).emitted);
            EXPECT_EQ(between.at(place).scattered, end.at(place).scattered);
        }
    }
}

/// Its velocity is way over time: r / t. All places are exact up to the square of the step over t.
TEST(VolumeMoment, aMediumThatExpandsHasTheWidthOfItsTime)
{
    constexpr double kAge = 1.5; // [s] of the first volume
    const auto at = [](double age) {
        return [=](const glm::dvec3& p) {
            return std::pow(kAge / age, 3.0) * lump(p, kMiddle, 4.0 * age / kAge);
        };
    };
    const auto flow = [](double age) { return [=](const glm::dvec3& p) { return (p - kMiddle) / age; }; };
    const render::MediumVolume a(volumeOf(at(kAge), flow(kAge)));
    const render::MediumVolume b(volumeOf(at(kAge + kSeconds), flow(kAge + kSeconds)));
    const auto wanted = at(kAge + 0.5 * kSeconds);
    const double moved = errorOf(render::MediumVolume::between(a, b, {0.5, kSeconds}), wanted);
    const double faded = errorOf(render::MediumVolume::between(a, b, {0.5, 0.0}), wanted);
    EXPECT_LT(moved, 0.015);
    EXPECT_LT(moved, 0.6 * faded);
}

TEST(VolumeMoment, twoStreamsThatCrossBothArrive)
{
    const auto at = [](double part) {
        return [=](const glm::dvec3& p) {
            return lump(p, kMiddle + glm::dvec3(12.0 * (part - 0.5), -7.0, 0.0), 2.5) +
                   lump(p, kMiddle - glm::dvec3(12.0 * (part - 0.5), -7.0, 0.0), 2.5);
        };
    };
    const Velocity velocity = [](const glm::dvec3& p) {
        return glm::dvec3(p.y < kMiddle.y ? 12.0 : -12.0, 0.0, 0.0) / kSeconds;
    };
    const render::MediumVolume a(volumeOf(at(0.0), velocity)), b(volumeOf(at(1.0), velocity));
    EXPECT_LT(errorOf(render::MediumVolume::between(a, b, {0.5, kSeconds}), at(0.5)), 1e-3);
}

TEST(VolumeMoment, coarserVoxelsMoveAsFarInTheWorld)
{
    const glm::dvec3 way(8.0, 0.0, 4.0);
    const auto [first, second] = moving(way, true);
    const render::MediumVolume a(first), b(second);
    const auto between = render::MediumVolume::between(a.halved(), b.halved(), {0.5, kSeconds});
    const auto wanted =
        render::MediumVolume(volumeOf([&](const glm::dvec3& p) { return lump(p, kMiddle, 3.0); }, nullptr))
            .halved();
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 place = 0.5 * kMiddle + glm::dvec3(0.05 * (i - 50), 0.03 * (i - 40), 0.02 * i - 1.0);
        EXPECT_NEAR(between.at(place).extinction, wanted.at(place).extinction, 5e-3);
    }
}

/// The second volume has voxels 1.25 times as wide, which are on no voxels of the first.
TEST(VolumeMoment, voxelsOfDifferentSidesMoveInTheWorldAndKeepTheirMass)
{
    constexpr double kWider = 1.25;
    const glm::dvec3 way(6.0, -3.0, 2.0), offset(0.3, -0.4, 0.2); // in voxels of the first
    const base::LatticeMap toSecond({glm::dvec3(0.0), 1.0}, {kMiddle * (1.0 - kWider) + offset, kWider});
    const auto inFirst = [&](const glm::dvec3& p) { return kMiddle * (1.0 - kWider) + offset + kWider * p; };
    const auto first = volumeOf([&](const glm::dvec3& p) { return lump(p, kMiddle - 0.5 * way, 4.0); },
                                [&](const glm::dvec3&) { return way / kSeconds; });
    auto second = volumeOf([&](const glm::dvec3& p) { return lump(inFirst(p), kMiddle + 0.5 * way, 4.0); },
                           [&](const glm::dvec3&) { return way / kSeconds; });
    second.side *= float(kWider); // velocities are in meters
    const auto between = render::MediumVolume::between(
        render::MediumVolume(first), render::MediumVolume(second), {0.5, kSeconds, {}, toSecond});
    const Density wanted = [](const glm::dvec3& p) { return lump(p, kMiddle, 4.0); };
    EXPECT_LT(errorOf(between, wanted), 0.02);
    double mass = 0.0, all = 0.0;
    for (int v = 0; v < 40 * 40 * 40; ++v) {
        const glm::dvec3 place(8 + v % 40, 8 + v / 40 % 40, 8 + v / 1600);
        mass += between.at(place).extinction;
        all += wanted(place);
    }
    EXPECT_NEAR(mass / all, 1.0, 1e-3);
    const auto fixed = render::MediumVolume::between(render::MediumVolume(first),
                                                     render::MediumVolume(second), {0.5, 0.0, {}, toSecond});
    EXPECT_GT(errorOf(fixed, wanted), 0.3) << "a cross-fade shows two lumps";
}

TEST(FramePair, goesOnAfterTheEndOfALoopAndStaysAtTheEndOtherwise)
{
    render::GroupVolume volume;
    for (const bool loops : {false, true}) {
        volume.loops = loops;
        volume.frame = 9.75;
        const render::FramePair end = render::framePair(volume, 10);
        EXPECT_EQ(end.first, 9u);
        EXPECT_EQ(end.second, loops ? 0u : 9u);
        EXPECT_DOUBLE_EQ(end.part, loops ? 0.75 : 0.0);
        volume.frame = 12.25;
        const render::FramePair after = render::framePair(volume, 10);
        EXPECT_EQ(after.first, loops ? 2u : 9u);
        EXPECT_DOUBLE_EQ(after.part, loops ? 0.25 : 0.0);
        volume.frame = -0.25; // before the start
        EXPECT_EQ(render::framePair(volume, 10).first, 0u);
        EXPECT_EQ(render::framePair(volume, 10).second, 0u);
    }
    volume.frame = 9.0;
    const render::FramePair last = render::framePair(volume, 10);
    EXPECT_EQ(last.first, 9u);
    EXPECT_EQ(last.second, 9u);
    volume.frame = 3.5;
    EXPECT_EQ(render::framePair(volume, 10).second, 4u);
    EXPECT_EQ(render::framePair(volume, 1).first, 0u);
}
