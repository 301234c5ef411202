#include "simulation/particles/forces/force_ops.h"
#include "tests/foundation/every_set.h"
#include "tests/simulation/particles/modules/tile_stage.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;

namespace {

/// A grid whose vectors are m p + c.
std::shared_ptr<FieldGrid> linearGrid(const glm::uvec3& nodes)
{
    auto grid = std::make_shared<FieldGrid>();
    grid->nodes = nodes;
    grid->channels = 3;
    grid->low = {-1, -2, -3};
    grid->cell = {0.5f, 1.0f, 0.25f};
    for (uint32_t z = 0; z < nodes.z; ++z)
        for (uint32_t y = 0; y < nodes.y; ++y)
            for (uint32_t x = 0; x < nodes.x; ++x) {
                const glm::vec3 p = grid->low + grid->cell * glm::vec3(x, y, z);
                for (const float value : {2.0f * p.x - p.y + 1.0f, p.z + 0.5f * p.x, 3.0f * p.y - 2.0f})
                    grid->values.push_back(value);
            }
    return grid;
}

} // namespace

TEST(Gusts, areSmoothBoundedAndAveragedToNothing)
{
    double mean = 0, most = 0, steepest = 0;
    constexpr int kPeriods = 4000, kParts = 64;
    float before = gustNoise(3, 1, 0.0, 0);
    for (int i = 1; i <= kPeriods * kParts; ++i) {
        const float value = gustNoise(3, 1, double(i) / kParts, 0);
        mean += double(value) / (kPeriods * kParts);
        most = std::max(most, double(std::abs(value)));
        steepest = std::max(steepest, double(std::abs(value - before)) * kParts);
        before = value;
    }
    EXPECT_LE(most, 1.0);
    EXPECT_GT(most, 0.99);
    EXPECT_LT(std::abs(mean),
              3.5 / std::sqrt(3.0 * kPeriods)); // 3.5 deviations of uniform numbers in [-1, 1]
    EXPECT_LE(steepest, 1.875 * 2.0 * 1.001);   // the fade's steepest slope times the largest difference
}

TEST(Gusts, dependOnTimeAloneAndDifferByAxisAndSeed)
{
    EXPECT_EQ(gustNoise(3, 1, 12.25, 1), gustNoise(3, 1, 12.25, 1));
    EXPECT_NE(gustNoise(3, 1, 12.25, 1), gustNoise(3, 1, 12.25, 2));
    EXPECT_NE(gustNoise(3, 1, 12.25, 1), gustNoise(4, 1, 12.25, 1));
    EXPECT_NE(gustNoise(3, 1, 12.25, 1), gustNoise(3, 2, 12.25, 1));
}

TEST(Gusts, areAddedToTheAir)
{
    TileStage stage(20);
    const auto op = makeGustOp({{2, 0, -4}, 0.5f});
    stage.context.begin = 1.3;
    stage.begin(0.1f);
    stage.run(*op);
    const glm::vec3 want(2.0f * gustNoise(7, 0, 1.35 / 0.5, 0), 0.0f, -4.0f * gustNoise(7, 0, 1.35 / 0.5, 2));
    EXPECT_LT(glm::length(stage.air(19) - want), 1e-5f);
}

TEST(Vortex, airTurnsLikeARigidBodyInsideAndAsOneOverRadiusOutside)
{
    VortexDef def;
    def.position = {1, 0, 0};
    def.axis = {0, 3, 0};
    def.radius = 2.0f;
    def.speed = 5.0f;
    def.lift = 1.5f;
    def.pull = 0.5f;
    TileStage stage(3);
    stage.place(0, {3, 7, 0}, {});       // at the radius
    stage.place(1, {1.002f, -3, 0}, {}); // near the axis
    stage.place(2, {1, 0, 200}, {});     // far away
    stage.begin(0.1f);
    stage.run(*makeVortexOp(def));
    EXPECT_LT(glm::length(stage.air(0) - glm::vec3(-0.5f, 0.75f, -5.0f)), 1e-5f); // y x x = -z
    EXPECT_NEAR(stage.air(1).z / 0.002f, -5.0f, 0.01f);                           // 2 S / R
    EXPECT_NEAR(stage.air(1).y, 1.5f, 1e-4f);
    EXPECT_NEAR(stage.air(2).x, 5.0f * 2.0f * 2.0f / 200.0f, 1e-4f);
    EXPECT_EQ(stage.acceleration(0), glm::vec3(0.0f));
}

TEST(Vortex, aHeldParticleKeepsItsCircleAndItsSpeedForLongSteps)
{
    for (const float step : {1e-3f, 1.0f / 60.0f, 0.1f, 0.5f}) {
        VortexDef def;
        def.position = {1, 2, 3};
        def.axis = {1, 1, 0};
        def.hold = 1.0f;
        const auto op = makeVortexOp(def);
        const glm::vec3 axis = glm::normalize(def.axis), out = {0, 0, 1}, turn = glm::cross(axis, out);
        TileStage stage;
        stage.place(0, def.position + 2.0f * out, 3.0f * turn + 0.1f * axis);
        for (int i = 0; i < 1000; ++i) {
            stage.begin(step);
            stage.run(*op);
            stage.fly();
        }
        const glm::vec3 way = stage.position() - def.position;
        const float along = glm::dot(way, axis);
        EXPECT_NEAR(glm::length(way - along * axis), 2.0f, 2e-3f) << step;
        EXPECT_NEAR(glm::length(stage.velocity() - 0.1f * axis), 3.0f, 2e-3f) << step;
        EXPECT_NEAR(along / (100.0f * step), 1.0f, 5e-3f) << step;
    }
}

TEST(Vortex, aHeldParticleTurnsAtTheRightRate)
{
    VortexDef def;
    def.hold = 1.0f;
    const auto op = makeVortexOp(def);
    TileStage stage;
    stage.place(0, {2, 0, 0}, {0, 0, -3}); // turns once in 2 pi 2 / 3 s
    const int steps = 2000;
    for (int i = 0; i < steps; ++i) {
        stage.begin(float(4.0 * std::numbers::pi / 3.0 / steps));
        stage.run(*op);
        stage.fly();
    }
    EXPECT_LT(glm::length(stage.position() - glm::vec3(2, 0, 0)), 1e-3f);
}

TEST(Attractor, keepsEnergyInEachOfItsFields)
{
    for (const Falloff falloff :
         {Falloff::Spring, Falloff::Constant, Falloff::Inverse, Falloff::InverseSquare}) {
        AttractorDef def;
        def.position = {0.5f, -1, 2};
        def.strength = 4.0f;
        def.radius = 1.5f;
        def.falloff = falloff;
        def.softening = 0.3f;
        const auto op = makeAttractorOp(def);
        // The potential whose slope the acceleration is, with s^2 = d^2 + e^2.
        const auto energy = [&](const TileStage& stage) {
            const double s = std::sqrt(
                double(glm::dot(stage.position() - def.position, stage.position() - def.position)) + 0.09);
            const double potential = falloff == Falloff::Spring     ? 0.5 * s * s / 1.5
                                     : falloff == Falloff::Constant ? s
                                     : falloff == Falloff::Inverse  ? 1.5 * std::log(s)
                                                                    : -2.25 / s;
            return 0.5 * double(glm::dot(stage.velocity(), stage.velocity())) + 4.0 * potential;
        };
        TileStage stage;
        stage.place(0, {2, -1, 2}, {0.3f, 1.2f, -0.4f});
        const double before = energy(stage);
        for (int i = 0; i < 4000; ++i) { // leapfrog: half a kick, drift, half a kick
            const float t = 1.0f / 1000.0f;
            stage.begin(t);
            stage.run(*op);
            const glm::vec3 half = stage.velocity() + 0.5f * t * stage.acceleration();
            stage.place(0, stage.position() + t * half, half);
            stage.begin(t);
            stage.run(*op);
            stage.place(0, stage.position(), half + 0.5f * t * stage.acceleration());
        }
        EXPECT_NEAR(energy(stage), before, 2e-4 * std::abs(before) + 2e-3) << int(falloff);
    }
}

TEST(Attractor, hasItsStrengthAtItsRadiusAndEndsAtItsReach)
{
    for (const Falloff falloff :
         {Falloff::Spring, Falloff::Constant, Falloff::Inverse, Falloff::InverseSquare}) {
        AttractorDef def;
        def.strength = 3.0f;
        def.radius = 2.0f;
        def.falloff = falloff;
        def.reach = 5.0f;
        TileStage stage(4);
        stage.place(0, {0, 2, 0}, {});
        stage.place(1, {0, 4, 0}, {});
        stage.place(2, {5.1f, 0, 0}, {});
        stage.place(3, {0, 0, 0}, {});
        stage.begin(0.1f);
        stage.run(*makeAttractorOp(def));
        EXPECT_NEAR(stage.acceleration(0).y, -3.0f, 1e-5f);
        EXPECT_NEAR(stage.acceleration(1).y, -3.0f * std::pow(0.5f, float(int(falloff) - 1)), 1e-5f);
        EXPECT_EQ(stage.acceleration(2), glm::vec3(0.0f));
        EXPECT_EQ(stage.acceleration(3), glm::vec3(0.0f));
    }
}

TEST(VectorField, isExactForLinearFieldsAndNothingOutside)
{
    VectorFieldDef def;
    def.grid = linearGrid({5, 4, 9});
    def.position = {10, 20, 30};
    def.scale = 2.0f;
    def.strength = 0.5f;
    TileStage stage(100);
    for (uint32_t i = 0; i < 100; ++i) {
        const glm::vec3 share(float(i % 5) / 4.0f, float(i % 7) / 6.0f, float(i % 11) / 10.0f);
        stage.place(i, def.position + 2.0f * (def.grid->low + share * (def.grid->high() - def.grid->low)),
                    {});
    }
    stage.place(99, {12.1f, 20, 30}, {}); // outside along x
    for (const bool isAcceleration : {false, true}) {
        def.isAcceleration = isAcceleration;
        stage.begin(0.1f);
        stage.run(*makeVectorFieldOp(def));
        for (uint32_t i = 0; i < 99; ++i) {
            const glm::vec3 p = (stage.position(i) - def.position) / 2.0f;
            const glm::vec3 want =
                0.5f * glm::vec3(2.0f * p.x - p.y + 1.0f, p.z + 0.5f * p.x, 3.0f * p.y - 2.0f);
            EXPECT_LT(glm::length((isAcceleration ? stage.acceleration(i) : stage.air(i)) - want), 2e-5f)
                << i;
        }
        EXPECT_EQ(stage.air(99) + stage.acceleration(99), glm::vec3(0.0f));
    }
}

TEST(VectorField, anAxisOfOneNodeIsTheSameEverywhere)
{
    auto grid = std::make_shared<FieldGrid>();
    grid->channels = 3;
    grid->values = {1, 2, 3};
    VectorFieldDef def;
    def.grid = grid;
    TileStage stage(2);
    stage.place(1, {1e6f, -1e6f, 3}, {});
    stage.begin(0.1f);
    stage.run(*makeVectorFieldOp(def));
    EXPECT_EQ(stage.air(0), glm::vec3(1, 2, 3));
    EXPECT_EQ(stage.air(1), glm::vec3(1, 2, 3));
}

TEST(Conform, particlesComeToRestOnTheSurfaceForAnyStep)
{
    for (const SurfaceKind kind : {SurfaceKind::Sphere, SurfaceKind::Box})
        for (const float step : {1.0f / 240.0f, 1.0f / 30.0f, 1.0f, 50.0f}) {
            ConformDef def;
            def.kind = kind;
            def.position = {3, 0, 0};
            def.size = {2, 1, 1.5f};
            def.distance = 0.25f;
            def.stiffness = 40.0f;
            def.damping = 8.0f;
            const auto op = makeConformOp(def);
            TileStage stage(3);
            stage.place(0, {5.6f, 0, 0},
                        {}); // along normals: what moves sideways would go on around the surface
            stage.place(1, {3.4f, 0.1f, -0.05f}, {});
            stage.place(2, {3, -3, 0}, {});
            for (int i = 0; i < std::max(int(20.0f / step), 400); ++i) {
                stage.begin(step);
                stage.run(*op);
                stage.fly();
            }
            for (uint32_t i = 0; i < 3; ++i) {
                const glm::vec3 p = stage.position(i) - def.position;
                const glm::vec3 q = glm::max(glm::abs(p) - def.size, glm::vec3(0.0f));
                const float distance = kind == SurfaceKind::Sphere ? glm::length(p) - 2.0f : glm::length(q);
                EXPECT_NEAR(distance, 0.25f, 1e-3f) << int(kind) << " " << step << " " << i;
            }
        }
}

TEST(Conform, isADampedSpringAlongTheNormal)
{
    // x'' = -k x - c x' with k = 25, c = 2: x = exp(-t) (cos(w t) + sin(w t) / w), w^2 = 24.
    ConformDef def;
    def.stiffness = 25.0f;
    def.damping = 2.0f;
    const auto op = makeConformOp(def);
    TileStage stage;
    stage.place(0, {0, 0, 2}, {}); // 1 m above the unit sphere
    const float t = 1e-4f;
    for (int i = 0; i < 10000; ++i) {
        stage.begin(t);
        stage.run(*op);
        stage.fly();
    }
    const double w = std::sqrt(24.0), want = std::exp(-1.0) * (std::cos(w) + std::sin(w) / w);
    EXPECT_NEAR(double(stage.position().z) - 1.0, want, 2e-3);
}

TEST(Conform, endsAtItsReach)
{
    ConformDef def;
    def.stiffness = 1.0f;
    def.reach = 0.5f;
    TileStage stage(2);
    stage.place(0, {0, 1.4f, 0}, {});
    stage.place(1, {0, 1.6f, 0}, {});
    stage.begin(0.01f);
    stage.run(*makeConformOp(def));
    EXPECT_LT(stage.acceleration(0).y, -0.3f);
    EXPECT_EQ(stage.acceleration(1), glm::vec3(0.0f));
}

TEST(Forces, giveTheSameBitsWithEveryInstructionSet)
{
    AttractorDef attractor;
    attractor.strength = 2.0f;
    VortexDef vortex;
    vortex.speed = 3.0f;
    vortex.hold = 0.7f;
    VectorFieldDef field;
    field.grid = linearGrid({5, 4, 9});
    ConformDef conform;
    conform.kind = SurfaceKind::Box;
    conform.stiffness = 5.0f;
    std::vector<std::unique_ptr<TileOp>> ops;
    ops.push_back(makeAttractorOp(attractor));
    ops.push_back(makeVortexOp(vortex));
    ops.push_back(makeVectorFieldOp(field));
    ops.push_back(makeConformOp(conform));
    const auto play = [&] {
        TileStage stage(200);
        for (uint32_t i = 0; i < 200; ++i)
            stage.place(i, {std::sin(float(i)), 0.01f * float(i), std::cos(2.0f * float(i))},
                        {0.1f, 0, 0.2f});
        for (int k = 0; k < 50; ++k) {
            stage.begin(0.01f);
            for (const auto& op : ops)
                stage.run(*op);
            stage.fly();
        }
        std::vector<float> all(stage.tile->x, stage.tile->x + 200);
        all.insert(all.end(), stage.tile->vz, stage.tile->vz + 200);
        all.insert(all.end(), stage.tile->ux, stage.tile->ux + 200);
        return all;
    };
    const std::vector<float> want = play();
    test::everySet([&](base::InstructionSet) { EXPECT_EQ(play(), want); });
}
