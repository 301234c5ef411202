#include "foundation/time/step_clock.h"
#include "simulation/fragments/fragments_solver.h"
#include "tests/foundation/real_threads.h"
#include "tests/simulation/fragments/fragment_burst.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

/// Hashes of the picture every ten steps.
std::vector<uint64_t> history(std::unique_ptr<base::TaskRunner> tasks, uint64_t seed = 1)
{
    Stage stage(std::move(tasks));
    sim::InstanceStart start;
    start.seed = seed;
    stage.add(start, grounded(burst(500)));
    std::vector<uint64_t> hashes;
    for (int i = 0; i < 6; ++i) {
        stage.play(10);
        hashes.push_back(stage.look().hash());
    }
    return hashes;
}

uint64_t hashAtOneSecond(double frameSeconds)
{
    Stage stage;
    stage.add({}, grounded(burst(40)));
    base::StepClock clock(kStep, base::kTicksPerSecond / 10);
    while (stage.now() < base::kTicksPerSecond) {
        const base::StepPlan plan = clock.advance(frameSeconds);
        for (uint32_t i = 0; i < plan.steps && stage.now() < base::kTicksPerSecond; ++i)
            stage.step();
    }
    return stage.look().hash();
}

/// A solver stepped by hand, so that its state can be taken out and put back.
class Hand
{
public:
    explicit Hand(const sim::FragmentsDef& def) : solver_(def, base::KindId{}, &memory_), scratch_(&memory_)
    {}

    void play(int steps)
    {
        for (int i = 0; i < steps; ++i) {
            const sim::StepContext context{now_,           kStep,        7,         0,
                                           {0, -9.81f, 0}, {1, 0, 0},    0.0f,      nullptr,
                                           &parameters_,   tasks_.get(), &scratch_, &counters_};
            solver_.step(context);
            scratch_.reset();
            now_ += kStep;
        }
    }
    std::vector<std::byte> save() const
    {
        sim::StateBuffer buffer(std::pmr::get_default_resource());
        solver_.save(buffer);
        return {buffer.bytes().begin(), buffer.bytes().end()};
    }
    base::Status restore(std::span<const std::byte> bytes, base::Ticks now)
    {
        now_ = now;
        sim::StateReader reader(bytes);
        solver_.restore(reader);
        reader.require(reader.left() == 0, "bytes are left over");
        return reader.status();
    }
    base::Ticks now() const { return now_; }

private:
    base::HostMemory memory_;
    sim::FragmentsSolver solver_;
    base::Arena scratch_;
    sim::InstanceParameters parameters_;
    sim::StepCounters counters_;
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    base::Ticks now_ = 0;
};

} // namespace

TEST(FragmentsState, everyThreadCountGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(7);
    const std::vector<uint64_t> want = history(base::makeSerialRunner());
    for (const uint32_t threads : {1u, 2u, 3u, 7u})
        EXPECT_EQ(history(base::makeTbbRunner(threads)), want) << threads;
    EXPECT_NE(history(base::makeSerialRunner(), 2), want);
}

TEST(FragmentsState, everyFrameRateGivesTheSameBits)
{
    const uint64_t want = hashAtOneSecond(1.0 / 60.0);
    for (const double rate : {24.0, 30.0, 90.0, 144.0, 1000.0})
        EXPECT_EQ(hashAtOneSecond(1.0 / rate), want) << rate;
}

TEST(FragmentsState, savedAndRestoredItGivesTheSameBits)
{
    const auto def = burst(50);
    for (const int before : {0, 1, 30}) {
        Hand original(*def);
        original.play(before);
        Hand copy(*def);
        const auto bytes = original.save();
        ASSERT_TRUE(copy.restore(bytes, original.now()).ok());
        EXPECT_EQ(copy.save(), bytes);
        original.play(40);
        copy.play(40);
        EXPECT_EQ(copy.save(), original.save()) << before;
    }
}

TEST(FragmentsState, damagedStatesAreRefusedOrHarmless)
{
    const auto def = burst(8);
    Hand original(*def);
    original.play(20);
    const auto bytes = original.save();
    for (size_t length = 0; length < bytes.size(); length += 7)
        EXPECT_FALSE(Hand(*def).restore(std::span(bytes).first(length), original.now()).ok()) << length;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        auto damaged = bytes;
        damaged[i] ^= std::byte{0xFF};
        Hand copy(*def);
        if (copy.restore(damaged, original.now()).ok())
            copy.play(3);
    }
}
