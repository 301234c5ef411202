// Who is simulated when not everything can be.
#include "tests/api/sight_stage.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;
using activation::Candidate;
using scene::InstanceState;
using scene::Reason;

namespace {

std::vector<uint32_t> granted(const activation::Budget& budget, std::vector<Candidate> candidates)
{
    activation::share(budget, 100.0, candidates);
    std::vector<uint32_t> keys;
    for (const Candidate& candidate : candidates)
        if (candidate.granted)
            keys.push_back(candidate.key);
    return keys;
}

} // namespace

TEST(Budget, theMostSignificantAreGrantedAndEqualsInOrderOfCreation)
{
    activation::Budget budget;
    budget.particles = 250;
    EXPECT_EQ(granted(budget, {{5, 2, 100, 0, 2}, {9, 3, 100, 0, 3}, {5, 1, 100, 0, 1}}),
              (std::vector<uint32_t>{3, 1}));
}

TEST(Budget, thoseWhoMustAreServedFirstAndTheMostSignificantAlways)
{
    activation::Budget budget;
    budget.particles = 50;
    EXPECT_EQ(granted(budget, {{9, 0, 100, 0, 0}, {1, 1, 100, 0, 1, false, true}}),
              (std::vector<uint32_t>{1}));
    EXPECT_EQ(granted(budget, {{9, 0, 100, 0, 0}, {8, 1, 10, 0, 1}}), (std::vector<uint32_t>{0}));
}

TEST(Budget, millisecondsAndBytesLimitAsParticlesDo)
{
    activation::Budget time, memory;
    time.milliseconds = 0.025; // 250 particles of 100 ns
    memory.bytes = 1000;
    const std::vector<Candidate> three{{3, 0, 100, 400, 0}, {2, 1, 100, 400, 1}, {1, 2, 100, 400, 2}};
    EXPECT_EQ(granted(time, three), (std::vector<uint32_t>{0, 1}));
    EXPECT_EQ(granted(memory, three), (std::vector<uint32_t>{0, 1}));
}

TEST(Budget, whoRunsGivesWayOnlyToWhatIsAQuarterMoreSignificant)
{
    activation::Budget budget;
    budget.particles = 100;
    EXPECT_EQ(granted(budget, {{10, 0, 100, 0, 0, true}, {12, 1, 100, 0, 1}}), (std::vector<uint32_t>{0}));
    EXPECT_EQ(granted(budget, {{10, 0, 100, 0, 0, true}, {13, 1, 100, 0, 1}}), (std::vector<uint32_t>{1}));
}

TEST(Budget, theNearestStayWhateverTheOrderOfCreationAndPriorityDecidesOtherwise)
{
    SightStage stage;
    std::vector<scene::LocalId> ids;
    for (int i = 0; i < 6; ++i)
        ids.push_back(stage.add(toyEffect({true, 10}), {0, 0, -40.0 + 5 * i}, uint64_t(i)));
    activation::Budget budget;
    budget.particles = 30;
    stage.look(0);
    stage.scene().setBudget(budget);
    stage.play(3);
    for (int i = 0; i < 6; ++i)
        EXPECT_EQ(stage.state(ids[size_t(i)]), i >= 3 ? InstanceState::Active : InstanceState::Hidden) << i;
    EXPECT_EQ(stage.reason(ids[0]), Reason::Budget);
    EXPECT_EQ(stage.scene().lastUpdate().denied, 3u);
    stage.scene().setHints(ids[0], {100, 0, false});
    stage.play(2);
    EXPECT_EQ(stage.state(ids[0]), InstanceState::Active);
    EXPECT_EQ(stage.state(ids[3]), InstanceState::Hidden);
    stage.scene().setBudget({});
    stage.play(2);
    EXPECT_EQ(stage.scene().counters().active, 6u);
}

TEST(Budget, twoThatPassEachOtherSlowlyChangePlacesOnce)
{
    SightStage stage;
    const auto a = stage.add(toyEffect({true, 10}), {-1, 0, -20}, 1);
    const auto b = stage.add(toyEffect({true, 10}), {1, 0, -20}, 2);
    activation::Budget budget;
    budget.particles = 10;
    stage.look(0);
    stage.scene().setBudget(budget);
    int changes = 0;
    InstanceState before = InstanceState::Active;
    for (int k = 0; k < 300; ++k) { // they wobble by a tenth while one of them comes nearer
        base::Placement placement;
        placement.position = {-1, 0, -20 - 1.0 * (k % 2)};
        stage.scene().setPlacement(a, placement);
        placement.position = {1, 0, -25 + 0.04 * k - 1.0 * (k % 3 == 0)};
        stage.scene().setPlacement(b, placement);
        stage.play(1);
        changes += k > 0 && stage.state(a) != before ? 1 : 0;
        before = stage.state(a);
    }
    EXPECT_EQ(changes, 1);
    EXPECT_EQ(stage.state(b), InstanceState::Active);
}

TEST(Budget, costGrowsWithTheBudgetAndWithWhatIsInSight)
{
    uint64_t before = 0;
    for (uint64_t particles = 10; particles <= 100; particles += 10) {
        SightStage stage;
        for (uint64_t i = 0; i < 10; ++i)
            stage.add(toyEffect({true, 10}), {0, 0, -20.0 - double(i)}, i);
        activation::Budget budget;
        budget.particles = particles;
        stage.look(0);
        stage.scene().setBudget(budget);
        stage.play(10);
        const uint64_t steps = stage.scene().counters().work.particleSteps;
        EXPECT_GT(steps, before);
        before = steps;
    }
}

TEST(Budget, equalCallsGiveEqualAnswers)
{
    std::vector<uint64_t> hashes[2];
    for (auto& run : hashes) {
        SightStage stage;
        std::vector<scene::LocalId> ids;
        for (uint64_t i = 0; i < 30; ++i)
            ids.push_back(
                stage.add(toyEffect({i % 2 == 0, 7}), {double(i % 7) - 3, 0, -15.0 - double(i % 5)}, i));
        activation::Budget budget;
        budget.milliseconds = 0.01;
        budget.nanosecondsPerParticle = 100;
        stage.scene().setBudget(budget);
        for (int k = 0; k < 60; ++k) {
            stage.look(0.02 * k);
            stage.play(1);
            uint64_t states = 0;
            for (const scene::LocalId id : ids)
                states = base::hashWord(states, uint64_t(stage.state(id)));
            run.push_back(states);
        }
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}
