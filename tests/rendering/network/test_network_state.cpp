// Light that is kept from frame to frame, in boxes that move.
#include "rendering/network/network_state.h"

#include <gtest/gtest.h>

using namespace fx::render;

namespace {

/// 1 + 2 x - y + 3 z in the first moment, 0 in the others.
NetworkState linearState(const NetworkGrid& grid)
{
    NetworkState state{grid, 4, std::vector<float>(4 * grid.count(), 0.0f)};
    for (int k = 0; k < grid.cells.z; ++k)
        for (int j = 0; j < grid.cells.y; ++j)
            for (int i = 0; i < grid.cells.x; ++i) {
                const glm::dvec3 p = grid.middle({i, j, k});
                state.light[grid.index({i, j, k})] = float(1.0 + 2.0 * p.x - p.y + 3.0 * p.z);
            }
    return state;
}

} // namespace

TEST(NetworkState, inItsOwnGridIsItself)
{
    const NetworkState state = linearState({{-1.0, 0.5, 2.0}, 0.25, {5, 4, 3}});
    const NetworkState same = resampled(state, state.grid, 4);
    for (size_t i = 0; i < state.light.size(); ++i)
        EXPECT_NEAR(same.light[i], state.light[i], 1e-5f);
}

TEST(NetworkState, ofLightThatChangesEvenlyIsExactInAMovedFinerBox)
{
    const NetworkState state = linearState({{0.0, 0.0, 0.0}, 0.5, {8, 8, 8}});
    const NetworkGrid moved{{0.7, 0.9, 1.1}, 0.3, {7, 6, 5}};
    const NetworkState got = resampled(state, moved, 4), want = linearState(moved);
    for (size_t i = 0; i < want.light.size(); ++i)
        EXPECT_NEAR(got.light[i], want.light[i], 1e-5f);
}

TEST(NetworkState, beyondItsBoxIsThatOfTheBorderAndHasNoMomentsThatItLacks)
{
    const NetworkState state = linearState({{0.0, 0.0, 0.0}, 1.0, {2, 2, 2}});
    const NetworkState far = resampled(state, {{10.0, 10.0, 10.0}, 1.0, {1, 1, 1}}, 9);
    EXPECT_EQ(far.light.size(), 9u);
    EXPECT_EQ(far.light[0], state.light[7]);
    EXPECT_EQ(far.light[8], 0.0f);
}

TEST(NetworkState, ofNothingIsDark)
{
    const NetworkState dark = resampled({}, {{0.0, 0.0, 0.0}, 1.0, {2, 2, 2}}, 4);
    EXPECT_EQ(dark.light, std::vector<float>(32, 0.0f));
}
