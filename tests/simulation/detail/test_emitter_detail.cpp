// The coordinates that particles of an emitter carry.
#include "simulation/emitters/emitter_detail.h"
#include "tests/simulation/detail/detail_stage.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

using namespace fx;
using namespace fx::test;

namespace {

/// A stream along +Y that nothing brakes, with generations that are born twice a second.
std::unique_ptr<sim::EmitterDef> stream(bool detailed = true)
{
    auto def = rateEmitter(120.0f, 1.5f);
    def->shape = sim::EmitterShape::Cone;
    def->speed = {3.0f, 3.0f};
    def->forces.gravity = 0.0f;
    def->detail.given = detailed;
    return def;
}

} // namespace

TEST(EmitterDetail, leavesWhatWasThereBeforeAsItIs)
{
    const auto turbulent = [](bool detailed) {
        auto def = stream(detailed);
        def->forces.curlStrength = 0.7f;
        def->forces.drag = 1.0f;
        return def;
    };
    Stage plain, detailed;
    plain.add({}, turbulent(false));
    detailed.add({}, turbulent(true));
    for (int i = 0; i < 4; ++i) {
        plain.play(30);
        detailed.play(30);
        const DetailGroups before(plain.look()), with(detailed.look());
        EXPECT_EQ(before.material, nullptr);
        ASSERT_NE(with.material, nullptr);
        EXPECT_EQ(allOf(*before.blobs, base::blob_column::Count),
                  allOf(*with.blobs, base::blob_column::Count));
        EXPECT_EQ(with.material->count(), with.blobs->count());
    }
}

TEST(EmitterDetail, aSteadyStreamIsAStraightLineOfCoordinates)
{
    Stage stage;
    const auto def = stream();
    const base::Ticks period = sim::EmitterDetail::periodOf(*def);
    stage.add({}, stream());
    stage.play(200);
    const DetailGroups now(stage.look());
    ASSERT_GT(now.blobs->count(), 100u);
    for (const uint32_t generation : {now.younger() - 1, now.younger()}) {
        const double since = base::toSeconds(stage.now() - (base::Ticks(generation) - 1) * period);
        for (size_t i = 0; i < now.blobs->count(); ++i) {
            const glm::vec3 want = now.position(i) - float(since) * now.velocity(i);
            EXPECT_LT(glm::length(now.place(generation, i) - want), 1e-3f) << i;
        }
    }
}

TEST(EmitterDetail, aCoordinateStaysWhileTheGenerationAndTheParticleLive)
{
    Stage stage;
    auto def = stream();
    def->forces.curlStrength = 2.0f;
    def->forces.drag = 3.0f;
    stage.add({}, std::move(def));
    stage.play(50);
    uint32_t births = 0;
    for (int step = 0; step < 60; ++step) {
        const DetailGroups before(stage.look());
        const uint32_t younger = before.younger();
        std::vector<std::pair<uint64_t, glm::vec3>> places;
        for (size_t i = 0; i < before.blobs->count(); ++i)
            places.emplace_back(before.material->ids()[i], before.place(younger, i));
        stage.play(1);
        const DetailGroups now(stage.look());
        births += now.younger() - younger;
        size_t found = 0;
        for (size_t i = 0; i < now.blobs->count(); ++i)
            for (const auto& [id, place] : places)
                if (id == now.material->ids()[i]) {
                    EXPECT_EQ(now.place(younger, i), place);
                    ++found;
                }
        EXPECT_GT(found, places.size() / 2);
    }
    EXPECT_GE(births, 2u);
}

TEST(EmitterDetail, aJumpInTimeGivesTheSameCoordinatesAsSteps)
{
    Stage stepped, jumped;
    stepped.add({}, stream());
    const sim::Slot slot = jumped.add({}, stream());
    stepped.play(100);
    sim::StepCounters counters;
    ASSERT_TRUE(jumped.world().seekTo(slot, 100 * kStep, kStep, counters));
    const DetailGroups want(stepped.look()), got(jumped.look());
    ASSERT_GT(want.blobs->count(), 50u);
    EXPECT_EQ(allOf(*got.blobs, base::blob_column::Count), allOf(*want.blobs, base::blob_column::Count));
    EXPECT_EQ(allOf(*got.material, column::Count), allOf(*want.material, column::Count));
}

TEST(EmitterDetail, turbulenceRenewsItSooner)
{
    auto def = stream();
    const base::Ticks calm = sim::EmitterDetail::periodOf(*def);
    EXPECT_EQ(calm, base::toTicks(2.0));
    def->forces.curlStrength = 0.9f;
    def->forces.curlScale = 3.0f;
    EXPECT_NEAR(base::toSeconds(sim::EmitterDetail::periodOf(*def)), 0.5 / (4.4 * 0.3), 1e-6);
    def->detail.liveliness = 2.0f;
    EXPECT_NEAR(base::toSeconds(sim::EmitterDetail::periodOf(*def)), 0.25 / (4.4 * 0.3), 1e-6);
    def->forces.curlStrength = 1e6f;
    EXPECT_NEAR(base::toSeconds(sim::EmitterDetail::periodOf(*def)), 1.0 / sim::kMaxGenerationRate, 1e-6);
}
