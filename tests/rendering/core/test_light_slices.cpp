// Planes of optical depth across a light: their places, and what they hold against the sum over all balls,
// integrated in double precision from the definition of the kernel.
#include "foundation/random/philox.h"
#include "rendering/lights/slices/slice_depths.h"
#include "rendering/lights/slices/slice_fades.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <numbers>
#include <vector>

using namespace fx::render;

namespace {

constexpr double kFar = 1e4; // [m]

/// Balls in the unit ball around `middle`. @param depth [1] about that of the middle
std::vector<MediumCaster> cloud(uint32_t count, float depth, const glm::vec3& middle = glm::vec3(0.0f))
{
    std::vector<MediumCaster> casters;
    for (uint32_t i = 0; casters.size() < count; ++i) {
        const auto u = fx::base::randomUnit4(11, 0, i, fx::base::RandomPurpose::Position);
        const glm::vec3 p(2.0f * u[0] - 1.0f, 2.0f * u[1] - 1.0f, 2.0f * u[2] - 1.0f);
        if (glm::dot(p, p) <= 1.0f)
            casters.push_back({middle + p, 0.25f + 0.25f * u[3], 2.0f * depth / float(count)});
    }
    return casters;
}

/// [1] of the kernel's definition along a segment: three Gauss points integrate a polynomial of degree 5.
double exactDepth(std::span<const MediumCaster> casters, const glm::dvec3& from, const glm::dvec3& to)
{
    const double length = glm::length(to - from);
    const glm::dvec3 direction = (to - from) / length;
    double depth = 0.0;
    for (const MediumCaster& caster : casters) {
        const glm::dvec3 d = glm::dvec3(caster.center) - from;
        const double r = double(caster.radius), middle = glm::dot(d, direction);
        const double chord2 = r * r - glm::dot(d - middle * direction, d - middle * direction);
        if (chord2 <= 0.0)
            continue;
        const double begin = std::max(middle - std::sqrt(chord2), 0.0);
        const double end = std::min(middle + std::sqrt(chord2), length);
        const double node = 0.5 * std::sqrt(0.6);
        for (int k = -1; k <= 1 && end > begin; ++k) {
            const glm::dvec3 p = from + direction * (0.5 * (begin + end) + double(k) * node * (end - begin));
            const glm::dvec3 away = p - glm::dvec3(caster.center);
            const double density = std::pow(1.0 - glm::dot(away, away) / (r * r), 2.0);
            depth += double(caster.crossSection) * 105.0 / (32.0 * std::numbers::pi * r * r * r) * density *
                     (end - begin) * (k == 0 ? 8.0 : 5.0) / 18.0;
        }
    }
    return depth;
}

/// Where the ray of a texel passes a plane.
glm::dvec3 pointOf(const SliceStack& stack, float x, float y, double plane)
{
    const SliceRay ray = sliceRay(stack, x, y);
    return glm::dvec3(ray.start) +
           glm::dvec3(ray.direction) * (double(stack.first) + plane * double(stack.spacing));
}

double exactAt(const SliceStack& stack, std::span<const MediumCaster> casters, float x, float y, double plane)
{
    const glm::dvec3 to = pointOf(stack, x, y, plane);
    if (stack.mapping == SliceMapping::Parallel)
        return exactDepth(casters, to - glm::dvec3(stack.along) * kFar, to);
    return to != glm::dvec3(stack.origin) ? exactDepth(casters, glm::dvec3(stack.origin), to) : 0.0;
}

const glm::vec3 kTowards = glm::normalize(glm::vec3(0.3f, 0.8f, -0.4f));

SliceStack parallelStack(std::span<const MediumCaster> casters, const SliceResolution& resolution,
                         const glm::dvec3& eye = glm::dvec3(0.0))
{
    SliceStack stack;
    EXPECT_TRUE(fitParallelSlices(kTowards, casters, eye, resolution, stack));
    return stack;
}

SliceStack pointStack(std::span<const MediumCaster> casters, const glm::vec3& light,
                      const SliceResolution& resolution, float radius = 0.0f)
{
    SliceStack stack;
    EXPECT_TRUE(fitPointSlices(light, radius, casters, glm::dvec3(0.0), resolution, stack));
    return stack;
}

SliceDepths filled(const SliceStack& stack, std::span<const MediumCaster> casters)
{
    SliceDepths depths(std::pmr::new_delete_resource());
    depths.build(stack, casters);
    return depths;
}

/// Largest difference of all texels of all planes from the exact sum, relative to the largest depth.
double texelError(const SliceStack& stack, std::span<const MediumCaster> casters)
{
    const SliceDepths depths = filled(stack, casters);
    double worst = 0.0, most = 0.0;
    for (int k = 0; k < stack.resolution.planes; ++k)
        for (int y = 0; y < stack.resolution.texels; ++y)
            for (int x = 0; x < stack.resolution.texels; ++x) {
                const double exact = exactAt(stack, casters, float(x) + 0.5f, float(y) + 0.5f, double(k));
                worst = std::max(worst, std::abs(double(depths.at(k, x, y)) - exact));
                most = std::max(most, exact);
            }
    EXPECT_GT(most, 0.1);
    return worst / most;
}

/// Largest error between planes at the rays of texels, where interpolation across them has no part.
double errorBetweenPlanes(const SliceStack& stack, std::span<const MediumCaster> casters)
{
    const SliceDepths depths = filled(stack, casters);
    const int n = stack.resolution.texels;
    double worst = 0.0;
    for (int y = n / 4; y < 3 * n / 4; ++y)
        for (int x = n / 4; x < 3 * n / 4; ++x)
            for (double plane = 0.5; plane < stack.resolution.planes - 1; plane += 0.25) {
                const float tx = float(x) + 0.5f, ty = float(y) + 0.5f;
                const double exact = exactAt(stack, casters, tx, ty, plane);
                const glm::vec3 p(pointOf(stack, tx, ty, plane));
                worst = std::max(worst, std::abs(double(depths.depthAt(p).toLight) - exact));
            }
    return worst;
}

} // namespace

TEST(SliceDepths, texelsHoldTheExactSumOverAllBalls)
{
    const auto casters = cloud(40, 3.0f);
    EXPECT_LT(texelError(parallelStack(casters, {24, 12}), casters), 1e-5);
    EXPECT_LT(texelError(pointStack(casters, {3.0f, 2.0f, 1.0f}, {24, 12}), casters), 1e-5);
    EXPECT_LT(texelError(pointStack(casters, {0.1f, 0.2f, 0.3f}, {24, 12}), casters), 1e-5);
}

TEST(SliceDepths, beforeAllMediaNothingIsDarkBehindThemTheWholeDepthCounts)
{
    const auto casters = cloud(40, 3.0f);
    const SliceDepths depths = filled(parallelStack(casters, {64, 32}), casters);
    for (const float side : {0.0f, 0.31f, -0.44f}) {
        const glm::vec3 p = side * depths.stack().right - 0.5f * side * depths.stack().up;
        const SliceDepth before = depths.depthAt(p + 5.0f * kTowards);
        const SliceDepth behind = depths.depthAt(p - 5.0f * kTowards);
        EXPECT_EQ(before.toLight, 0.0f);
        EXPECT_NEAR(before.total, behind.total, 1e-5f * behind.total);
        EXPECT_EQ(behind.toLight, behind.total);
        const glm::dvec3 to(p - 5.0f * kTowards);
        EXPECT_NEAR(double(behind.total), exactDepth(casters, to + kFar * glm::dvec3(kTowards), to),
                    0.02 * double(behind.total));
    }
    for (const float away : {2.0f, 5.0f, 100.0f}) // beside the media
        EXPECT_EQ(depths.depthAt(away * depths.stack().right).total, 0.0f);
}

TEST(SliceDepths, errorsBetweenPlanesFallFasterThanWithTheSquareOfTheirDistance)
{
    const auto casters = cloud(30, 3.0f);
    for (const bool isParallel : {true, false}) {
        std::vector<double> logSpacing, logError;
        for (const int planes : {16, 24, 32, 48, 64, 96, 128}) {
            const SliceStack stack = isParallel ? parallelStack(casters, {16, planes})
                                                : pointStack(casters, {0.2f, 0.1f, 0.0f}, {16, planes});
            logSpacing.push_back(std::log(double(stack.spacing)));
            logError.push_back(std::log(errorBetweenPlanes(stack, casters)));
        }
        double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
        for (size_t i = 0; i < logError.size(); ++i) {
            n += 1.0;
            sx += logSpacing[i];
            sy += logError[i];
            sxx += logSpacing[i] * logSpacing[i];
            sxy += logSpacing[i] * logError[i];
        }
        EXPECT_GT((n * sxy - sx * sy) / (n * sxx - sx * sx), 2.2) << isParallel;
    }
}

TEST(SliceDepths, aLightInsideABallShinesUndimmedWhereItIs)
{
    const MediumCaster ball{{0.5f, 1.0f, -2.0f}, 1.5f, 4.0f};
    const std::vector<MediumCaster> casters{ball};
    for (const glm::vec3& offset : {glm::vec3(0.0f), glm::vec3(0.4f, -0.3f, 0.7f)}) {
        const glm::vec3 light = ball.center + offset;
        const SliceDepths depths = filled(pointStack(casters, light, {64, 64}), casters);
        EXPECT_EQ(depths.depthAt(light).toLight, 0.0f);
        // the light that a ring of air of all distances gets, in all directions: mean of T along rays
        double got = 0.0, wanted = 0.0;
        constexpr int kDirections = 200, kSteps = 100;
        for (int i = 0; i < kDirections; ++i) {
            const double z = 1.0 - 2.0 * (i + 0.5) / kDirections;
            const double turn = 2.399963229728653 * i, across = std::sqrt(1.0 - z * z);
            const glm::dvec3 d(across * std::cos(turn), across * std::sin(turn), z);
            for (int s = 0; s < kSteps; ++s) {
                const glm::dvec3 p = glm::dvec3(light) + d * (3.0 * (s + 0.5) / kSteps);
                got += std::exp(-double(depths.depthAt(glm::vec3(p)).toLight));
                wanted += std::exp(-exactDepth(casters, glm::dvec3(light), p));
            }
        }
        EXPECT_NEAR(got / wanted, 1.0, 1e-3);
    }
}

TEST(SliceDepths, mediaWithinWhatGlowsTakeNothingFromItsLight)
{
    const std::vector<MediumCaster> casters{{{0.0f, 0.0f, 0.0f}, 1.0f, 2.0f}};
    const SliceDepths depths = filled(pointStack(casters, glm::vec3(0.0f), {32, 32}, 0.4f), casters);
    EXPECT_EQ(depths.depthAt({0.0f, 0.3f, 0.0f}).toLight, 0.0f);
    EXPECT_NEAR(double(depths.depthAt({0.0f, 2.0f, 0.0f}).toLight),
                exactDepth(casters, {0.0, 0.4, 0.0}, {0.0, 2.0, 0.0}), 1e-5);
}

TEST(SliceDepths, aBorderOfOneTexelGoesOnAcrossTheFoldOfTheMap)
{
    const auto casters = cloud(20, 3.0f, {0.0f, 0.0f, -1.0f});
    const SliceStack stack = pointStack(casters, {0.0f, 0.0f, 0.2f}, {32, 8});
    const SliceDepths depths = filled(stack, casters);
    for (int k = 0; k < 8; ++k)
        for (int i = 1; i < 31; ++i) { // the other side of a fold is the mirrored place of the same edge
            EXPECT_NEAR(depths.at(k, 0, i), depths.at(k, 1, 31 - i), 1e-5f) << k << " " << i;
            EXPECT_NEAR(depths.at(k, 31, i), depths.at(k, 30, 31 - i), 1e-5f) << k << " " << i;
            EXPECT_NEAR(depths.at(k, i, 0), depths.at(k, 31 - i, 1), 1e-5f) << k << " " << i;
            EXPECT_NEAR(depths.at(k, i, 31), depths.at(k, 31 - i, 30), 1e-5f) << k << " " << i;
        }
}

TEST(SliceDepths, interpolationIsContinuousInEveryDirection)
{
    const auto casters = cloud(20, 3.0f);
    const SliceDepths depths = filled(pointStack(casters, {0.1f, 0.0f, 0.2f}, {16, 8}), casters);
    const auto at = [&](const glm::dvec3& d) {
        return double(depths.depthAt(depths.stack().origin + 1.3f * glm::vec3(glm::normalize(d))).toLight);
    };
    // circles through all folds of the map; a jump stays where steps become smaller, a slope does not
    double coarse = 0.0, fine = 0.0;
    for (int circle = 0; circle < 24; ++circle) {
        const double tilt = std::numbers::pi * circle / 24.0;
        const glm::dvec3 a(std::cos(tilt), std::sin(tilt), 0.0), b(0.0, 0.0, 1.0);
        for (int i = 0; i < 2000; ++i) {
            const double t = 2.0 * std::numbers::pi * i / 2000.0;
            const auto place = [&](double u) { return at(a * std::cos(u) + b * std::sin(u)); };
            coarse = std::max(coarse, std::abs(place(t + 1e-2) - place(t)));
            fine = std::max(fine, std::abs(place(t + 1e-4) - place(t)));
        }
    }
    EXPECT_GT(coarse, 1e-3);
    EXPECT_LT(fine, 0.03 * coarse);
    EXPECT_EQ(at({0, 0, -1}), at({1e-30, 0, -1})) << "all corners of the map are one direction";
}

TEST(SliceStack, placesAreThoseOfTheRays)
{
    const auto casters = cloud(20, 1.0f);
    const SliceStack stacks[] = {parallelStack(casters, {40, 9}, {1e5, -2e4, 7e3}),
                                 pointStack(casters, {0.5f, 3.0f, 0.2f}, {40, 9})};
    for (const SliceStack& stack : stacks)
        for (uint32_t i = 0; i < 200; ++i) {
            const auto u = fx::base::randomUnit4(5, 0, i, fx::base::RandomPurpose::Position);
            const float x = 1.0f + 38.0f * u[0], y = 1.0f + 38.0f * u[1];
            const double plane = 0.1 + 7.8 * double(u[2]);
            const SlicePlace place = stack.placeOf(glm::vec3(pointOf(stack, x, y, plane)));
            EXPECT_NEAR(place.x, x, 2e-4f);
            EXPECT_NEAR(place.y, y, 2e-4f);
            EXPECT_NEAR(double(place.plane), plane, 1e-5);
        }
}

TEST(SliceStack, allMediaLieWithinItsPlanes)
{
    for (const SliceResolution& size : {SliceResolution{8, 2}, {16, 3}, {24, 5}, {64, 32}, {512, 128}}) {
        const auto casters = cloud(50, 1.0f, {3.0f, -2.0f, 8.0f});
        const glm::vec3 light(3.0f, -2.0f, 8.1f); // within the media
        for (const SliceStack& stack :
             {parallelStack(casters, size, {10.3, 20.7, -4.1}), pointStack(casters, light, size),
              pointStack(casters, {3, 2, 8}, size), pointStack(casters, {9, 0, 8}, size)})
            for (const MediumCaster& caster : casters) {
                const SlicePlace place = stack.placeOf(caster.center);
                const float deep = caster.radius / stack.spacing;
                EXPECT_LE(place.plane + deep, float(stack.resolution.planes - 1) * 1.00001f);
                EXPECT_GE(place.plane - (stack.origin == light ? 0.0f : deep), -1e-4f);
                if (stack.mapping != SliceMapping::Parallel)
                    continue;
                const float wide = caster.radius / stack.texel;
                EXPECT_GE(std::min(place.x, place.y) - wide, 0.999f);
                EXPECT_LE(std::max(place.x, place.y) + wide, float(size.texels) - 0.999f + 1e-3f);
            }
    }
}

/// Offset of a world place from the nearest texel and plane.
glm::dvec3 phaseOf(const SliceStack& stack, const glm::dvec3& eye)
{
    const glm::dvec3 corner = eye + glm::dvec3(stack.origin);
    const auto part = [&](const glm::vec3& axis, float side) {
        const double x = glm::dot(corner, glm::dvec3(axis)) / double(side);
        return x - std::round(x);
    };
    return {part(stack.right, stack.texel), part(stack.up, stack.texel), part(stack.along, stack.spacing)};
}

TEST(SliceStack, texelsAndPlanesStayWhereTheyAreInTheWorld)
{
    const auto still = cloud(30, 1.0f);
    const SliceStack first = parallelStack(still, {64, 32});
    for (int i = 0; i < 200; ++i) {
        // the balls drift by less than a texel, and the eye moves freely
        const glm::vec3 drift = 0.9f * first.texel * std::sin(0.1f * float(i)) * glm::vec3(0.5f, 0.4f, 0.3f);
        const glm::dvec3 eye(7.0 * i * 0.01, 1.0 * i * 0.013, 3.0 - 0.02 * i);
        auto casters = still;
        for (MediumCaster& caster : casters)
            caster.center = glm::vec3(glm::dvec3(caster.center + drift) - eye);
        const SliceStack stack = parallelStack(casters, {64, 32}, eye);
        ASSERT_EQ(stack.texel, first.texel);
        ASSERT_EQ(stack.spacing, first.spacing);
        const glm::dvec3 phase = phaseOf(stack, eye);
        ASSERT_LT(std::max({std::abs(phase.x), std::abs(phase.y), std::abs(phase.z)}), 1e-3) << i;
    }
}

TEST(SliceFades, sidesThatGoToAndFroFadeBackFromWhereTheyAre)
{
    SliceFades fades(std::pmr::new_delete_resource());
    SliceStack small, large;
    large.texel = small.texel * std::exp2(0.25f);
    const auto next = [&](const SliceStack& wanted) {
        fades.begin(false);
        return fades.next(wanted);
    };
    // the weight of the large sides, however they are called
    const auto weightOfLarge = [&](const SliceFade& fade) {
        return fade.now.texel == large.texel ? 1.0f - fade.weight : fade.weight;
    };
    EXPECT_EQ(next(small).weight, 0.0f);
    float last = 0.0f;
    for (int i = 0; i < 200; ++i) {
        const float weight = weightOfLarge(next(i / 5 % 2 == 0 ? large : small));
        ASSERT_LE(std::abs(weight - last), 1.001f / float(kFadeFrames)) << i;
        last = weight;
    }
}

TEST(SliceStack, withoutSnappingItFollowsTheMedia)
{
    auto casters = cloud(30, 1.0f);
    SliceStack first, second;
    ASSERT_TRUE(fitParallelSlices(kTowards, casters, glm::dvec3(0.0), {64, 32}, first, {false}));
    for (MediumCaster& caster : casters)
        caster.center += glm::vec3(0.01f, 0.02f, 0.03f);
    ASSERT_TRUE(fitParallelSlices(kTowards, casters, glm::dvec3(0.0), {64, 32}, second, {false}));
    EXPECT_NEAR(glm::length(second.origin - first.origin - glm::vec3(0.01f, 0.02f, 0.03f)), 0.0f, 1e-4f);
}

TEST(SliceStack, noPlanesNoShadowAndOnePlaneIsDefined)
{
    const auto casters = cloud(10, 2.0f);
    SliceStack stack;
    EXPECT_FALSE(fitParallelSlices(kTowards, casters, glm::dvec3(0.0), {64, 0}, stack));
    EXPECT_FALSE(fitPointSlices(glm::vec3(0.0f), 0.1f, casters, glm::dvec3(0.0), {64, 0}, stack));
    EXPECT_FALSE(fitParallelSlices(kTowards, {}, glm::dvec3(0.0), {64, 32}, stack));
    EXPECT_FALSE(fitPointSlices(glm::vec3(0.0f), 0.1f, {}, glm::dvec3(0.0), {64, 32}, stack));
    for (const bool isParallel : {true, false}) {
        const SliceStack one =
            isParallel ? parallelStack(casters, {16, 1}) : pointStack(casters, {0.0f, 4.0f, 0.0f}, {16, 1});
        EXPECT_EQ(one.resolution.planes, kMinSlicePlanes);
        const SliceDepths depths = filled(one, casters);
        const SliceDepth behind =
            depths.depthAt(isParallel ? -9.0f * kTowards : glm::vec3(0.0f, -9.0f, 0.0f));
        EXPECT_TRUE(std::isfinite(behind.toLight) && std::isfinite(behind.total));
        EXPECT_GT(behind.total, 0.0f);
        EXPECT_EQ(behind.toLight, behind.total);
    }
}
