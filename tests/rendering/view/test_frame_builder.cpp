// Gathering, interpolation and order, without GL.
#include "foundation/snapshot/blob_kind.h"
#include "rendering/media/blob_gather.h"
#include "rendering/media/frame_builder.h"
#include "rendering/stage/stage_camera.h"

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

using namespace fx;
namespace column = base::blob_column;

namespace {

struct Element
{
    uint64_t id;
    float x;
    float age = 10.0f;
    float velocity = 0.0f;
};

class FrameBuilderTest : public testing::Test
{
protected:
    FrameBuilderTest() { schema_.add(base::kBlobKind); }

    base::FrameSnapshot snapshot(base::Ticks tick, const std::vector<Element>& elements, float shutter = 0.0f)
    {
        base::FrameSnapshot s(&schema_, std::pmr::get_default_resource());
        s.begin(tick, 1);
        auto& group = s.addGroup(0, elements.size());
        group.editInfo().count = uint32_t(elements.size());
        group.editConstants()[base::blob_constant::Shutter] = shutter;
        for (size_t i = 0; i < elements.size(); ++i) {
            for (size_t c = 0; c < column::Count; ++c)
                group.editColumn(c)[i] = 0.0f;
            group.editIds()[i] = elements[i].id;
            group.editColumn(column::PositionX)[i] = elements[i].x;
            group.editColumn(column::VelocityX)[i] = elements[i].velocity;
            group.editColumn(column::Radius)[i] = 0.5f;
            group.editColumn(column::CrossSection)[i] = 1.0f;
            group.editColumn(column::Age)[i] = elements[i].age;
        }
        return s;
    }

    std::pmr::vector<render::GatheredBlob> gathered(const base::FrameSnapshot& newer)
    {
        const base::SnapshotPair pair{&newer, nullptr};
        std::pmr::vector<render::GatheredBlob> blobs;
        const auto camera =
            render::cameraGeometry(render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f));
        std::pmr::vector<render::MediumCaster> medium;
        std::pmr::vector<render::InstanceBlobs> instances;
        render::gatherBlobs(pair, 1.0, camera, 720, blobs, medium, instances);
        return blobs;
    }

    std::vector<float> gather(const base::FrameSnapshot* newer, const base::FrameSnapshot* older, double t)
    {
        base::SnapshotPair pair;
        pair.newer = newer;
        pair.older = older;
        std::pmr::vector<render::GatheredBlob> blobs;
        const auto camera =
            render::cameraGeometry(render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f));
        std::pmr::vector<render::MediumCaster> medium;
        std::pmr::vector<render::InstanceBlobs> instances;
        counts_ = render::gatherBlobs(pair, t, camera, 720, blobs, medium, instances);
        mediumCount_ = medium.size();
        std::vector<float> x;
        for (const auto& blob : blobs)
            x.push_back(blob.center.x);
        return x;
    }

    base::SnapshotSchema schema_;
    render::GatherCounts counts_;
    size_t mediumCount_ = 0;
};

constexpr base::Ticks kStep = base::kTicksPerSecond / 60;

} // namespace

TEST_F(FrameBuilderTest, interpolatesTheSameElementById)
{
    const auto older = snapshot(0, {{3, 0.0f}, {7, 4.0f}});
    const auto newer = snapshot(kStep, {{3, 1.0f}, {5, 9.0f}, {7, 2.0f}});
    const auto x = gather(&newer, &older, 0.25);
    ASSERT_EQ(x.size(), 3u);
    EXPECT_FLOAT_EQ(x[0], 0.25f);
    EXPECT_FLOAT_EQ(x[2], 3.5f);
}

TEST_F(FrameBuilderTest, carriesANewElementBackAlongItsVelocityAndHidesTheUnborn)
{
    const auto older = snapshot(0, {});
    const auto newer = snapshot(kStep, {{1, 1.0f, 0.012f, 60.0f}, {2, 5.0f, 0.001f, 60.0f}});
    const auto x = gather(&newer, &older, 0.5); // half a step, 8.3 ms, ago: the second was not yet born
    ASSERT_EQ(x.size(), 1u);
    EXPECT_NEAR(x[0], 1.0f - 60.0f * 0.5f / 60.0f, 1e-5f);
}

TEST_F(FrameBuilderTest, atTheEndsShowsTheSnapshotsThemselves)
{
    const auto older = snapshot(0, {{3, 0.5f}});
    const auto newer = snapshot(kStep, {{3, 1.0f}});
    EXPECT_FLOAT_EQ(gather(&newer, &older, 0.0)[0], 0.5f);
    EXPECT_FLOAT_EQ(gather(&newer, &older, 1.0)[0], 1.0f);
    EXPECT_FLOAT_EQ(gather(&newer, nullptr, 0.3)[0], 1.0f);
}

TEST_F(FrameBuilderTest, leavesOutWhatIsBesideOrBehindTheView)
{
    const auto newer = snapshot(0, {{1, 0.0f}, {2, 500.0f}, {3, -500.0f}});
    EXPECT_EQ(gather(&newer, nullptr, 1.0).size(), 1u);
    EXPECT_EQ(counts_.culled, 2u);
    EXPECT_EQ(mediumCount_, 3u) << "but they still cast shadows";
}

TEST_F(FrameBuilderTest, aShutterDrawsAFastBlobOutAndKeepsItsMedium)
{
    const auto newer = snapshot(0, {{1, 0.0f, 10.0f, 120.0f}}, 1.0f / 60.0f);
    base::SnapshotPair pair;
    pair.newer = &newer;
    std::pmr::vector<render::GatheredBlob> blobs;
    const auto camera =
        render::cameraGeometry(render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f));
    std::pmr::vector<render::MediumCaster> medium;
    std::pmr::vector<render::InstanceBlobs> instances;
    render::gatherBlobs(pair, 1.0, camera, 720, blobs, medium, instances);
    ASSERT_GT(blobs.size(), 2u);
    float sum = 0.0f;
    for (const auto& blob : blobs)
        sum += blob.crossSection;
    EXPECT_NEAR(sum, 1.0f, 1e-5f);
    EXPECT_LT(blobs.back().center.x, -1.0f);
}

TEST_F(FrameBuilderTest, ranksFollowInstanceAndParticleAndAreUniform)
{
    constexpr uint64_t kBalls = 4096;
    std::vector<Element> elements;
    for (uint64_t id = 0; id < kBalls; ++id)
        elements.push_back({id, 0.0f});
    const auto ranksOf = [this](uint64_t instance, const std::vector<Element>& of) {
        base::FrameSnapshot one = snapshot(0, of);
        one.editGroup(0).editInfo().instance = instance;
        std::vector<float> ranks;
        for (const render::GatheredBlob& blob : gathered(one))
            ranks.push_back(blob.rank);
        return ranks;
    };
    const std::vector<float> first = ranksOf(1, elements), second = ranksOf(2, elements);
    ASSERT_EQ(first.size(), kBalls);
    elements.erase(elements.begin(), elements.begin() + 100); // they die
    const std::vector<float> left = ranksOf(1, elements);
    EXPECT_TRUE(std::ranges::equal(left, std::span(first).subspan(100)));

    // of quarters of both instances, each pair of ranks falls into one of 16 cells as often
    std::vector<double> cells(16);
    for (size_t i = 0; i < kBalls; ++i) {
        ASSERT_GE(first[i], 0.0f);
        ASSERT_LT(first[i], 1.0f);
        ++cells[size_t(4.0f * first[i]) * 4 + size_t(4.0f * second[i])];
    }
    double chi2 = 0.0;
    for (const double cell : cells)
        chi2 += (cell - double(kBalls) / 16.0) * (cell - double(kBalls) / 16.0) / (double(kBalls) / 16.0);
    EXPECT_LT(chi2, 37.7) << "15 degrees of freedom: 0.1 %";
}

TEST_F(FrameBuilderTest, piecesOfAStreakHaveRanksOfTheirOwn)
{
    const auto blobs = gathered(snapshot(0, {{1, 0.0f, 10.0f, 120.0f}}, 1.0f / 60.0f));
    ASSERT_GT(blobs.size(), 2u);
    EXPECT_NE(blobs[0].rank, blobs[1].rank);
}

TEST_F(FrameBuilderTest, aStreakOfAnyLengthHasNoGaps)
{
    const auto camera =
        render::cameraGeometry(render::orthographicView({{0, 0, 20}, {0, 0, 0}}, 1e4f, 1.0f, 0.1f, 100.0f));
    for (const float speed : {30.0f, 400.0f, 3000.0f, 30'000.0f}) {
        const auto newer = snapshot(0, {{1, 0.0f, 10.0f, speed}}, 1.0f / 60.0f);
        base::SnapshotPair pair;
        pair.newer = &newer;
        std::pmr::vector<render::GatheredBlob> blobs;
        std::pmr::vector<render::MediumCaster> medium;
        std::pmr::vector<render::InstanceBlobs> instances;
        render::gatherBlobs(pair, 1.0, camera, 1 << 14, blobs, medium, instances);
        for (size_t k = 1; k < blobs.size(); ++k)
            ASSERT_LE(glm::distance(blobs[k - 1].center, blobs[k].center), 1.001f * blobs[k].radius) << speed;
        ASSERT_FALSE(blobs.empty());
        EXPECT_NEAR(-blobs.back().center.x, speed / 60.0f, 1.001f * blobs[0].radius) << speed;
    }
}

TEST_F(FrameBuilderTest, aShareOfTheParticlesStandsForAllOfThemAndGrowsByAddition)
{
    std::vector<Element> elements;
    for (uint64_t id = 1; id <= 20'000; ++id)
        elements.push_back({id * 3, float(id) * 1e-4f});
    const auto newer = snapshot(0, elements);
    base::SnapshotPair pair;
    pair.newer = &newer;
    const auto camera =
        render::cameraGeometry(render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f));
    std::vector<float> before;
    for (const float share : {0.125f, 0.25f, 0.5f, 1.0f}) {
        std::pmr::vector<render::GatheredBlob> blobs;
        std::pmr::vector<render::MediumCaster> medium;
        std::pmr::vector<render::InstanceBlobs> instances;
        render::gatherBlobs(pair, 1.0, camera, 720, blobs, medium, instances, share);
        EXPECT_NEAR(float(blobs.size()) / 20'000.0f, share, 0.015f); // 4 standard deviations
        double crossSection = 0.0;
        std::vector<float> x;
        for (const render::GatheredBlob& blob : blobs) {
            crossSection += double(blob.crossSection);
            x.push_back(blob.center.x);
        }
        EXPECT_NEAR(crossSection / 20'000.0, 1.0, 0.12);
        EXPECT_EQ(medium.size(), 20'000u) << "all cast shadows";
        EXPECT_TRUE(std::includes(x.begin(), x.end(), before.begin(), before.end()));
        before = x;
    }
    EXPECT_EQ(before.size(), 20'000u);
}

TEST_F(FrameBuilderTest, sortsFarthestFirstByDistanceFromTheEye)
{
    const auto newer = snapshot(0, {{1, 0.0f}, {2, 3.0f}, {3, -6.0f}});
    base::SnapshotPair pair;
    pair.newer = &newer;
    render::FrameBuilder builder(std::pmr::get_default_resource());
    render::FrameRequest request;
    request.targets.height = 720;
    request.camera = render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f);
    render::LevelOfDetail lod(std::pmr::get_default_resource());
    builder.build(pair, request, {}, render::cameraGeometry(request.camera), lod);
    ASSERT_EQ(builder.blobs().size(), 3u);
    EXPECT_FLOAT_EQ(builder.blobs()[0].centerRadius.x, -6.0f);
    EXPECT_FLOAT_EQ(builder.blobs()[2].centerRadius.x, 0.0f);
}

TEST(CameraGeometry, findsTheEyeAndTheNearPlaneOfEveryProjection)
{
    const render::CameraPose pose{{1e5, 2.0, -3.0}, {1e5 + 4.0, 1.0, 5.0}};
    for (const auto depth : {render::DepthConvention::Standard, render::DepthConvention::Reversed}) {
        const auto g = render::cameraGeometry(render::perspectiveView(pose, 1.0f, 1.5f, 0.25f, depth));
        EXPECT_NEAR(g.nearDistance, 0.25f, 1e-6f);
        EXPECT_NEAR(glm::length(g.eye - pose.position), 0.0, 1e-6);
        EXPECT_NEAR(glm::dot(glm::dvec3(g.forward), glm::normalize(pose.target - pose.position)), 1.0, 1e-6);
    }
    const auto g = render::cameraGeometry(render::orthographicView(pose, 10.0f, 1.0f, 0.5f, 50.0f));
    EXPECT_TRUE(g.orthographic);
    EXPECT_NEAR(g.nearDistance, 0.5f, 1e-4f);
}

TEST_F(FrameBuilderTest, aMirroredProjectionSeesTheSameBlobs)
{
    const auto newer = snapshot(0, {{1, 0.0f}, {2, 3.0f}, {3, 500.0f}});
    base::SnapshotPair pair;
    pair.newer = &newer;
    auto view = render::perspectiveView({{0, 0, 20}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f);
    view.projection[1][1] *= -1.0f;
    std::pmr::vector<render::GatheredBlob> blobs;
    std::pmr::vector<render::MediumCaster> medium;
    std::pmr::vector<render::InstanceBlobs> instances;
    render::gatherBlobs(pair, 1.0, render::cameraGeometry(view), 720, blobs, medium, instances);
    ASSERT_EQ(blobs.size(), 2u);
    EXPECT_FLOAT_EQ(blobs[0].radius, 0.5f);
}

TEST_F(FrameBuilderTest, aFarEffectThatIsDrawnAsAPictureAloneCastsTheSameShadowByFewerBalls)
{
    std::vector<Element> elements;
    for (uint64_t i = 0; i < 100; ++i)
        elements.push_back({i, 0.01f * float(i)});
    auto newer = snapshot(0, elements);
    newer.editGroup(0).editInfo().bounds.add(glm::vec3(0.5f, 0.0f, 0.0f), 1.0f);
    base::SnapshotPair pair;
    pair.newer = &newer;
    render::FrameRequest request;
    request.targets.height = 720;
    request.deltaTime = 0.5; // longer than a fade
    request.camera = render::perspectiveView({{0, 0, 200}, {0, 0, 0}}, 1.0f, 1.0f, 0.1f);
    const auto camera = render::cameraGeometry(request.camera);
    render::ViewSettings settings;
    settings.lod.impostorPixels = render::LodSettings::kMaxImpostorPixels;
    render::FrameBuilder builder(std::pmr::get_default_resource());
    render::LevelOfDetail lod(std::pmr::get_default_resource());
    for (const bool castsShadows : {true, false}) {
        for (int frame = 0; frame < 4; ++frame) {
            lod.begin(settings.lod, camera, 720, false);
            builder.build(pair, request, settings, camera, lod, 1, castsShadows);
        }
        ASSERT_TRUE(builder.blobs().empty());
        ASSERT_TRUE(builder.takenBlobs().empty());
        EXPECT_EQ(builder.casters().empty(), !castsShadows);
        double section = 0.0, volume = 0.0;
        for (const render::MediumCaster& caster : builder.casters()) {
            section += double(caster.crossSection);
            volume += std::pow(double(caster.radius), 3.0);
        }
        if (!castsShadows)
            continue;
        EXPECT_LE(builder.casters().size(), 16u);
        EXPECT_NEAR(section, 100.0, 1e-3);
        EXPECT_NEAR(volume, 100.0 * 0.125, 1e-3);
    }
}
