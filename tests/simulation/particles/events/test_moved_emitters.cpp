#include "tests/simulation/particles/events/moved.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace fx;
using namespace fx::sim;
using namespace fx::test;
using base::kTicksPerSecond;

namespace {

/// Normal binary16 numbers.
std::array<float, 3> rgbOf(uint64_t color)
{
    std::array<float, 3> rgb{};
    for (size_t i = 0; i < 3; ++i) {
        const uint32_t bits = uint32_t(color >> (16 * i)) & 0xFFFFu;
        rgb[i] = std::ldexp(1.0f + float(bits & 0x3FFu) / 1024.0f, int(bits >> 10 & 31u) - 15);
    }
    return rgb;
}

} // namespace

TEST(MovedEmitters, birthsLieEvenlyAlongTheWayAndStayThere)
{
    Stage stage;
    const Slot slot = stage.add({}, dropper(600));
    stage.step(1);                  // begins at the origin
    for (int i = 1; i <= 30; ++i) { // 12 m/s
        stage.world().setPlacement(slot, at(0.2 * i));
        stage.step();
    }
    std::vector<double> x;
    for (const glm::dvec3& p : worldPositions(stage.look()))
        x.push_back(p.x);
    ASSERT_GE(x.size(), 299u);
    std::sort(x.begin(), x.end());
    for (size_t i = 1; i < x.size(); ++i)
        ASSERT_NEAR(x[i] - x[i - 1], 0.02, 2e-5) << i; // 12 m/s over 600/s
    EXPECT_GE(x.front(), 0.0);
    EXPECT_LE(x.back(), 6.0);
}

TEST(MovedEmitters, particlesInLocalSpaceMoveWithTheInstance)
{
    Stage stage;
    auto def = dropper(600);
    def->inWorld = false;
    const Slot slot = stage.add({}, std::move(def));
    stage.play(5);
    stage.world().setPlacement(slot, at(3.0));
    stage.step();
    for (const glm::dvec3& p : worldPositions(stage.look()))
        EXPECT_EQ(p.x, 3.0);
}

TEST(MovedEmitters, inheritTheirShareOfTheVelocityOfTheInstance)
{
    for (const float share : {0.0f, 0.25f, 1.0f}) {
        Stage stage;
        auto def = dropper(0);
        def->emission.rate = 0;
        def->emission.bursts = {{0.5f / 60.0f, 1}}; // in the middle of the first step
        def->inheritVelocity = share;
        const Slot slot = stage.add({}, std::move(def));
        stage.step(1); // begins at the origin
        stage.world().setPlacement(slot, at(0, 0.1, 0));
        stage.step(kStep - 1);
        for (int i = 0; i < 60; ++i) // the instance stands
            stage.step();
        const auto seen = worldPositions(stage.look());
        ASSERT_EQ(seen.size(), 1u);
        EXPECT_NEAR(seen[0].y, 0.05 + double(share) * 6.0 * (60.5 / 60.0), 2e-4); // 0.1 m in a step are 6 m/s
    }
}

TEST(MovedEmitters, anInstanceThatStandsComesOutAsInLocalSpaceBitForBit)
{
    const auto statesOf = [](bool inWorld) {
        Stage stage;
        auto def = spriteEmitter(700, {0.5f, 1.5f});
        def->inWorld = inWorld;
        def->inheritVelocity = inWorld ? 1.0f : 0.0f;
        InstanceStart start;
        start.placement = turnedAboutZ(0.7f);
        start.placement.position = {1000.1, -3, 7};
        stage.add(start, std::move(def));
        stage.play(90);
        std::vector<float> values;
        for (const Seen& seen : particlesOf(stage.look(), 0))
            values.insert(values.end(), {seen.position.x, seen.position.y, seen.position.z, seen.age});
        return values;
    };
    EXPECT_EQ(statesOf(true), statesOf(false));
}

TEST(MovedEmitters, fallStraightDownInTheWorldHoweverTheInstanceIsTurned)
{
    for (const bool integrated : {false, true}) {
        Stage stage;
        auto def = dropper(0);
        def->emission.rate = 0;
        def->emission.bursts = {{0, 1}};
        def->forces.gravity = 1;
        if (integrated)
            def->modules = {std::make_shared<Idle>()};
        const Slot slot = stage.add({}, std::move(def));
        stage.step();
        for (int i = 1; i <= 59; ++i) {
            stage.world().setPlacement(slot, turnedAboutZ(0.1f * float(i)));
            stage.step();
        }
        const auto seen = worldPositions(stage.look());
        ASSERT_EQ(seen.size(), 1u);
        EXPECT_NEAR(seen[0].x, 0.0, 1e-5);
        EXPECT_NEAR(seen[0].y, -0.5 * 9.80665, 1e-3);
    }
}

TEST(MovedEmitters, theWindOfThePresetIsAirAndDoesNotTurnWithTheInstance)
{
    for (const bool ofEmitter : {false, true}) {
        Stage stage;
        auto def = dropper(0);
        def->emission.rate = 0;
        def->emission.bursts = {{0, 1}};
        def->forces.drag = 1000.0f; // goes with the air
        auto effect = std::make_shared<EffectDef>();
        effect->hasGround = false;
        (ofEmitter ? def->forces.wind : effect->wind) = {2, 0, 0};
        effect->solvers.push_back(std::move(def));
        InstanceStart start;
        start.placement = turnedAboutZ(1.5707963f); // where it begins the wind blows along +Y
        const Slot slot = stage.add(start, std::shared_ptr<const EffectDef>(std::move(effect)));
        stage.step();
        for (int i = 1; i <= 59; ++i) {
            stage.world().setPlacement(slot, turnedAboutZ(1.5707963f + 0.1f * float(i)));
            stage.step();
        }
        const auto seen = worldPositions(stage.look());
        ASSERT_EQ(seen.size(), 1u);
        EXPECT_NEAR(seen[0].x, 0.0, 1e-4) << ofEmitter;
        EXPECT_NEAR(seen[0].y, 2.0, 1e-2) << ofEmitter;
    }
}

TEST(MovedEmitters, turnedBirthsHeadWhereTheInstanceHeads)
{
    Stage stage;
    auto def = dropper(60);
    def->shape = EmitterShape::Box; // heads along +Y
    def->speed = {5, 5};
    const Slot slot = stage.add({}, std::move(def));
    stage.step(1);
    stage.world().setPlacement(slot, turnedAboutZ(-1.5707963f)); // +Y points to +X
    stage.play(2);
    stage.play(60);
    double farthest = 0;
    for (const glm::dvec3& p : worldPositions(stage.look()))
        farthest = std::max(farthest, p.x);
    EXPECT_NEAR(farthest, 5.0, 0.3);
}

TEST(MovedEmitters, theSameStepsOfTheHostGiveTheSameBitsForAnyPartitionBetweenThem)
{
    const auto play = [](int parts) {
        Stage stage;
        auto def = dropper(900);
        def->speed = {0, 4};
        def->inheritVelocity = 0.5f;
        const Slot slot = stage.add({}, std::move(def));
        stage.step(1);
        for (int i = 1; i <= 20; ++i) {
            for (int k = 1; k <= parts; ++k) { // the scene spreads a move over the steps
                const double share = double(k) / double(parts);
                stage.world().setPlacement(slot, at(0.25 * (double(i) - 1.0 + share)));
                stage.step(kStep / parts);
            }
        }
        return worldPositions(stage.look());
    };
    const auto once = play(1), often = play(4);
    ASSERT_EQ(once.size(), often.size());
    for (size_t i = 0; i < once.size(); ++i) // the way is the same; where it is cut is only rounded otherwise
        EXPECT_LT(glm::length(once[i] - often[i]), 2e-5) << i;
}

TEST(MovedEmitters, savedStatesGoOnAlike)
{
    base::SnapshotSchema schema;
    static_cast<void>(schema.add(base::kParticleKind));
    base::HostMemory memory;
    const auto tasks = base::makeSerialRunner();
    auto effect = linkedEffect(dropper(800));
    World world(&schema, tasks.get(), &memory), other(&schema, tasks.get(), &memory);
    InstanceStart start;
    const Slot slot = world.add(effect, start);
    base::Ticks now = 0;
    const auto drive = [&](World& w, Slot s, base::Ticks from) {
        for (int i = 0; i < 20; ++i, from += kStep) {
            w.setPlacement(s, at(double(from) / double(kStep) * 0.3));
            w.step(std::array{s}, from, kStep);
        }
        return from;
    };
    now = drive(world, slot, now);
    StateBuffer state(&memory);
    world.save(std::array{slot}, state);
    StateReader reader(state.bytes());
    start.placement = at(double(now - kStep) / double(kStep) * 0.3);
    std::array<Slot, 1> slots{};
    other.restore(std::array{World::Entry{effect, start}}, reader, slots);
    ASSERT_TRUE(reader.ok()) << reader.status().message();
    other.setNow(now);
    drive(world, slot, now);
    drive(other, slots[0], now);
    EXPECT_EQ(world.hash(std::array{slot}), other.hash(slots));
}

TEST(MovedEmitters, eventsHappenWhereTheParticlesAre)
{
    auto shell = burstEmitter(1);
    shell->appearance.kind = AppearanceKind::Sprite;
    shell->inWorld = true;
    shell->forces.gravity = 0;
    shell->lifetime = {0.5f, 0.5f};
    shell->speed = {2, 2};
    shell->shape = EmitterShape::Box;
    shell->events = {ruleOf(EventKind::Death, 1)};
    auto stars = fedEmitter();
    stars->inWorld = true;
    Stage stage;
    const Slot slot = stage.add({}, linkedEffect(std::move(shell), std::move(stars)));
    stage.step();
    for (int i = 1; i <= 60; ++i) { // the host goes away
        stage.world().setPlacement(slot, at(10.0 * i));
        stage.step();
    }
    const auto seen = worldPositions(stage.look(), 1);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_NEAR(seen[0].x, 0.0, 1e-5);
    EXPECT_NEAR(seen[0].y, 1.0, 1e-4);
}

TEST(InheritedColor, multipliesThatOfThoseWhoAreBorn)
{
    for (const float share : {0.0f, 0.5f, 1.0f}) {
        auto shell = burstEmitter(1);
        shell->appearance.kind = AppearanceKind::Sprite;
        shell->lifetime = {0.5f, 0.5f};
        shell->appearance.colorOverLife = base::ColorCurve(std::array{0.25f, 0.5f, 1.0f});
        shell->events = {ruleOf(EventKind::Death, 1)};
        shell->events[0].inheritColor = share;
        auto stars = fedEmitter();
        stars->appearance.colorOverLife = base::ColorCurve(std::array{1.0f, 0.5f, 0.25f});
        stars->tinted = share > 0.0f;
        Stage stage;
        stage.add({}, linkedEffect(std::move(shell), std::move(stars)));
        stage.play(40);
        const base::FrameSnapshot& snapshot = stage.look();
        ASSERT_EQ(particlesOf(snapshot, 1).size(), 1u);
        const base::SnapshotGroup& group = snapshot.group(1);
        const auto color = rgbOf(group.column64(base::particle_column::Color)[0]);
        EXPECT_NEAR(color[0], 1.0f - 0.75f * share, 1e-3);
        EXPECT_NEAR(color[1], 0.5f * (1.0f - 0.5f * share), 1e-3);
        EXPECT_NEAR(color[2], 0.25f, 1e-3);
    }
}
