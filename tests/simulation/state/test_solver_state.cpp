// Emitters and gases continue from a saved state as if nothing had happened, and refuse what is none.
#include "tests/simulation/busy_effect.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

/// A solver outside of any world.
struct Bench
{
    explicit Bench(const sim::SolverDef& def) : solver(def.create(schema(), {}, &memory)) {}

    static const base::SnapshotSchema& schema()
    {
        static const base::SnapshotSchema blobs = [] {
            base::SnapshotSchema made;
            made.add(base::kBlobKind);
            return made;
        }();
        return blobs;
    }

    void play(int steps)
    {
        for (int i = 0; i < steps; ++i) {
            sim::StepContext context{};
            context.tick = tick;
            context.stepTicks = kStep;
            context.seed = 9;
            context.gravity = {0, -9.8f, 0};
            context.groundHeight = 0.0f;
            context.parameters = &parameters;
            context.tasks = tasks.get();
            context.scratch = &scratch;
            context.counters = &counters;
            solver->step(context);
            scratch.reset();
            tick += kStep;
        }
    }
    std::vector<std::byte> state() const
    {
        sim::StateBuffer buffer(&memory);
        solver->save(buffer);
        return {buffer.bytes().begin(), buffer.bytes().end()};
    }
    /// @return whether the solver took it, all of it
    bool restore(std::span<const std::byte> bytes, base::Ticks at)
    {
        sim::StateReader reader(bytes);
        solver->restore(reader);
        tick = at;
        return reader.ok() && reader.left() == 0;
    }

    mutable base::HostMemory memory;
    std::unique_ptr<sim::Solver> solver;
    std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner();
    base::Arena scratch{&memory};
    sim::InstanceParameters parameters;
    sim::StepCounters counters;
    base::Ticks tick = 0;
};

} // namespace

TEST(SolverState, eachSolverContinuesBitForBitFromAnyMoment)
{
    const auto plain = busyEffect(200), detailed = busyEffect(200, true);
    for (const auto& def : {plain->solvers[0].get(), plain->solvers[1].get(), detailed->solvers[0].get(),
                            detailed->solvers[1].get()})
        for (const int before : {0, 1, 24, 25, 60}) {
            Bench original(*def);
            original.play(before);
            Bench copy(*def);
            ASSERT_TRUE(copy.restore(original.state(), original.tick)) << before;
            EXPECT_EQ(copy.solver->elementCount(), original.solver->elementCount());
            for (int k = 0; k < 30; ++k) {
                ASSERT_EQ(copy.state(), original.state()) << before << " + " << k;
                ASSERT_EQ(copy.solver->finished(copy.tick), original.solver->finished(original.tick));
                original.play(1);
                copy.play(1);
            }
        }
}

TEST(SolverState, aRestoredSolverForgetsWhatItWas)
{
    const auto effect = busyEffect(200);
    for (const auto& def : effect->solvers) {
        Bench original(*def), other(*def);
        original.play(10);
        other.play(40);
        ASSERT_TRUE(other.restore(original.state(), original.tick));
        original.play(20);
        other.play(20);
        EXPECT_EQ(other.state(), original.state());
    }
}

TEST(SolverState, everyCutIsRefused)
{
    const auto effect = busyEffect(80, true);
    for (const auto& def : effect->solvers) {
        Bench original(*def), other(*def);
        original.play(5);
        const std::vector<std::byte> state = original.state();
        for (size_t size = 0; size < state.size(); ++size)
            ASSERT_FALSE(other.restore(std::span(state).first(size), original.tick)) << size;
    }
}

TEST(SolverState, moreParticlesThanTheDefinitionAllowsAreRefused)
{
    const auto large = busyEffect(200);
    const auto small = busyEffect(40);
    for (size_t i = 0; i < large->solvers.size(); ++i) {
        Bench from(*large->solvers[i]), to(*small->solvers[i]);
        from.play(3);
        EXPECT_FALSE(to.restore(from.state(), from.tick)) << i;
    }
}

TEST(SolverState, aParticleThatIsDeadOrUnbornIsRefused)
{
    const auto def = rateEmitter(60.0f, 1.0f);
    Bench original(*def);
    original.play(70); // longer than a life
    const std::vector<std::byte> good = original.state();
    // Clock, started, begin and conditions of the motion; three words of births; window, placed and count;
    // then the particles, each beginning with its index and its birth.
    const size_t first = (8 + 1 + 8 + 12 + 4 + 1 + 1) + 3 * 8 + (8 + 8 + 1 + 4);
    const size_t count = original.solver->elementCount();
    ASSERT_GE(count, 4u);
    ASSERT_EQ((good.size() - first) % count, 0u);
    const size_t stride = (good.size() - first) / count;
    const auto with = [&](size_t at, int64_t value) {
        std::vector<std::byte> state = good;
        std::memcpy(state.data() + at, &value, sizeof value);
        Bench other(*def);
        return other.restore(state, original.tick);
    };
    int64_t index;
    std::memcpy(&index, good.data() + first, sizeof index);
    const size_t born = first + 8;
    EXPECT_TRUE(with(born, original.tick - 1));
    EXPECT_FALSE(with(born, -1));
    EXPECT_FALSE(with(born, original.tick + 1));
    EXPECT_FALSE(with(born, original.tick - base::kTicksPerSecond)); // dead
    EXPECT_FALSE(with(born, INT64_MAX));
    EXPECT_FALSE(with(first + stride, index)); // two particles of one number
    EXPECT_FALSE(with(0, -1));                 // the clock
}
