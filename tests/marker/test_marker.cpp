// A technique of its own joins a view through the list of techniques alone.
#include "rendering/techniques/draw_techniques.h"
#include "tests/marker/marker_technique.h"
#include "tests/rendering/view/view_fixture.h"

#include "rendering/frame/exposure.h"

#include <algorithm>
#include <string>

using namespace fx;
using test::Picture;
using test::TestBlob;

namespace {

constexpr int kSide = 64;

class MarkerTest : public test::ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        schema_.add(test::kMarkerKind);
        device_->setSourceOverride(test::markerSource);
        const auto builtIn = render::drawTechniques();
        techniques_.assign(builtIn.begin(), builtIn.end());
        techniques_.push_back(&test::kMarkerTechnique);
        view_ = makeView(techniques_);
        makeTargets(kSide, kSide);
        clearPicture();
    }

    std::unique_ptr<render::ViewRenderer> makeView(render::DrawTechniques techniques)
    {
        auto view = std::make_unique<render::ViewRenderer>(device_.get(), &schema_,
                                                           std::pmr::get_default_resource(), techniques);
        view->settings() = view_->settings();
        return view;
    }

    void clearPicture() { setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f)); }

    /// One marker of a side of 2 m and an exposed light of 0.5, at `z` before the camera at 20.
    void addMarker(base::FrameSnapshot& snapshot, float z)
    {
        auto& group = snapshot.addGroup(schema_.find("marker"), 1);
        group.editInfo().count = 1;
        group.editInfo().solver = 77;
        for (size_t c = 0; c < 3; ++c)
            group.editColumn(c)[0] = c == 2 ? z : 0.0f;
        const float light = 0.5f / render::exposureFromEv100(kEv100);
        const float constants[] = {1.0f, light, light, light};
        std::ranges::copy(constants, group.editConstants().begin());
    }

    float middle(const Picture& picture) const { return picture.at(kSide / 2, kSide / 2)[0]; }

    bool has(std::string_view pass) const
    {
        return std::ranges::find(view_->executedPasses(), pass) != view_->executedPasses().end();
    }

    std::vector<const render::DrawTechnique*> techniques_;
    render::CameraView camera_ = render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 0.5f, 1.0f, 0.1f);
};

} // namespace

TEST_F(MarkerTest, isDrawnWhereItsTechniqueIsInTheListAndNowhereElse)
{
    base::FrameSnapshot snapshot = snapshotOf({});
    addMarker(snapshot, 0.0f);
    const Picture drawn = render(snapshot, camera_);
    EXPECT_FLOAT_EQ(middle(drawn), 0.5f);
    EXPECT_EQ(drawn.at(1, 1)[0], 0.0f) << "beside it nothing is";
    EXPECT_TRUE(has("marker upload"));
    EXPECT_EQ(view_->statistics().particles, 1u);
    EXPECT_GT(view_->statistics().estimatedFragments, 0u);

    clearPicture();
    view_ = makeView(render::drawTechniques());
    EXPECT_EQ(middle(render(snapshot, camera_)), 0.0f);
    EXPECT_TRUE(view_->executedPasses().empty());
}

TEST_F(MarkerTest, isComposedWithMediaByDistance)
{
    const TestBlob smoke{.radius = 3.0f, .crossSection = 1e4f}; // black and dense
    base::FrameSnapshot behind = snapshotOf({smoke});
    addMarker(behind, -8.0f);
    EXPECT_LT(middle(render(behind, camera_)), 0.01f);
    clearPicture();
    base::FrameSnapshot before = snapshotOf({smoke});
    addMarker(before, 8.0f);
    EXPECT_FLOAT_EQ(middle(render(before, camera_)), 0.5f);
}

TEST_F(MarkerTest, isHiddenByTheHostsDepth)
{
    base::FrameSnapshot snapshot = snapshotOf({});
    addMarker(snapshot, 0.0f);
    setDepth(std::vector<float>(size_t(kSide) * kSide, 0.5f)); // a wall at about 0.2 m
    EXPECT_EQ(middle(render(snapshot, camera_)), 0.0f);
}

TEST_F(MarkerTest, itsProgramsAreCompiledByTheWarmUp)
{
    ASSERT_TRUE(view_->warmUp().ok());
    base::FrameSnapshot snapshot = snapshotOf({});
    addMarker(snapshot, 0.0f);
    render(snapshot, camera_);
    EXPECT_EQ(view_->statistics().programsCompiled, 0u);
}

TEST_F(MarkerTest, itsPassesAreTimedInTheirOwnGroup)
{
    const size_t group = view_->passGroups().find("marker");
    ASSERT_GT(group, 0u);
    EXPECT_EQ(view_->passGroups().groupOf("marker upload"), group);
    static double now; // a clock that goes on by 1 ms whenever it is asked
    now = 0.0;
    view_->setHostClock([] { return now += 1.0; });
    view_->setTiming(render::TimingClock::Host, 5);
    base::FrameSnapshot snapshot = snapshotOf({});
    addMarker(snapshot, 0.0f);
    render(snapshot, camera_);
    render::GroupTimes times;
    ASSERT_TRUE(view_->takeTimes(times));
    EXPECT_EQ(times.tag, 5u);
    EXPECT_DOUBLE_EQ(times.milliseconds[group], 1.0);
    EXPECT_DOUBLE_EQ(times.milliseconds[view_->passGroups().find("media")], 1.0);
}

TEST_F(MarkerTest, itsEffectsUseItAndWhatChangesThePictureOfAllTechniques)
{
    const base::KindDesc* const kinds[] = {&test::kMarkerKind};
    EXPECT_FALSE(render::isDrawn(kinds)) << "no technique of the library draws markers";
    EXPECT_TRUE(render::isDrawn(kinds, techniques_));
    const render::EffectContent content{.kinds = kinds, .isDrawn = true};
    std::vector<std::string_view> used;
    for (const render::DrawTechnique* technique : techniques_)
        if (render::isUsed(*technique, content))
            used.push_back(technique->name);
    EXPECT_EQ(used, (std::vector<std::string_view>{"dazzle", "markers"}));
}

TEST_F(MarkerTest, itsListsServeAgainAndItsMemoryIsGivenBack)
{
    base::FrameSnapshot snapshot = snapshotOf({});
    addMarker(snapshot, 0.0f);
    render(snapshot, camera_);
    clearPicture();
    EXPECT_FLOAT_EQ(middle(render(snapshot, camera_)), 0.5f);
    EXPECT_TRUE(view_->statistics().keptLists);
    EXPECT_FALSE(has("marker upload"));
    base::FrameSnapshot nothing(&schema_, std::pmr::get_default_resource());
    nothing.begin(0, ++sequence_);
    for (int i = 0; i < 400 && !view_->isAsleep(); ++i)
        render(nothing, camera_);
    EXPECT_TRUE(view_->isAsleep());
    EXPECT_EQ(view_->statistics().textureBytes, 0u);
}
