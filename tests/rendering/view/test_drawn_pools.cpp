// Emitters that share a pool look, pixel for pixel, like those that do not, and their rows are drawn from
// where they lie.
#include "particle_fixture.h"
#include "tests/simulation/particles/core/sprites.h"

#include "foundation/snapshot/snapshot_ring.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <string>
#include <utility>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSide = 64;
constexpr uint32_t kInstances = 150;
constexpr int kWarm = 220; ///< steps after which all share pools

using Effect = std::shared_ptr<const sim::EffectDef>;

Effect effectOf(std::unique_ptr<sim::EmitterDef> def)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->hasGround = false;
    effect->solvers.push_back(std::move(def));
    return effect;
}

std::unique_ptr<sim::EmitterDef> sprites(base::ParticleBlend blend, base::ParticleOrder order, uint32_t rows)
{
    auto def = spriteEmitter(float(rows) * 0.4f, {0.8f, 2.0f});
    def->maxParticles = rows;
    def->appearance.luminance = 1.0f;
    def->appearance.lit = 0.0f;
    def->appearance.blend = blend;
    def->appearance.order = order;
    return def;
}

/// Those that are drawn together: in any order, by distance, turned by an axis, hiding, streaks.
std::vector<Effect> together(uint32_t rows = 16)
{
    std::vector<Effect> all;
    all.push_back(effectOf(sprites(base::ParticleBlend::Additive, base::ParticleOrder::None, rows)));
    all.push_back(effectOf(sprites(base::ParticleBlend::Alpha, base::ParticleOrder::Depth, rows)));
    auto turned = sprites(base::ParticleBlend::Additive, base::ParticleOrder::Depth, rows);
    turned->appearance.alignment = base::SpriteAlignment::Axis;
    turned->appearance.axis = {0.6f, 0.8f, 0.0f};
    turned->appearance.aspect = 3.0f;
    all.push_back(effectOf(std::move(turned)));
    auto solid = sprites(base::ParticleBlend::Opaque, base::ParticleOrder::None, rows);
    solid->appearance.tileColumns = solid->appearance.tileRows = 2;
    solid->appearance.frames = sim::FrameClock::OverLife;
    all.push_back(effectOf(std::move(solid)));
    auto streaks = sprites(base::ParticleBlend::Additive, base::ParticleOrder::Depth, rows);
    streaks->appearance.alignment = base::SpriteAlignment::Velocity;
    streaks->appearance.stretch = 0.1f;
    all.push_back(effectOf(std::move(streaks)));
    return all;
}

/// And one whose order is its own.
std::vector<Effect> togetherAndAlone(uint32_t rows = 16)
{
    std::vector<Effect> all = together(rows);
    all.push_back(effectOf(sprites(base::ParticleBlend::Alpha, base::ParticleOrder::Oldest, rows)));
    return all;
}

/// A world whose instances come, go, move, hide and change.
class Life
{
public:
    Life(const base::SnapshotSchema& schema, std::vector<Effect> effects, bool pools)
        : effects_(std::move(effects)), world_(&schema, tasks_.get(), &memory_), ring_(&schema, &memory_)
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
            const base::Ticks ticks = i % 19 == 7 ? kStep / 3 : kStep;
            static_cast<void>(world_.step(active(), now_, ticks));
            now_ += ticks;
            publish(ticks);
        }
    }
    /// Nothing happens but that it is published once more.
    void publish(base::Ticks ticks = 0)
    {
        base::FrameSnapshot& snapshot = ring_.beginWrite(now_, ticks);
        world_.publish(active(), snapshot);
        ring_.publish();
    }
    void move(double x)
    {
        entries_[0].start.placement.position.x = x;
        world_.setPlacement(entries_[0].slot, entries_[0].start.placement);
    }
    base::SnapshotRing& ring() { return ring_; }
    sim::World& world() { return world_; }

private:
    struct Entry
    {
        uint32_t number;
        sim::Slot slot;
        sim::InstanceStart start;
        bool hidden = false;
    };

    void add(uint32_t i)
    {
        sim::InstanceStart start;
        start.instance = i + 1;
        start.seed = 900 + i;
        start.startTick = now_;
        const double column = double(i % 8), row = double(i / 8 % 8);
        const double away = i % 10 == 4 ? 3000.0 : 0.0; // too far to be drawn with the others
        start.placement.position = {column - 4.0, row - 5.0, -away};
        start.placement.scale = 0.5f + 0.05f * float(i % 6);
        entries_.push_back({i, world_.add(effects_[i % effects_.size()], start), start});
    }
    std::vector<sim::Slot> active() const
    {
        std::vector<sim::Slot> list;
        for (const Entry& entry : entries_)
            if (!entry.hidden)
                list.push_back(entry.slot);
        return list;
    }
    void change(int step)
    {
        Entry& entry = entries_[size_t(step) * 7 % entries_.size()];
        switch (step % 12) {
        case 1:
            entry.start.placement.position.y += 0.5;
            return world_.setPlacement(entry.slot, entry.start.placement);
        case 4: // those that are turned are not drawn with the others where an axis counts
            entry.start.placement.rotation = glm::angleAxis(0.3f * float(step), glm::vec3(0.0f, 1.0f, 0.0f));
            return world_.setPlacement(entry.slot, entry.start.placement);
        case 6:
            entry.start.parameters.intensity *= 1.4f;
            return world_.setParameters(entry.slot, entry.start.parameters);
        case 8:
            if (!entry.hidden)
                world_.hide(entry.slot);
            else
                world_.show(entry.slot);
            entry.hidden = !entry.hidden;
            return;
        case 10:
            world_.remove(entry.slot);
            entries_.erase(entries_.begin() + (&entry - entries_.data()));
            return add(kInstances + uint32_t(step));
        default:
            return;
        }
    }

    std::vector<Effect> effects_;
    base::HostMemory memory_;
    std::unique_ptr<base::TaskRunner> tasks_ = base::makeSerialRunner();
    sim::World world_;
    base::SnapshotRing ring_;
    std::vector<Entry> entries_;
    base::Ticks now_ = 0;
};

class DrawnPools : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        other_ = makeView(std::pmr::get_default_resource());
    }

    std::unique_ptr<render::ViewRenderer> makeView(std::pmr::memory_resource* memory)
    {
        auto view = std::make_unique<render::ViewRenderer>(device_.get(), &schema_, memory);
        view->setAssets(&assets_);
        view->settings() = view_->settings();
        return view;
    }
    Picture draw(Life& life, double interpolation = 0.4)
    {
        const base::SnapshotPair shown = life.ring().acquire();
        setPicture(std::vector<float>(kSide * kSide * 4, 0.0f));
        Picture picture = renderPair(*shown.newer, shown.older, interpolation, flatCamera());
        given_ = shown.newer->hasGivenRows() || (shown.older && shown.older->hasGivenRows());
        statistics_ = view_->statistics();
        life.ring().release(shown);
        return picture;
    }
    /// With the other view.
    Picture drawOther(Life& life, double interpolation = 0.4)
    {
        view_.swap(other_);
        Picture picture = draw(life, interpolation);
        view_.swap(other_);
        return picture;
    }
    /// With a view that has kept nothing.
    Picture drawAnew(Life& life)
    {
        std::unique_ptr<render::ViewRenderer> kept = makeView(std::pmr::get_default_resource());
        view_.swap(kept);
        Picture picture = draw(life);
        view_.swap(kept);
        return picture;
    }
    void expectSame(Life& pooled, Life& alone, const std::string& where)
    {
        const Picture one = draw(pooled);
        const render::FrameStatistics counts = statistics_;
        const Picture two = drawOther(alone);
        ASSERT_EQ(one.texels, two.texels) << where;
        EXPECT_GE(counts.particles, statistics_.particles) << where; // empty rows where there is no order
        EXPECT_EQ(counts.drawCalls, statistics_.drawCalls) << where;
        EXPECT_EQ(counts.particlesOrdered, statistics_.particlesOrdered) << where;
        EXPECT_EQ(counts.particlesThinned, statistics_.particlesThinned) << where;
        lit_ += size_t(std::ranges::count_if(one.texels, [](float value) { return value > 0.0f; }));
        thinned_ += counts.particlesThinned;
    }

    std::unique_ptr<render::ViewRenderer> other_;
    render::FrameStatistics statistics_;
    bool given_ = false; ///< rows of pools to their groups
    size_t lit_ = 0;
    uint64_t thinned_ = 0;
};

} // namespace

TEST_F(DrawnPools, lookLikeEmittersByThemselvesWhateverHappens)
{
    Life pooled(schema_, togetherAndAlone(), true), alone(schema_, togetherAndAlone(), false);
    uint32_t most = 0;
    for (int step = 0; step < 200; ++step) {
        pooled.play(step, step + 1);
        alone.play(step, step + 1);
        most = std::max(most, pooled.world().pooled());
        if (step > 50 && step % 4 < 2) { // the newer snapshot becomes the older one, or there is a gap
            ASSERT_NO_FATAL_FAILURE(expectSame(pooled, alone, std::to_string(step)));
        }
    }
    EXPECT_GT(most, kInstances / 3);
    EXPECT_GT(lit_, 1000u);
}

TEST_F(DrawnPools, areThinnedOutLikeOthers)
{
    view_->settings().lod.bias = other_->settings().lod.bias = 500.0f;
    Life pooled(schema_, togetherAndAlone(80), true), alone(schema_, togetherAndAlone(80), false);
    pooled.play(0, kWarm, false);
    alone.play(0, kWarm, false);
    for (int step = kWarm; step < kWarm + 30; ++step) {
        pooled.play(step, step + 1);
        alone.play(step, step + 1);
        ASSERT_NO_FATAL_FAILURE(expectSame(pooled, alone, std::to_string(step)));
    }
    EXPECT_GT(thinned_, 0u);
}

TEST_F(DrawnPools, giveNoRowsToGroupsWhereAllAreDrawnTogether)
{
    Life pooled(schema_, together(), true);
    pooled.play(0, kWarm, false);
    ASSERT_GT(pooled.world().pooled(), kInstances * 9 / 10);
    for (int step = kWarm; step < kWarm + 10; ++step) {
        pooled.play(step, step + 1, false);
        static_cast<void>(draw(pooled));
        EXPECT_FALSE(given_) << step;
    }
    Life mixed(schema_, togetherAndAlone(), true); // the control
    mixed.play(0, kWarm, false);
    static_cast<void>(draw(mixed));
    EXPECT_TRUE(given_);
}

TEST_F(DrawnPools, areUploadedOnceAStep)
{
    Life pooled(schema_, together(), true);
    pooled.play(0, kWarm, false);
    static_cast<void>(draw(pooled));
    for (int step = kWarm; step < kWarm + 6; ++step) {
        pooled.play(step, step + 1, false);
        const Picture picture = draw(pooled);
        const double kept = double(statistics_.uploadedBytes);
        EXPECT_EQ(drawAnew(pooled).texels, picture.texels) << step;
        EXPECT_LE(kept, double(statistics_.uploadedBytes)) << step; // one state, whether mixed or kept
    }
}

TEST_F(DrawnPools, keepTheirRowsWhileTimeStandsStill)
{
    Life pooled(schema_, together(), true);
    pooled.play(0, kWarm, false);
    for (int i = 0; i < 6; ++i) {
        pooled.publish();
        static_cast<void>(draw(pooled));
    }
    EXPECT_EQ(statistics_.uploadedBytes, 0u);
    pooled.move(1.5); // of one: all others are where they were
    for (int i = 0; i < 3; ++i) {
        pooled.publish();
        static_cast<void>(draw(pooled));
    }
    EXPECT_FALSE(given_);
}

TEST_F(DrawnPools, areDrawnWithoutAllocationsOnceTheyHaveBeen)
{
    Life pooled(schema_, together(), true);
    pooled.play(0, kWarm, false);
    base::HostMemory memory;
    view_ = makeView(&memory);
    uint64_t before = 0;
    for (int step = kWarm; step < kWarm + 260; ++step) {
        pooled.play(step, step + 1, false);
        static_cast<void>(draw(pooled));
        if (step == kWarm + 200)
            before = memory.allocationCount();
    }
    EXPECT_GT(before, 0u);
    EXPECT_EQ(memory.allocationCount(), before);
    view_.reset();
}
