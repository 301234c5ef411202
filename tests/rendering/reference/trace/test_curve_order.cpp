/// The Hilbert curve, and the sort by it.

#include "rendering/reference/trace/curve_order.h"

#include "tests/foundation/every_set.h"
#include "tests/rendering/reference/trace/ball_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace fx::render {
namespace {

uint64_t curvePlace(uint32_t x0, uint32_t x1, uint32_t x2)
{
    CurveBatch batch;
    batch.count = 1;
    batch.cell[0][0] = x0;
    batch.cell[1][0] = x1;
    batch.cell[2][0] = x2;
    curvePlaces(batch);
    return batch.place[0];
}

/// The cells of the corner cube of 2^bits cells a side, in the order of the curve.
std::vector<std::array<int, 3>> cellsInOrder(uint32_t bits)
{
    std::vector<std::pair<uint64_t, std::array<int, 3>>> cells;
    const int side = 1 << bits;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z)
                cells.push_back({curvePlace(uint32_t(x), uint32_t(y), uint32_t(z)), {x, y, z}});
    std::sort(cells.begin(), cells.end());
    std::vector<std::array<int, 3>> order;
    for (const auto& [place, cell] : cells)
        order.push_back(cell);
    return order;
}

TEST(CurveOrder, successorsOnTheCurveAreNeighboringCells)
{
    const auto cells = cellsInOrder(5);
    for (size_t i = 1; i < cells.size(); ++i) {
        int steps = 0;
        for (size_t axis = 0; axis < 3; ++axis)
            steps += std::abs(cells[i][axis] - cells[i - 1][axis]);
        ASSERT_EQ(steps, 1) << "after place " << i;
    }
}

TEST(CurveOrder, theCornerCubeHasTheFirstPlacesOfTheCurve)
{
    uint64_t largest = 0;
    std::vector<uint64_t> places;
    for (uint32_t cell = 0; cell < 4096; ++cell)
        places.push_back(curvePlace(cell & 15, cell >> 4 & 15, cell >> 8));
    for (const uint64_t place : places)
        largest = std::max(largest, place);
    EXPECT_EQ(largest, 4095u);
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::unique(places.begin(), places.end()), places.end());
}

TEST(CurveOrder, theLastCellOfTheCubeIsAtTheEndOfTheFirstAxis)
{
    EXPECT_EQ(curvePlace(0, 0, 0), 0u);
    EXPECT_EQ(curvePlace((1u << 20) - 1, 0, 0), (uint64_t(1) << 60) - 1);
}

TEST(CurveOrder, manyPlacesAtOnceAreThePlacesOfEachForEveryInstructionSet)
{
    test::everySet([](base::InstructionSet) {
        test::Chance chance(1);
        CurveBatch batch;
        batch.count = 77;
        std::vector<uint64_t> expected;
        for (size_t i = 0; i < batch.count; ++i) {
            for (auto& column : batch.cell)
                column[i] = uint32_t(chance() * (1 << 20));
            expected.push_back(curvePlace(batch.cell[0][i], batch.cell[1][i], batch.cell[2][i]));
        }
        curvePlaces(batch);
        for (size_t i = 0; i < batch.count; ++i)
            EXPECT_EQ(batch.place[i], expected[i]);
    });
}

class SortByKey : public ::testing::TestWithParam<uint64_t>
{};

TEST_P(SortByKey, keepsTheOrderOfEqualKeysForAnyNumberOfWorkers)
{
    test::Chance chance(2);
    std::vector<KeyedIndex> elements;
    for (uint32_t i = 0; i < 50'000; ++i)
        elements.push_back({uint64_t(chance() * 300.0) * GetParam(), i});
    std::vector<KeyedIndex> expected = elements;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
    for (const uint32_t threads : {1u, 2u, 5u}) {
        auto tasks = threads == 1 ? base::makeSerialRunner() : base::makeTbbRunner(threads);
        std::vector<KeyedIndex> sorted = elements;
        std::vector<KeyedIndex> scratch;
        sortByKey(sorted, scratch, *tasks);
        for (size_t i = 0; i < sorted.size(); ++i) {
            ASSERT_EQ(sorted[i].key, expected[i].key);
            ASSERT_EQ(sorted[i].index, expected[i].index);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scales, SortByKey,
                         ::testing::Values(0, 1, 1u << 20, uint64_t(1) << 33, uint64_t(1) << 55));

} // namespace
} // namespace fx::render
