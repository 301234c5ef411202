// Rows of what stands still are not uploaded again while something else moves, and rows that several
// instances share are uploaded once; the picture is that of a view which has kept nothing.
#include "particle_fixture.h"

#include <deque>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;

namespace {

constexpr int kSide = 64;
constexpr uint64_t kRowBytes = 24; ///< of what every sprite has

/// One group of sprites.
struct Cast
{
    uint32_t rows;
    float shift = 0.0f;    ///< [m] of all rows
    double place = 0.0;    ///< [m] of the instance
    bool isMerged = false; ///< it adds, so that it can be drawn with others
};

class KeptRows : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
    }

    const base::FrameSnapshot& publish(const std::vector<Cast>& casts)
    {
        snapshots_.push_back(emptySnapshot(0.1 * double(snapshots_.size())));
        for (size_t g = 0; g < casts.size(); ++g) {
            std::vector<TestParticle> particles(casts[g].rows);
            for (size_t i = 0; i < particles.size(); ++i) {
                particles[i].center = {float(i % 9) - 4.0f + casts[g].shift, float(i % 7) - 3.0f, 0.0f};
                particles[i].radius = 0.2f;
                particles[i].color = {1.0f, 0.5f, 0.25f, 0.5f};
                particles[i].age = 100.0f + 0.1f * float(snapshots_.size());
            }
            if (casts[g].shift == 0.0f) // what rests is as old as it was
                for (TestParticle& particle : particles)
                    particle.age = 100.0f;
            auto& group = addParticles(snapshots_.back(), particles, base::particle_column::kAlways);
            group.editInfo().instance = g + 1;
            group.editInfo().solver = 0;
            group.editInfo().placement.position = {casts[g].place, 0.5 * double(g), 0.0};
            const auto blend = casts[g].isMerged ? base::ParticleBlend::Additive : base::ParticleBlend::Alpha;
            set(group, constant::Blend, float(blend));
        }
        return snapshots_.back();
    }

    Picture show(const base::FrameSnapshot& newer, const base::FrameSnapshot* older)
    {
        setPicture(std::vector<float>(kSide * kSide * 4, 0.0f));
        return renderPair(newer, older, 0.7, flatCamera());
    }
    /// The two newest snapshots.
    Picture showLast()
    {
        return show(snapshots_.back(), snapshots_.size() > 1 ? &snapshots_[snapshots_.size() - 2] : nullptr);
    }
    /// What a view that has kept nothing shows of the same.
    Picture showAnew()
    {
        std::unique_ptr<render::ViewRenderer> kept = std::move(view_);
        view_ =
            std::make_unique<render::ViewRenderer>(device_.get(), &schema_, std::pmr::get_default_resource());
        view_->settings() = kept->settings();
        view_->setAssets(&assets_);
        Picture picture = showLast();
        EXPECT_EQ(view_->statistics().keptRowBytes, 0u);
        view_ = std::move(kept);
        return picture;
    }
    /// A view that has neither of two snapshots mixes them before it packs them.
    void expectSamePicture() { EXPECT_LT(maxDifference(showLast(), showAnew()), 1e-4); }
    const render::FrameStatistics& counts() const { return view_->statistics(); }

    std::deque<base::FrameSnapshot> snapshots_; ///< they stay where they are
};

} // namespace

TEST_F(KeptRows, ofWhatRestsAreWrittenThreeTimesAndThenNoMore)
{
    for (int step = 0; step < 9; ++step) {
        publish({{100, 0.1f * float(step + 1)}, {2000}});
        (void)showLast();
        if (step < 4)
            continue;
        EXPECT_EQ(counts().uploadedBytes, 100 * kRowBytes) << step;
        EXPECT_EQ(counts().keptRowBytes, 2000 * kRowBytes) << step;
        expectSamePicture();
    }
    for (int step = 0; step < 9; ++step) { // the control: both move
        publish({{100, 0.1f * float(step + 1)}, {2000, 0.1f * float(step + 1)}});
        (void)showLast();
        if (step < 4)
            continue;
        EXPECT_EQ(counts().uploadedBytes, 2100 * kRowBytes);
        EXPECT_EQ(counts().keptRowBytes, 0u);
        expectSamePicture();
    }
}

TEST_F(KeptRows, aNeighborThatGrowsALittleMovesNothing)
{
    for (int step = 0; step < 9; ++step) {
        publish({{1000 + uint32_t(step), 0.1f * float(step + 1)}, {2000}});
        (void)showLast();
        EXPECT_TRUE(step < 4 || counts().keptRowBytes == 2000 * kRowBytes) << step;
        expectSamePicture();
    }
}

TEST_F(KeptRows, ofInstancesThatAreAlikeAreWrittenOnce)
{
    publish({{1000, 0.0f, -1.0}, {1000, 0.0f, 1.0}, {1000, 0.0f, 2.0}});
    const Picture together = showLast();
    EXPECT_EQ(counts().uploadedBytes, 1000 * kRowBytes);
    EXPECT_EQ(counts().sharedRowBytes, 2000 * kRowBytes);
    snapshots_.back().editGroup(2).editColumn(0)[999] += 1e-6f;
    publish({{1000, 0.0f, -1.0}, {1000, 0.0f, 1.0}, {1000, 0.0f, 2.0}});
    snapshots_.back().editGroup(2).editColumn(0)[999] += 1e-6f;
    snapshots_.pop_front();
    const Picture apart = showAnew();
    EXPECT_LT(maxDifference(together, apart), 1e-3) << "the same but for one row by a micrometre";
    (void)showLast();
    EXPECT_EQ(counts().sharedRowBytes, 1000 * kRowBytes) << "the control: one row differs";
}

TEST_F(KeptRows, ofMembersOfAMergedGroupAreKeptOneByOne)
{
    for (int step = 0; step < 9; ++step) {
        publish({{300, 0.0f, -1.0, true}, {200, 0.1f * float(step + 1), 0.0, true}, {400, 0.0f, 1.0, true}});
        (void)showLast();
        if (step >= 4) {
            EXPECT_EQ(counts().uploadedBytes, 200 * kRowBytes) << "what was newer is older now";
            EXPECT_EQ(counts().keptRowBytes, 700 * kRowBytes) << step;
        }
        expectSamePicture();
    }
    for (int step = 0; step < 4; ++step) { // a member that is carried is another in the merged space
        publish({{300, 0.0f, -1.0 - 0.1 * step, true}, {400, 0.0f, 1.0, true}});
        (void)showLast();
        expectSamePicture();
    }
}

TEST_F(KeptRows, ofMergedGroupsThatHaveRestedGoOnFromTheMomentTheyWereSeenLast)
{
    for (int step = 0; step < 7; ++step) {
        const float shift = step == 6 ? 0.4f : 0.0f; // all rest for a while, and then one moves on
        publish({{30, 0.0f, -1.0, true}, {20, shift, 0.0, true}});
        auto& group = snapshots_.back().editGroup(1);
        for (float& age : group.editColumn(base::particle_column::Age))
            age = 0.25f; // less than for how long they rest: the same particles since the last step alone
        (void)showLast();
    }
    expectSamePicture();
}

TEST_F(KeptRows, ofGroupsThatAreGoneForLongAreWrittenAnewAlthoughOthersWereDrawnAllTheTime)
{
    constexpr int kLongerThanMemoryIsKept = 320; // [frame]
    publish({{50, 0.1f}});
    publish({{50, 0.2f}});
    (void)showLast(); // a group by itself, mixed of two snapshots
    uint64_t bytesBefore = 0;
    for (int frame = 0; frame < kLongerThanMemoryIsKept; ++frame) {
        snapshots_.clear();
        publish({{20, 0.01f * float(frame + 1), 0.0, true}, {30, 0.0f, 1.0, true}}); // merged groups only
        (void)showLast();
        if (frame == 10)
            bytesBefore = counts().textureBytes;
    }
    EXPECT_LT(counts().textureBytes, bytesBefore) << "memory of the group is given back";
    publish({{50, 0.3f}});
    publish({{50, 0.4f}});
    (void)showLast();
    EXPECT_EQ(counts().uploadedBytes, 50 * kRowBytes);
    expectSamePicture();
}
