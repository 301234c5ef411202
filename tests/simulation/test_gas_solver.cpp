#include "simulation/sph/gas_def.h"
#include "simulation/sph/gas_release.h"
#include "simulation/sph/gas_solver.h"
#include "tests/simulation/stage.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace blob = base::blob_column;

namespace {

std::unique_ptr<sim::GasDef> fireball(uint32_t particles = 200)
{
    auto def = std::make_unique<sim::GasDef>();
    def->particles = particles;
    def->position = {0, 20, 0};
    return def;
}

/// Nothing but pressure and viscosity.
std::unique_ptr<sim::GasDef> pureGas(uint32_t particles)
{
    auto def = fireball(particles);
    def->drag = def->braking = def->buoyancy = def->rolling = def->curlStrength = 0.0f;
    def->cooling = def->radiation = 0.0f;
    return def;
}

/// What the gas looks like as a whole.
struct Shape
{
    explicit Shape(const base::SnapshotGroup& group)
    {
        const double count = group.count();
        for (uint32_t i = 0; i < group.count(); ++i) {
            center += glm::dvec3(row(group, blob::PositionX, i)) / count;
            momentum += glm::dvec3(row(group, blob::VelocityX, i));
            meanSpeed += double(glm::length(row(group, blob::VelocityX, i))) / count;
            temperature += double(group.column(blob::Temperature)[i]) / count;
        }
        for (uint32_t i = 0; i < group.count(); ++i) {
            const glm::dvec3 away = glm::dvec3(row(group, blob::PositionX, i)) - center;
            radius += glm::dot(away, away) / count;
        }
        radius = std::sqrt(radius * 5.0 / 3.0); // of a uniform ball
    }
    static glm::vec3 row(const base::SnapshotGroup& group, size_t column, uint32_t i)
    {
        return {group.column(column)[i], group.column(column + 1)[i], group.column(column + 2)[i]};
    }

    glm::dvec3 center{0.0};
    glm::dvec3 momentum{0.0}; ///< over the particle mass
    double meanSpeed = 0;
    double temperature = 0;
    double radius = 0;
};

Shape shapeOf(Stage& stage)
{
    return Shape(stage.look().group(0));
}

void expectFinite(Stage& stage)
{
    const base::SnapshotGroup& group = stage.look().group(0);
    for (size_t c = 0; c < blob::Count; ++c)
        for (const float value : group.column(c))
            ASSERT_TRUE(std::isfinite(value)) << base::kBlobColumns[c].name;
}

} // namespace

TEST(GasSolver, pressureConservesMomentum)
{
    Stage stage;
    stage.add({}, pureGas(300));
    stage.play(30);
    const Shape shape = shapeOf(stage);
    EXPECT_GT(shape.meanSpeed, 5.0);
    EXPECT_LT(glm::length(shape.momentum), 1e-5 * 300.0 * shape.meanSpeed);
}

TEST(GasSolver, compressedGasExpandsAndBalancedGasStays)
{
    Stage compressed;
    compressed.add({}, pureGas(200));
    compressed.play(12);
    EXPECT_GT(shapeOf(compressed).radius, 2.5);

    Stage balanced;
    auto def = pureGas(200);
    def->pressureRatio = 1.0f;
    balanced.add({}, std::move(def));
    balanced.play(12);
    EXPECT_LT(shapeOf(balanced).radius, 1.6); // a little: its particles are not placed in perfect balance
}

TEST(GasSolver, aMetreOfHotGasMakesAFireballOfSeveralMetresThatRises)
{
    Stage stage;
    stage.add({}, fireball(270));
    stage.play(3);
    EXPECT_LT(shapeOf(stage).radius, 3.2);
    stage.play(9);
    const Shape ball = shapeOf(stage);
    EXPECT_GT(ball.radius, 3.0);
    EXPECT_GT(ball.temperature, 1800.0);
    stage.play(24);
    const Shape rolling = shapeOf(stage);
    EXPECT_GT(rolling.radius, 3.5);
    EXPECT_LT(rolling.radius, 6.0);
    stage.play(54);
    const Shape cloud = shapeOf(stage);
    EXPECT_GT(cloud.center.y, ball.center.y + 2.0);
    EXPECT_LT(cloud.temperature, 1100.0);
}

TEST(GasSolver, everyParticleCoolsAndTheCloudOnlyRises)
{
    Stage stage;
    stage.add({}, fireball());
    stage.step();
    std::vector<float> last(200, 1e9f);
    double height = 0;
    for (int i = 0; i < 120; ++i) {
        stage.step();
        const base::SnapshotGroup& group = stage.look().group(0);
        const auto temperature = group.column(blob::Temperature);
        for (uint32_t k = 0; k < group.count(); ++k) {
            ASSERT_LE(temperature[k], last[k]);
            ASSERT_GE(temperature[k], sim::kAirTemperature);
            last[k] = temperature[k];
        }
        const double now = Shape(group).center.y;
        ASSERT_GE(now, height);
        height = now;
    }
}

TEST(GasSolver, theGroundSpreadsItSideways)
{
    Stage stage;
    auto effect = std::make_shared<sim::EffectDef>();
    auto def = fireball();
    def->position = {0, 1, 0};
    effect->solvers.push_back(std::move(def));
    stage.add({}, effect);
    stage.play(12);
    const base::SnapshotGroup& group = stage.look().group(0);
    double wide = 0;
    double below = 1e9;
    for (uint32_t i = 0; i < group.count(); ++i) {
        const glm::vec3 p = Shape::row(group, blob::PositionX, i);
        wide = std::max(wide, double(std::hypot(p.x, p.z)));
        below = std::min(below, double(p.y));
    }
    EXPECT_GT(below, 0.0);
    EXPECT_GT(wide, 3.0);
}

TEST(GasSolver, aLoneParticleFliesStraight)
{
    Stage stage;
    auto def = pureGas(1);
    def->initialBias = {3, 1, -2};
    def->jitter = 0.0f;
    stage.add({}, std::move(def));
    stage.step();
    const glm::vec3 first = Shape::row(stage.look().group(0), blob::PositionX, 0);
    stage.play(60);
    const glm::vec3 then = Shape::row(stage.look().group(0), blob::PositionX, 0);
    EXPECT_LT(glm::length(then - first - glm::vec3(3, 1, -2)), 5e-5f);
}

TEST(GasSolver, theWindCarriesItAlong)
{
    Stage stage;
    auto def = pureGas(1);
    def->drag = 20.0f;
    sim::InstanceStart start;
    start.parameters.wind = {3, 0, -1};
    stage.add(start, std::move(def));
    stage.play(60);
    const glm::vec3 velocity = Shape::row(stage.look().group(0), blob::VelocityX, 0);
    EXPECT_LT(glm::length(velocity - glm::vec3(3, 0, -1)), 1e-4f);
}

TEST(GasSolver, speedIsLimitedAndTheLimitReported)
{
    Stage stage;
    auto def = pureGas(20);
    def->buoyancy = 1e5f;
    const float fastest = 20.0f * def->soundSpeed;
    stage.add({}, std::move(def));
    stage.play(10);
    for (uint32_t i = 0; i < 20; ++i)
        EXPECT_LE(glm::length(Shape::row(stage.look().group(0), blob::VelocityX, i)), 1.001f * fastest);
    EXPECT_GT(stage.counters().clamped, 0u);
}

TEST(GasSolver, coincidentParticlesStayFinite)
{
    Stage stage;
    auto def = fireball(64);
    def->radius = 1e-20f;
    def->jitter = 0.0f;
    stage.add({}, std::move(def));
    stage.play(30);
    expectFinite(stage);
}

TEST(GasSolver, extremePresetsStayFiniteAndBounded)
{
    for (const float wild : {1e3f, 1e6f, 1e12f}) {
        Stage stage;
        auto def = fireball(64);
        def->pressureRatio = wild;
        def->soundSpeed = wild;
        def->curlStrength = wild;
        def->viscosity = 4.0f;
        stage.add({}, std::move(def));
        stage.play(5);
        expectFinite(stage);
        EXPECT_LE(stage.counters().subSteps, 5u * sim::kMostGasSubSteps);
        EXPECT_EQ(stage.counters().clamped > 0, wild > 1e4f); // what could not be simulated is reported
    }
}

TEST(GasSolver, stepsOfEveryLengthStayFinite)
{
    for (const base::Ticks ticks : {base::Ticks(1), base::kTicksPerSecond / 1000, base::kTicksPerSecond / 15,
                                    base::kTicksPerSecond, 100 * base::kTicksPerSecond})
    {
        Stage stage;
        auto def = fireball(64);
        def->dissipation = 0.0f;
        stage.add({}, std::move(def));
        for (int i = 0; i < 3; ++i)
            stage.step(ticks);
        expectFinite(stage);
    }
}

TEST(GasSolver, startsAtItsTimeWithinAStep)
{
    Stage stage;
    auto def = fireball(50);
    def->start = 2.5f / 60.0f;
    const sim::Slot slot = stage.add({}, std::move(def));
    stage.play(2);
    EXPECT_EQ(stage.world().elementCount(slot), 0u);
    EXPECT_FALSE(stage.world().finished(slot, stage.now()));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 50u);
    EXPECT_NEAR(stage.look().group(0).column(blob::Age)[0], 0.5f / 60.0f, 1e-6f);
}

TEST(GasSolver, aReleaseWithinAStepMovesOnlyForTheRestOfIt)
{
    Stage whole;
    Stage half;
    for (const auto& [stage, start] : {std::pair{&whole, 0.0f}, std::pair{&half, 0.5f / 60.0f}}) {
        auto def = pureGas(1);
        def->initialBias = {60, 0, 0};
        def->jitter = 0.0f;
        def->start = start;
        stage->add({}, std::move(def));
        stage->step();
    }
    const float way =
        whole.look().group(0).column(blob::PositionX)[0] - half.look().group(0).column(blob::PositionX)[0];
    EXPECT_NEAR(way, 0.5f, 1e-5f);
}

TEST(GasSolver, isNeverReleasedWhenNothingNewIsWanted)
{
    Stage stage;
    sim::InstanceStart start;
    start.parameters.emitting = false;
    const sim::Slot slot = stage.add(start, fireball(50));
    stage.step();
    EXPECT_EQ(stage.world().elementCount(slot), 0u);
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
}

TEST(GasSolver, intensityMakesTheBlastStronger)
{
    const auto radiusAt = [](float intensity) {
        Stage stage;
        sim::InstanceStart start;
        start.parameters.intensity = intensity;
        stage.add(start, fireball());
        stage.play(12);
        return shapeOf(stage).radius;
    };
    EXPECT_GT(radiusAt(2.0f), 1.1 * radiusAt(0.5f));
}

TEST(GasSolver, smokeDissolvesToNothingWithoutASuddenEnd)
{
    Stage stage;
    auto def = fireball(30);
    def->dissipation = 2.0f;
    const sim::Slot slot = stage.add({}, std::move(def));
    double last = 0;
    for (int i = 0; i < 1200 && !stage.world().finished(slot, stage.now()); ++i) {
        stage.step();
        if (stage.look().group(0).count() == 0)
            break;
        last = 0;
        for (const float sigma : stage.look().group(0).column(blob::CrossSection))
            last += double(sigma) / 30.0;
    }
    EXPECT_TRUE(stage.world().finished(slot, stage.now()));
    EXPECT_LT(last, 0.01); // of 1.4 m2 at its thickest
}

TEST(GasSolver, opticsStartAsAFlameOfTheWantedDepthAndEndAsSoot)
{
    Stage stage;
    auto def = fireball(100);
    def->opticalDepth = 2.0f;
    def->sootYield = 3.0f;
    def->dissipation = 0.0f;
    const double radius = double(def->growth) * double(sim::releaseSmoothing(*def));
    stage.add({}, std::move(def));
    stage.step();
    const base::SnapshotGroup& flame = stage.look().group(0);
    EXPECT_NEAR(double(flame.column(blob::CrossSection)[0]), 2.0 * 3.14159265 * radius * radius / 3.5, 1e-4);
    EXPECT_EQ(flame.column(blob::FireShare)[0], 1.0f);
    stage.play(480);
    const base::SnapshotGroup& smoke = stage.look().group(0);
    EXPECT_NEAR(smoke.column(blob::CrossSection)[0], 3.0f, 1e-3f);
    EXPECT_EQ(smoke.column(blob::FireShare)[0], 0.0f);
}

TEST(GasSolver, boundsHoldEveryBlobWithItsRadius)
{
    Stage stage;
    stage.add({}, fireball());
    stage.play(20);
    const base::SnapshotGroup& group = stage.look().group(0);
    for (uint32_t i = 0; i < group.count(); ++i)
        for (size_t a = 0; a < 3; ++a) {
            const float p = group.column(blob::PositionX + a)[i];
            ASSERT_LE(group.info().bounds.min[int(a)], p - group.column(blob::Radius)[i]);
            ASSERT_GE(group.info().bounds.max[int(a)], p + group.column(blob::Radius)[i]);
        }
}
