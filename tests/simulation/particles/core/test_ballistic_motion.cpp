#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace column = base::particle_column;
namespace blob = base::blob_column;

namespace {

struct Flight
{
    double x, y, vx, vy;
};

/// The exact solution of dv/dt = g - k (v - u), in double.
Flight exactFlight(double speed, double g, double k, double u, double t)
{
    const double e = std::exp(-k * t);
    const double gain = k > 0 ? -std::expm1(-k * t) / k : t;
    const double z = k * t;
    const double series = t * t * (0.5 - z / 6.0 + z * z / 24.0); // where the quotient cancels
    const double ramp = z < 1e-3 ? series : (t - gain) / k;
    return {u * (t - gain), speed * gain + g * ramp, u * (1.0 - e), speed * e + g * gain};
}

std::unique_ptr<sim::EmitterDef> thrown(float drag)
{
    auto def = burstEmitter(1);
    def->shape = sim::EmitterShape::Box; // heads up
    def->speed = {12.0f, 12.0f};
    def->forces.drag = drag;
    def->forces.wind = {3.0f, 0.0f, 0.0f};
    return def;
}

} // namespace

TEST(BallisticMotion, isTheExactSolutionForAnyDragAndAge)
{
    for (const float drag : {0.0f, 1e-4f, 0.03f, 0.5f, 0.99f, 1.01f, 4.0f, 60.0f, 1e5f}) {
        Stage stage;
        stage.add({}, thrown(drag));
        for (int i = 1; i <= 200; ++i) {
            stage.step();
            const base::SnapshotGroup& group = stage.look().group(0);
            const Flight want = exactFlight(12.0, -9.80665, double(drag), 3.0, i / 60.0);
            const double size = 1.0 + std::abs(want.x) + std::abs(want.y) + 50.0 * i / 60.0;
            ASSERT_NEAR(group.column(blob::PositionX)[0], want.x, 1.5e-6 * size) << drag << " " << i;
            ASSERT_NEAR(group.column(blob::PositionY)[0], want.y, 1.5e-6 * size) << drag << " " << i;
            ASSERT_NEAR(group.column(blob::VelocityX)[0], want.vx, 1e-5) << drag << " " << i;
            ASSERT_NEAR(group.column(blob::VelocityY)[0], want.vy, 4e-5) << drag << " " << i;
        }
    }
}

TEST(BallisticMotion, equalsIntegratingStepByStep)
{
    Stage closed, stepped;
    auto def = thrown(0.7f);
    def->emission.bursts = {{0.0f, 100}};
    def->shape = sim::EmitterShape::Sphere;
    def->size = {1, 0, 0};
    closed.add({}, std::move(def));
    auto same = thrown(0.7f);
    same->emission.bursts = {{0.0f, 100}};
    same->shape = sim::EmitterShape::Sphere;
    same->size = {1, 0, 0};
    same->modules.push_back(std::make_shared<Idle>());
    stepped.add({}, std::move(same));
    closed.play(120);
    stepped.play(120);
    const base::SnapshotGroup& a = closed.look().group(0);
    const base::SnapshotGroup& b = stepped.look().group(0);
    ASSERT_EQ(a.count(), 100u);
    ASSERT_EQ(b.count(), 100u);
    for (uint32_t i = 0; i < 100; ++i)
        for (size_t c = 0; c < 6; ++c)
            ASSERT_NEAR(a.column(c)[i], b.column(c)[i], 5e-5) << i << " " << c;
}

TEST(BallisticMotion, goesOnSmoothlyWhenTheWindTurns)
{
    Stage stage;
    const sim::Slot slot = stage.add({}, thrown(2.0f));
    stage.play(30);
    const Flight first = exactFlight(12.0, -9.80665, 2.0, 3.0, 0.5);
    sim::InstanceParameters parameters;
    parameters.wind = {-5.0f, 0.0f, 0.0f};
    stage.world().setParameters(slot, parameters);
    stage.play(30);
    const base::SnapshotGroup& group = stage.look().group(0);
    const double gain = -std::expm1(-1.0) / 2.0;
    EXPECT_NEAR(group.column(blob::PositionX)[0], first.x + first.vx * gain - 2.0 * (0.5 - gain), 1e-4);
    EXPECT_NEAR(group.column(blob::VelocityX)[0], first.vx * std::exp(-1.0) - 2.0 * (1 - std::exp(-1.0)),
                1e-4);
    EXPECT_NEAR(group.column(blob::Age)[0], 1.0f, 1e-6f);
}
