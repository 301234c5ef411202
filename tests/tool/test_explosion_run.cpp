#include "benchmarks/scenes/explosion_run.h"

#include "foundation/tasks/task_runner.h"

#include <gtest/gtest.h>

namespace fx::cli {
namespace {

TEST(ExplosionRun, particlesOfTheLibrarysExplosionStayAsFarApartAsInGlass)
{
    constexpr double kGlass = 0.85; // 1 in a lattice, 0.55 where points are strewn by chance
    const auto tasks = base::makeTbbRunner(2);
    const auto run = ExplosionRun::create({5000}, *tasks);
    ASSERT_TRUE(run);
    EXPECT_EQ((*run)->nearestOverSpacing(), 0.0) << "no gas yet";
    for (int frame = 0; frame < kExplosionFrames; ++frame)
        (*run)->step();
    EXPECT_GE((*run)->nearestOverSpacing(), kGlass);
    const ExplosionState state = (*run)->look();
    EXPECT_GT(state.height, 2.0); // it rises
    EXPECT_GT(state.radius, 1.0);
    EXPECT_GT(state.temperature, 500.0);
}

} // namespace
} // namespace fx::cli
