#include "simulation/emitters/emitter_solver.h"
#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

using namespace fx;
using namespace fx::test;

namespace {

/// A solver without a world.
class Lone
{
public:
    explicit Lone(const sim::EmitterDef& def)
        : solver_(def, {schema().find("blob"), schema().find("particle")}, &memory_)
    {}

    void step(base::Ticks ticks) { solver_.step(context(now_, ticks)), scratch_.reset(), now_ += ticks; }
    bool seek(base::Ticks tick)
    {
        const sim::StepContext c = context(now_, 0);
        if (!solver_.canSeek(c, tick))
            return false;
        solver_.seek(c, tick);
        now_ = tick;
        scratch_.reset();
        return true;
    }
    uint64_t published()
    {
        base::FrameSnapshot snapshot(&schema(), &memory_);
        snapshot.begin(now_, 1);
        solver_.publish({}, snapshot);
        return snapshot.hash();
    }
    uint64_t state() const
    {
        sim::StateHasher hasher;
        solver_.save(hasher);
        return hasher.hash();
    }
    sim::EmitterSolver& solver() { return solver_; }
    base::Ticks now() const { return now_; }

private:
    static const base::SnapshotSchema& schema()
    {
        static const base::SnapshotSchema kinds = [] {
            base::SnapshotSchema s;
            s.add(base::kBlobKind);
            s.add(base::kParticleKind);
            return s;
        }();
        return kinds;
    }
    sim::StepContext context(base::Ticks tick, base::Ticks ticks)
    {
        sim::StepContext c{};
        c.tick = tick;
        c.stepTicks = ticks;
        c.seed = 12;
        c.gravity = {0, -9.80665f, 0};
        c.groundHeight = -1e9f;
        c.parameters = &parameters_;
        c.tasks = tasks_.get();
        c.scratch = &scratch_;
        c.counters = &counters_;
        return c;
    }

    base::HostMemory memory_;
    base::Arena scratch_{&memory_};
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    sim::InstanceParameters parameters_;
    sim::StepCounters counters_;
    sim::EmitterSolver solver_;
    base::Ticks now_ = 0;
};

/// Publications and states after each of `steps` steps.
std::vector<std::pair<uint64_t, uint64_t>> play(const sim::EmitterDef& def, int steps)
{
    Lone lone(def);
    std::vector<std::pair<uint64_t, uint64_t>> seen;
    for (int i = 0; i < steps; ++i) {
        lone.step(kStep);
        seen.emplace_back(lone.published(), lone.state());
    }
    return seen;
}

} // namespace

TEST(EmitterSeek, anyJumpEqualsPlayingBitForBit)
{
    auto roomy = spriteEmitter(400.0f, {0.3f, 1.1f});
    auto crowded = spriteEmitter(400.0f, {0.3f, 1.1f});
    crowded->maxParticles = 150; // births are dropped: who lives depends on all who came before
    crowded->emission.bursts = {{0.2f, 60}, {0.9f, 90}};
    auto longLived = spriteEmitter(50.0f, {2.0f, 9.0f});
    for (const auto* def : {roomy.get(), crowded.get(), longLived.get()}) {
        constexpr int kSteps = 300;
        const auto want = play(*def, kSteps);
        Lone lone(*def);
        uint32_t random = 1;
        for (int jump = 0; jump < 350; ++jump) {
            random = random * 1664525u + 1013904223u;
            const int step = int(random >> 8) % kSteps;
            ASSERT_TRUE(lone.seek((step + 1) * kStep));
            ASSERT_EQ(lone.published(), want[size_t(step)].first) << step;
            ASSERT_EQ(lone.state(), want[size_t(step)].second) << step;
        }
    }
}

TEST(EmitterSeek, playingOnAfterAJumpIsPlaying)
{
    auto def = spriteEmitter(400.0f, {0.3f, 1.1f});
    const auto want = play(*def, 200);
    Lone lone(*def);
    ASSERT_TRUE(lone.seek(120 * kStep));
    for (size_t i = 120; i < 200; ++i) {
        lone.step(kStep);
        ASSERT_EQ(lone.published(), want[i].first);
    }
}

TEST(EmitterSeek, theWayThereDoesNotMatter)
{
    auto def = spriteEmitter(777.0f, {0.1f, 0.9f});
    def->maxParticles = 300; // too few: what is dropped must not depend on the steps either
    def->emission.bursts = {{0.3f, 200}};
    Lone sixty(*def), other(*def);
    while (sixty.now() < 2 * base::kTicksPerSecond)
        sixty.step(kStep);
    for (const int rate : {30, 144, 25, 1}) {
        Lone lone(*def);
        while (lone.now() < 2 * base::kTicksPerSecond)
            lone.step(base::kTicksPerSecond / rate);
        EXPECT_EQ(lone.published(), sixty.published()) << rate;
    }
    for (base::Ticks k = 0; other.now() < 2 * base::kTicksPerSecond; ++k)
        other.step(std::min(1 + 7919 * (k * k % 6007), 2 * base::kTicksPerSecond - other.now()));
    EXPECT_EQ(other.published(), sixty.published());
}

TEST(EmitterSeek, whatIsIntegratedSaysThatItMustBeReplayed)
{
    auto def = spriteEmitter(10.0f, {1, 1});
    def->forces.curlStrength = 1.0f;
    Lone lone(*def);
    lone.step(kStep);
    const uint64_t before = lone.state();
    EXPECT_FALSE(lone.seek(kStep));
    EXPECT_EQ(lone.state(), before);
}

TEST(EmitterSeek, aSavedStateGoesOnAsTheOriginal)
{
    for (const float curl : {0.0f, 1.0f}) {
        auto def = spriteEmitter(400.0f, {0.3f, 1.1f});
        def->forces.curlStrength = curl;
        def->maxParticles = 200;
        Lone lone(*def), copy(*def);
        for (int i = 0; i < 90; ++i)
            lone.step(kStep);
        base::HostMemory memory;
        sim::StateBuffer buffer(&memory);
        lone.solver().save(buffer);
        sim::StateReader reader(buffer.bytes());
        for (int i = 0; i < 90; ++i)
            copy.step(2 * kStep); // something else was there
        copy.solver().restore(reader);
        ASSERT_TRUE(reader.ok()) << reader.status().message();
        EXPECT_EQ(reader.left(), 0u);
        Lone resumed(*def);
        for (int i = 0; i < 90; ++i)
            resumed.step(kStep);
        EXPECT_EQ(copy.state(), resumed.state());
    }
}
