// What stays the same is neither gathered, sorted nor uploaded again.
#include "particle_fixture.h"
#include "rendering/frame/snapshot_revisions.h"

#include <functional>
#include <optional>

using namespace fx;
using test::TestBlob;
using test::TestParticle;
namespace column = base::particle_column;
namespace constant = base::particle_constant;

namespace {

const std::vector<TestBlob> kBlobs{{{0, 0, 0}, 1.0f, 1.0f, 2.0f}, {{1, 0, -2}, 1.0f, 1.0f, 1.0f}};

class KeptLists : public test::ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(64, 64);
        view_->settings().lighting.sunIlluminance = glm::vec3(1.0f);
    }

    base::FrameSnapshot scene(double seconds, float offset = 0.0f)
    {
        base::FrameSnapshot snapshot = snapshotOf(kBlobs);
        snapshot.begin(base::Ticks(seconds * double(base::kTicksPerSecond)), ++sequence_);
        fillBlobs(snapshot, offset);
        return snapshot;
    }

    void fillBlobs(base::FrameSnapshot& snapshot, float offset)
    {
        const base::FrameSnapshot blobs = snapshotOf(kBlobs);
        for (size_t g = 0; g < blobs.groupCount(); ++g) {
            const base::SnapshotGroup& from = blobs.group(g);
            auto& to = snapshot.addGroup(from.info().kind, from.count());
            to.editInfo() = from.info();
            std::copy(from.ids().begin(), from.ids().end(), to.editIds().begin());
            for (size_t c = 0; c < base::blob_column::Count; ++c)
                std::copy(from.column(c).begin(), from.column(c).end(), to.editColumn(c).begin());
            std::copy(from.constants().begin(), from.constants().end(), to.editConstants().begin());
        }
        nextSolver_ = 100;
        std::vector<TestParticle> many(10);
        for (size_t i = 0; i < many.size(); ++i)
            many[i].center = {0.1f * float(i), offset, 0.2f * float(i)};
        test::set(addParticles(snapshot, many, column::kAlways), constant::Order,
                  float(base::ParticleOrder::Depth));
    }

    test::Picture show(const base::FrameSnapshot& newer, const base::FrameSnapshot* older = nullptr,
                       double moment = 1.0)
    {
        setPicture(std::vector<float>(64 * 64 * 4, 0.0f));
        request_.targets.color = color_->name();
        request_.targets.width = request_.targets.height = 64;
        request_.interpolation = moment;
        base::SnapshotPair pair;
        pair.newer = &newer;
        pair.older = older;
        const base::Status status = view_->render(pair, request_);
        EXPECT_TRUE(status.ok()) << status.message();
        return read(color_->name());
    }

    bool isKept() const
    {
        const render::FrameStatistics& s = view_->statistics();
        EXPECT_EQ(s.keptLists, s.uploadedBytes == 0);
        EXPECT_EQ(s.keptLists, s.sortedElements == 0);
        return s.keptLists;
    }

    render::FrameRequest request_ = [] {
        render::FrameRequest request;
        request.camera = render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f);
        return request;
    }();
};

} // namespace

TEST_F(KeptLists, theSamePictureDrawnAgainUploadsAndSortsNothing)
{
    const auto snapshot = scene(1.0);
    const test::Picture first = show(snapshot);
    EXPECT_FALSE(isKept());
    for (int frame = 0; frame < 5; ++frame) {
        EXPECT_EQ(test::maxDifference(show(snapshot), first), 0.0);
        EXPECT_TRUE(isKept()) << frame;
    }
}

TEST_F(KeptLists, oneChangedInputDoesAllOfItAgain)
{
    const auto snapshot = scene(1.0);
    const auto change = [&](const std::function<void()>& what, const char* name) {
        (void)show(snapshot);
        (void)show(snapshot);
        ASSERT_TRUE(isKept()) << name;
        what();
        (void)show(snapshot);
        EXPECT_FALSE(isKept()) << name;
    };
    change([&] { request_.camera.origin.x += 1e-3; }, "origin");
    change([&] { request_.camera.view[3][0] += 1e-3f; }, "view");
    change([&] { request_.camera.projection[0][0] *= 1.001f; }, "projection");
    change([&] { view_->settings().exposureEv100 += 0.1f; }, "exposure");
    change([&] { view_->settings().lighting.sunDirection = {0, 1, 0}; }, "sun");
    change([&] { view_->settings().particleShare = 0.5f; }, "share");
    change([&] { view_->settings().lod.bias = 2.0f; }, "level of detail");
    change([&] { request_.resetHistory = true; }, "cut");
}

TEST_F(KeptLists, otherContentIsNeverMistakenForTheSame)
{
    const auto before = scene(1.0);
    const auto after = scene(1.1, 0.5f);
    const test::Picture first = show(before);
    const test::Picture second = show(after, &before);
    EXPECT_FALSE(isKept());
    EXPECT_GT(test::maxDifference(first, second), 0.01);
    (void)show(after, &before, 0.5);
    EXPECT_FALSE(isKept()) << "another moment between two that differ";
}

TEST_F(KeptLists, contentAtTheAddressOfAnotherSceneIsNew)
{
    const uint64_t before = sequence_;
    std::optional<base::FrameSnapshot> place(scene(1.0));
    const test::Picture first = show(*place);
    const uint64_t sequence = place->sequence();
    place.reset(); // with its scene; the next scene begins to count anew
    sequence_ = before;
    place.emplace(scene(1.0, 0.5f));
    ASSERT_EQ(place->sequence(), sequence);
    const test::Picture second = show(*place);
    EXPECT_FALSE(isKept());
    EXPECT_GT(test::maxDifference(first, second), 0.01);
}

TEST_F(KeptLists, aSceneThatRestsKeepsThemWhateverItPublishes)
{
    const auto a = scene(1.0);
    const auto b = scene(1.1);
    const auto c = scene(1.2);
    const test::Picture first = show(a);
    EXPECT_EQ(test::maxDifference(show(b, &a, 0.3), first), 0.0);
    EXPECT_EQ(test::maxDifference(show(c, &b, 0.7), first), 0.0);
    EXPECT_TRUE(isKept());
}

TEST_F(KeptLists, whenTheCameraTurnsRowsOfAnUnchangedSceneStayWhereTheyAre)
{
    const auto a = scene(1.0);
    const auto b = scene(1.1);
    (void)show(a);
    const uint64_t all = view_->statistics().uploadedBytes;
    request_.camera.origin.x += 0.01;
    (void)show(b, &a, 0.5);
    EXPECT_FALSE(isKept());
    EXPECT_EQ(view_->statistics().uploadedBytes, all - 10u * 24u) << "all but the ten rows";
}

TEST_F(KeptLists, memoryOfTheFrameIsSharedAndCounted)
{
    const auto snapshot = scene(1.0);
    view_->settings().toneMap = true;
    view_->settings().dazzle.enabled = true;
    (void)show(snapshot);
    const render::FrameStatistics& s = view_->statistics();
    EXPECT_GT(s.unsharedBytes, s.sharedBytes);
    EXPECT_LE(s.sharedBytes, s.textureBytes);
}

TEST(SnapshotRevisions, tellApartWhatDiffersInAnyColumn)
{
    base::SnapshotSchema schema;
    schema.add(base::kParticleKind);
    const auto make = [&](base::Ticks tick, size_t changed) {
        base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
        snapshot.begin(tick, 1);
        auto& group = snapshot.addGroup(0, 3);
        group.editInfo().count = 3;
        for (size_t c = 0; c < column::Count; ++c)
            for (size_t i = 0; i < 3; ++i) {
                const uint64_t value = 100 * c + i + (c == changed && i == 2 ? 1 : 0);
                if (c == column::Color || c == column::Index)
                    group.editColumn64(c)[i] = value;
                else
                    group.editColumn(c)[i] = float(value);
            }
        for (float& value : group.editConstants())
            value = 0.0f;
        return snapshot;
    };
    const auto original = make(0, ~size_t(0));
    EXPECT_TRUE(render::holdSame(original, make(5, ~size_t(0))));
    for (size_t c = 0; c < column::Count; ++c)
        EXPECT_FALSE(render::holdSame(original, make(5, c))) << c;
}
