#include "foundation/random/philox.h"
#include "rendering/draw_order/depth_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

using fx::render::DepthSort;

TEST(DepthSort, putsTheFarthestFirstWithNegativesLast)
{
    DepthSort sort(std::pmr::get_default_resource());
    const std::array<float, 5> distances{3.0f, -1.0f, 7.5f, 0.0f, -2.0f};
    const auto order = sort.farthestFirst(distances);
    EXPECT_EQ(std::vector<uint32_t>(order.begin(), order.end()), (std::vector<uint32_t>{2, 0, 3, 1, 4}));
}

TEST(DepthSort, keepsTheOrderOfEqualDistances)
{
    DepthSort sort(std::pmr::get_default_resource());
    const std::vector<float> distances(1000, 4.25f);
    const auto order = sort.farthestFirst(distances);
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(DepthSort, agreesWithAStableComparisonSort)
{
    std::vector<float> distances(5000);
    for (size_t i = 0; i < distances.size(); ++i)
        distances[i] =
            std::floor(fx::base::randomUnit4(3, 0, i, fx::base::RandomPurpose::Position)[0] * 500.0f);
    std::vector<uint32_t> expected(distances.size());
    std::iota(expected.begin(), expected.end(), 0u);
    std::stable_sort(expected.begin(), expected.end(),
                     [&](uint32_t a, uint32_t b) { return distances[a] > distances[b]; });
    DepthSort sort(std::pmr::get_default_resource());
    const auto order = sort.farthestFirst(distances);
    EXPECT_TRUE(std::equal(order.begin(), order.end(), expected.begin(), expected.end()));
}

TEST(DepthSort, ofNothingIsNothing)
{
    DepthSort sort(std::pmr::get_default_resource());
    EXPECT_TRUE(sort.farthestFirst({}).empty());
}

TEST(DepthSort, mendingTheLastOrderGivesTheSameAsSortingAnew)
{
    const auto unit = [](uint64_t stream, size_t i) {
        return fx::base::randomUnit4(stream, 0, i, fx::base::RandomPurpose::Position)[0];
    };
    std::vector<float> distances(3000);
    for (size_t i = 0; i < distances.size(); ++i)
        distances[i] = std::floor(unit(1, i) * 400.0f) - 20.0f; // many are equally far
    DepthSort mended(std::pmr::get_default_resource());
    (void)mended.farthestFirst(distances);
    for (uint64_t frame = 2; frame < 60; ++frame) {
        const size_t step = frame % 5 == 0 ? 3 : 40 + frame; // now and then too many to mend
        for (size_t i = size_t(frame); i < distances.size(); i += step)
            distances[i] =
                unit(frame, i) < 0.3f ? DepthSort::kAbsent : std::floor(unit(frame, i) * 400.0f) - 20.0f;
        DepthSort anew(std::pmr::get_default_resource());
        const auto a = mended.farthestFirst(distances);
        const auto b = anew.farthestFirst(distances);
        ASSERT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << "frame " << frame;
        if (frame % 5 != 0) {
            EXPECT_LT(mended.sortedElements(), distances.size() / 4) << "frame " << frame;
        }
    }
}

TEST(DepthSort, absentElementsAreLeftOutAndBothWaysAreReversed)
{
    DepthSort sort(std::pmr::get_default_resource());
    const std::array<float, 5> distances{3.0f, DepthSort::kAbsent, 7.5f, 0.0f, DepthSort::kAbsent};
    const auto far = sort.farthestFirst(distances);
    EXPECT_EQ(std::vector<uint32_t>(far.begin(), far.end()), (std::vector<uint32_t>{2, 0, 3}));
    sort.forget();
    const auto near = sort.nearestFirst(distances);
    EXPECT_EQ(std::vector<uint32_t>(near.begin(), near.end()), (std::vector<uint32_t>{3, 0, 2}));
}

TEST(DepthSort, aFewThatMoveInALongListAreMendedInPlace)
{
    const auto unit = [](uint64_t stream, size_t i) {
        return fx::base::randomUnit4(stream, 0, i, fx::base::RandomPurpose::Position)[0];
    };
    std::vector<float> distances(20000);
    for (size_t i = 0; i < distances.size(); ++i)
        distances[i] = std::floor(unit(1, i) * 9000.0f); // some are equally far
    DepthSort mended(std::pmr::get_default_resource());
    (void)mended.farthestFirst(distances);
    for (size_t frame = 2; frame < 12; ++frame) {
        const size_t stride = size_t(20) << (frame % 6); // one in so many, some side by side in the order
        for (size_t i = frame; i < distances.size(); i += stride)
            distances[i] = frame % 3 == 0 ? distances[i] + 1.0f : std::floor(unit(frame, i) * 9000.0f);
        if (frame % 4 == 1)
            distances[frame * 100] = DepthSort::kAbsent;
        DepthSort anew(std::pmr::get_default_resource());
        const auto want = anew.farthestFirst(distances);
        const auto order = mended.farthestFirst(distances);
        EXPECT_TRUE(std::equal(order.begin(), order.end(), want.begin(), want.end())) << frame;
        EXPECT_LT(mended.sortedElements(), 3 * distances.size() / stride + 50) << frame;
    }
}

TEST(DepthSort, aFewThatMoveWhileAllComeNearerAreMendedToo)
{
    const auto unit = [](uint64_t stream, size_t i) {
        return fx::base::randomUnit4(stream, 0, i, fx::base::RandomPurpose::Position)[0];
    };
    std::vector<float> distances(20011); // no whole number of vectors
    for (size_t i = 0; i < distances.size(); ++i)
        distances[i] = std::floor(unit(1, i) * 9000.0f);
    DepthSort mended(std::pmr::get_default_resource());
    (void)mended.farthestFirst(distances);
    for (size_t frame = 2; frame < 14; ++frame) {
        const size_t stride = size_t(20) << (frame % 6);
        for (float& distance : distances)
            distance -= 1.0f;
        for (size_t i = frame; i < distances.size(); i += stride)
            distances[i] = frame % 3 == 0 ? distances[i] + 2.0f : std::floor(unit(frame, i) * 9000.0f);
        distances[frame * 100] = frame % 2 == 0 ? DepthSort::kAbsent : 17.0f;
        distances[(frame - 1) * 100] = 4000.0f; // the absent come back
        DepthSort anew(std::pmr::get_default_resource());
        const auto want = anew.farthestFirst(distances);
        const auto order = mended.farthestFirst(distances);
        EXPECT_TRUE(std::equal(order.begin(), order.end(), want.begin(), want.end())) << frame;
        EXPECT_LT(mended.sortedElements(), 3 * distances.size() / stride + 50) << frame;
    }
}

TEST(DepthSort, whatStandsStillIsNotSortedAgain)
{
    DepthSort sort(std::pmr::get_default_resource());
    std::vector<float> distances{3.0f, DepthSort::kAbsent, 7.5f, 0.0f};
    (void)sort.farthestFirst(distances);
    EXPECT_EQ(sort.sortedElements(), 3u);
    const auto again = sort.farthestFirst(distances);
    EXPECT_EQ(std::vector<uint32_t>(again.begin(), again.end()), (std::vector<uint32_t>{2, 0, 3}));
    EXPECT_EQ(sort.sortedElements(), 0u);
    distances[1] = 5.0f;
    const auto joined = sort.farthestFirst(distances);
    EXPECT_EQ(std::vector<uint32_t>(joined.begin(), joined.end()), (std::vector<uint32_t>{2, 1, 0, 3}));
    EXPECT_EQ(sort.sortedElements(), 1u);
}
