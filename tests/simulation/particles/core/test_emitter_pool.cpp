#include "foundation/math/hash.h"
#include "tests/foundation/real_threads.h"
#include "tests/simulation/particles/core/sprites.h"

#include <gtest/gtest.h>

#include <thread>

using namespace fx;
using namespace fx::test;

namespace {

constexpr uint32_t kInstances = 96;

std::shared_ptr<const sim::EffectDef> effectOf(std::unique_ptr<sim::EmitterDef> def)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->hasGround = false;
    effect->solvers.push_back(std::move(def));
    return effect;
}

/// One life for all; lives that differ, flip-books and too few rows; longer lives and an end; one that no
/// pool takes; streaks.
std::vector<std::shared_ptr<const sim::EffectDef>> effects()
{
    std::vector<std::unique_ptr<sim::EmitterDef>> defs;
    for (int i = 0; i < 5; ++i)
        defs.push_back(spriteEmitter(7.0f, {0.8f, 2.4f}));
    defs[0]->shape = sim::EmitterShape::Point;
    defs[0]->lifetime = {1.5f, 1.5f};
    defs[0]->appearance.spin = {0.0f, 0.0f};
    defs[0]->maxParticles = 13;
    defs[1]->maxParticles = 9; // some find no row
    defs[1]->appearance.tileColumns = defs[1]->appearance.tileRows = 4;
    defs[1]->appearance.frames = sim::FrameClock::OverLife;
    defs[2]->lifetime = {2.0f, 5.0f};
    defs[2]->maxParticles = 40;
    defs[2]->emission.duration = 3.0f;
    defs[3]->appearance.kind = sim::AppearanceKind::Medium;
    defs[3]->maxParticles = 20;
    defs[4]->maxParticles = 25;
    defs[4]->appearance.alignment = base::SpriteAlignment::Velocity;
    defs[4]->appearance.stretch = 0.15f;
    std::vector<std::shared_ptr<const sim::EffectDef>> all;
    for (auto& def : defs)
        all.push_back(effectOf(std::move(def)));
    return all;
}

uint64_t hashOf(const base::FrameSnapshot& snapshot)
{
    uint64_t h = snapshot.groupCount();
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const base::SnapshotGroup& group = snapshot.group(g);
        const base::GroupInfo& info = group.info();
        h = base::hashWord(h, info.instance * 100 + info.solver * 10 + (info.isCosmetic ? 1 : 0));
        h = base::hashWord(h, info.count);
        h = base::hashBytes(h, &info.bounds, sizeof info.bounds);
        h = base::hashBytes(h, &info.placement.position, sizeof info.placement.position);
        h = base::hashBytes(h, group.constants().data(), group.constants().size_bytes());
        const auto columns = snapshot.schema().kind(info.kind).columns;
        for (size_t c = 0; c < columns.size(); ++c)
            h = base::hashBytes(h, group.column(c).data(),
                                group.column(c).size() * base::columnElementSize(columns[c].type));
    }
    return h;
}

/// A world whose instances come and go, and are changed in all ways there are.
class Life
{
public:
    explicit Life(bool pools, std::unique_ptr<base::TaskRunner> tasks = base::makeSerialRunner())
        : tasks_(std::move(tasks)), world_(&schema_, tasks_.get(), &memory_), snapshot_(&schema_, &memory_)
    {
        world_.allowPools(pools);
        for (uint32_t i = 0; i < kInstances; ++i)
            add(i);
    }

    void play(int from, int to, bool changes = true)
    {
        for (int i = from; i < to; ++i) {
            if (changes)
                change(i);
            const base::Ticks ticks = i % 17 == 5 ? kStep / 3 : i == 211 ? 9 * kStep : kStep;
            const sim::StepCounters c = world_.step(active(), now_, ticks);
            for (const uint64_t word : {c.born, c.dropped, c.particleSteps})
                seen_.push_back(word);
            most_ = std::max(most_, world_.pooled());
            now_ += ticks;
            if (i % 7 != 0) // some snapshots are not read
                publish();
            if (i % 3 == 0)
                seen_.push_back(snapshot_.hash());
            if (i % 5 == 0)
                seen_.push_back(hashOf(publish()));
            if (i % 50 == 49) {
                world_.endRests();
                seen_.push_back(world_.hash(all()));
            }
        }
    }
    const base::FrameSnapshot& publish()
    {
        snapshot_.begin(now_, 1);
        world_.publish(active(), snapshot_);
        return snapshot_;
    }

    void look() { seen_.push_back(hashOf(publish())); }
    /// All end at once, and as many others begin after some steps.
    void replaceAll(int from, int steps)
    {
        for (const Entry& entry : entries_)
            world_.remove(entry.slot);
        entries_.clear();
        play(from, from + steps, false);
        for (uint32_t i = 0; i < kInstances; ++i)
            add(1000 * kInstances + i);
    }

    /// Goes on from its own saved state in a new world.
    void restart(bool pools)
    {
        sim::StateBuffer state(&memory_);
        world_.save(all(), state);
        std::vector<sim::World::Entry> entries;
        for (const Entry& entry : entries_)
            entries.push_back({effects_[entry.number % effects_.size()], entry.start});
        sim::World next(&schema_, tasks_.get(), &memory_);
        std::vector<sim::Slot> slots(entries.size());
        sim::StateReader reader(state.bytes());
        next.restore(entries, reader, slots);
        ASSERT_TRUE(reader.ok()) << reader.status().message();
        world_.swap(next);
        world_.setNow(now_);
        world_.allowPools(pools);
        for (size_t i = 0; i < slots.size(); ++i)
            entries_[i].slot = slots[i];
    }

    const std::vector<uint64_t>& seen() const { return seen_; }
    uint32_t most() const { return most_; } ///< instances that were in pools at a time
    base::HostMemory& memory() { return memory_; }
    sim::World& world() { return world_; }

private:
    struct Entry
    {
        uint32_t number;
        sim::Slot slot;
        sim::InstanceStart start;
        bool hidden = false;
    };

    static base::SnapshotSchema kinds()
    {
        base::SnapshotSchema schema;
        schema.add(base::kBlobKind);
        schema.add(base::kParticleKind);
        return schema;
    }
    void add(uint32_t i)
    {
        sim::InstanceStart start;
        start.instance = i + 1;
        start.seed = 500 + i;
        start.startTick = now_ + base::Ticks(i % 5) * kStep * 3 / 2;
        start.placement.position = {double(i), 0.0, 0.0};
        start.parameters.intensity = i % 7 == 3 ? 2.0f : 1.0f;
        entries_.push_back({i, world_.add(effects_[i % effects_.size()], start), start});
    }
    std::vector<sim::Slot> slots(bool withHidden) const
    {
        std::vector<sim::Slot> list;
        for (const Entry& entry : entries_)
            if (withHidden || !entry.hidden)
                list.push_back(entry.slot);
        return list;
    }
    std::vector<sim::Slot> active() const { return slots(false); }
    std::vector<sim::Slot> all() const { return slots(true); }

    void change(int step)
    {
        sim::StepCounters uncounted;
        Entry& entry = entries_[size_t(step) * 13 % entries_.size()];
        switch (step % 20) {
        case 1: // moved, which changes nothing else
            entry.start.placement.position.y += 1.0;
            return world_.setPlacement(entry.slot, entry.start.placement);
        case 3:
            entry.start.parameters.intensity *= 1.5f;
            return world_.setParameters(entry.slot, entry.start.parameters);
        case 5:
            entry.start.parameters.wind = {float(step) * 0.01f, 0.0f, 0.0f};
            return world_.setParameters(entry.slot, entry.start.parameters);
        case 7:
            if (step > 60 && !entry.hidden)
                world_.seekTo(entry.slot, world_.localTime(entry.slot) + kStep * 7, kStep, uncounted);
            return keepClock(entry);
        case 9:
            world_.setRate(entry.slot, step % 40 == 9 ? sim::kNormalRate / 2 : sim::kNormalRate);
            return keepClock(entry);
        case 11:
            entry.start.parameters.emitting = !entry.start.parameters.emitting;
            return world_.setParameters(entry.slot, entry.start.parameters);
        case 13:
            return hideOrShow(entry);
        case 15:
            world_.remove(entry.slot);
            entries_.erase(entries_.begin() + (&entry - entries_.data()));
            return add(uint32_t(kInstances + step));
        default:
            return;
        }
    }
    void keepClock(Entry& entry) { entry.start.clock = world_.clockOf(entry.slot); }
    void hideOrShow(Entry& entry)
    {
        if (!entry.hidden) {
            world_.hide(entry.slot);
        } else {
            sim::StepCounters uncounted;
            uint64_t budget = UINT64_MAX;
            world_.catchUp(entry.slot, sim::CatchUp::Replay, kStep, budget, uncounted);
            world_.show(entry.slot);
        }
        entry.hidden = !entry.hidden;
    }

    const std::vector<std::shared_ptr<const sim::EffectDef>> effects_ = effects();
    base::SnapshotSchema schema_ = kinds();
    base::HostMemory memory_;
    std::unique_ptr<base::TaskRunner> tasks_;
    sim::World world_;
    base::FrameSnapshot snapshot_;
    std::vector<Entry> entries_;
    std::vector<uint64_t> seen_;
    uint32_t most_ = 0;
    base::Ticks now_ = 0;
};

} // namespace

TEST(EmitterPool, whateverHappensEachComesOutAsByItself)
{
    Life pooled(true), alone(false);
    pooled.play(0, 400);
    alone.play(0, 400);
    EXPECT_GT(pooled.most(), kInstances / 3);
    EXPECT_EQ(alone.most(), 0u);
    ASSERT_EQ(pooled.seen().size(), alone.seen().size());
    for (size_t i = 0; i < alone.seen().size(); ++i)
        ASSERT_EQ(pooled.seen()[i], alone.seen()[i]) << i;
}

TEST(EmitterPool, everyNumberOfWorkersGivesTheSameBits)
{
    const RealThreads threadsOfAnyMachine(16);
    Life one(true);
    one.play(0, 150);
    for (const uint32_t threads : {2u, 16u}) {
        Life more(true, base::makeTbbRunner(threads));
        more.play(0, 150);
        EXPECT_EQ(more.seen(), one.seen()) << threads;
    }
}

TEST(EmitterPool, aSavedStateGoesOnAsIfNothingHadHappened)
{
    Life whole(false), cut(true);
    whole.play(0, 120, false);
    cut.play(0, 70, false);
    ASSERT_NO_FATAL_FAILURE(cut.restart(true));
    EXPECT_EQ(cut.world().pooled(), 0u);
    cut.play(70, 120, false);
    EXPECT_GT(cut.world().pooled(), 0u);
    EXPECT_EQ(cut.seen(), whole.seen());
}

TEST(EmitterPool, onlyEmittersOfWhichThereAreSeveralShareOne)
{
    const auto effect = effects()[0];
    for (const uint32_t count : {1u, 40u}) {
        Stage stage;
        for (uint32_t i = 0; i < count; ++i) {
            sim::InstanceStart start;
            start.instance = start.seed = i + 1;
            stage.add(start, effect);
        }
        stage.play(120);
        EXPECT_EQ(stage.world().pooled(), count == 1 ? 0u : count);
    }
}

TEST(EmitterPool, whoJoinsAPoolThatAllHaveLeftMeetsNobody)
{
    for (const int pause : {150, 190, 220, 250, 280}) { // 3 s and more: ages of brief lives come round
        Life pooled(true), alone(false);
        for (Life* life : {&pooled, &alone}) {
            life->play(0, 100, false);
            life->replaceAll(100, pause);
            for (int step = 400; step < 440; ++step) {
                life->play(step, step + 1, false);
                life->look();
            }
        }
        EXPECT_GT(pooled.most(), kInstances / 2);
        EXPECT_EQ(pooled.seen(), alone.seen()) << pause;
    }
}

TEST(EmitterPool, allWhoReadASnapshotSeeTheSame)
{
    Life life(true);
    life.play(0, 60, false);
    const base::FrameSnapshot& snapshot = life.publish();
    ASSERT_GT(life.world().pooled(), 0u);
    std::vector<uint64_t> hashes(8);
    std::vector<std::thread> readers;
    for (uint64_t& hash : hashes)
        readers.emplace_back(
            [&] { hash = (&hash - hashes.data()) % 2 ? hashOf(snapshot) : snapshot.hash(); });
    for (std::thread& reader : readers)
        reader.join();
    for (size_t i = 2; i < hashes.size(); ++i)
        EXPECT_EQ(hashes[i], hashes[i - 2]);
    const uint64_t spread = hashOf(snapshot), streamed = snapshot.hash();
    EXPECT_EQ(hashes[1], spread);
    EXPECT_EQ(hashes[0], streamed);
}

TEST(EmitterPool, theSteadyStateAllocatesNothing)
{
    Life life(true);
    life.play(0, 300, false);
    ASSERT_GT(life.world().pooled(), 0u);
    const uint64_t before = life.memory().allocationCount();
    life.play(301, 400, false);
    EXPECT_EQ(life.memory().allocationCount(), before);
}
