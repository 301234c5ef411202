// The shadow of opaque surfaces on media: a wall, a cloud behind it, and the sun that the wall hides.
#include "rendering/stage/stage_renderer.h"
#include "view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 48;

/// A wall of 12 m x 12 m at x = 3 that both sides of can be seen, and a cloud of balls at the origin.
class OpaqueShadow : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kSize, kSize);
        stage_ = std::make_unique<render::StageRenderer>(device_.get());
        render::Lighting& lighting = view_->settings().lighting;
        lighting.sunDirection = glm::normalize(glm::vec3(1.0f, 0.2f, 0.1f));
        lighting.sunIlluminance = glm::vec3(100.0f);
        lighting.groundAlbedo = 0.0f;
        request_.camera = render::perspectiveView({{0.0, 0.5, 9.0}, {0.0, 0.0, 0.0}}, 0.7f, 1.0f, 0.1f);
        request_.targets.color = color_->name();
        request_.targets.width = request_.targets.height = kSize;
        std::vector<TestBlob> blobs;
        for (int i = 0; i < 30; ++i) {
            TestBlob blob{
                {std::sin(2.4f * float(i)), 1.3f * std::sin(1.7f * float(i)), std::cos(0.9f * float(i))}};
            blob.crossSection = 0.5f;
            blob.albedo = 0.9f;
            blobs.push_back(blob);
        }
        cloud_ = std::make_unique<base::FrameSnapshot>(snapshotOf(blobs));
    }
    void TearDown() override
    {
        stage_.reset();
        ViewTest::TearDown();
    }

    /// From `low` to 6 m above the cloud. Draws the stage, so that its shadow map exists.
    void buildWall(float low)
    {
        render::StageMesh mesh;
        const glm::vec3 corner[] = {{3, low, -6}, {3, 6, -6}, {3, 6, 6}, {3, low, 6}};
        for (const int i : {0, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0}) {
            mesh.positions.push_back(corner[i]);
            mesh.normals.emplace_back(1.0f, 0.0f, 0.0f);
            mesh.colors.emplace_back(0.5f);
        }
        ASSERT_TRUE(stage_->setMesh(mesh).ok());
        ASSERT_TRUE(
            stage_->render(request_.camera, view_->settings().lighting, {}, kEv100, kSize, kSize).ok());
    }

    Picture show(const render::HostShadowMap& map)
    {
        setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
        request_.sunShadow = map;
        base::SnapshotPair pair;
        pair.newer = cloud_.get();
        const base::Status status = view_->render(pair, request_);
        EXPECT_TRUE(status.ok()) << status.message();
        return read(color_->name());
    }

    static double brightest(const Picture& picture)
    {
        double most = 0.0;
        for (size_t i = 0; i < picture.texels.size(); i += 4)
            most = std::max(most, double(picture.texels[i]));
        return most;
    }

    render::FrameRequest request_;
    std::unique_ptr<base::FrameSnapshot> cloud_;
    std::unique_ptr<render::StageRenderer> stage_;
};

} // namespace

TEST_F(OpaqueShadow, aWallTakesTheSunFromTheCloudBehindIt)
{
    for (const bool multiple : {false, true}) {
        view_->settings().slices.multiple = multiple;
        buildWall(-6.0f);
        const Picture open = show({});
        const Picture shaded = show(stage_->sunShadow(request_.camera.origin));
        const glm::vec3 sun = view_->settings().lighting.sunIlluminance;
        view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
        const Picture dark = show({});
        view_->settings().lighting.sunIlluminance = sun;
        EXPECT_GT(brightest(open), 0.1);
        EXPECT_LT(maxDifference(shaded, dark), 0.02 * brightest(open));
    }
}

TEST_F(OpaqueShadow, halfAWallShadesTheUpperHalfSoftly)
{
    view_->settings().lighting.sunDirection = {1.0f, 0.0f, 0.0f};
    buildWall(0.0f); // hides what is above y = 0
    render::HostShadowMap map = stage_->sunShadow(request_.camera.origin);
    const Picture open = show({});
    const Picture shaded = show(map);
    map.edge = 0.8f;
    const Picture soft = show(map);
    const auto ratio = [&](const Picture& picture, int y) {
        return picture.at(kSize / 2, y)[0] / open.at(kSize / 2, y)[0];
    };
    EXPECT_NEAR(ratio(shaded, kSize / 2 - 12), 1.0f, 0.02f) << "below";
    EXPECT_LT(ratio(shaded, kSize / 2 + 9), 0.02f) << "above";
    const auto slope = [&](const Picture& picture) {
        float steepest = 0.0f;
        for (int y = kSize / 2 - 10; y < kSize / 2 + 8; ++y)
            steepest = std::max(steepest, ratio(picture, y) - ratio(picture, y + 1));
        return steepest;
    };
    EXPECT_LT(slope(soft), 0.6f * slope(shaded));
}

TEST_F(OpaqueShadow, aReversedMapGivesTheSamePicture)
{
    buildWall(0.0f);
    render::HostShadowMap map = stage_->sunShadow(request_.camera.origin);
    const Picture standard = show(map);
    // the same depths, stored as 1 - depth
    const int size = 2048;
    std::vector<float> depths(size_t(size) * size);
    device_->gl.GetTextureImage(map.texture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, GLsizei(depths.size() * 4),
                                depths.data());
    for (float& depth : depths)
        depth = 1.0f - depth;
    auto texture = render::GlTexture::create(*device_, size, size, GL_DEPTH_COMPONENT32F, "reversed");
    ASSERT_TRUE(texture.ok());
    device_->gl.TextureSubImage2D(texture->name(), 0, 0, 0, size, size, GL_DEPTH_COMPONENT, GL_FLOAT,
                                  depths.data());
    map.texture = texture->name();
    map.depth = render::DepthConvention::Reversed;
    for (int column = 0; column < 4; ++column)
        map.fromWorld[column][2] = (column == 3 ? 1.0f : 0.0f) - map.fromWorld[column][2];
    EXPECT_LT(maxDifference(show(map), standard), 1e-3 * brightest(standard));
}

TEST_F(OpaqueShadow, onlyTheMapsOwnNumbersAreWrittenAgainWhenItMoves)
{
    buildWall(0.0f);
    render::HostShadowMap map = stage_->sunShadow(request_.camera.origin);
    (void)show(map);
    (void)show(map);
    EXPECT_TRUE(view_->statistics().keptLists);
    const auto ran = [&](std::string_view name) {
        const auto names = view_->executedPasses();
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    EXPECT_FALSE(ran("light list"));
    map.fromWorld[3][0] += 0.01f;
    (void)show(map);
    EXPECT_TRUE(view_->statistics().keptLists);
    EXPECT_TRUE(ran("light list"));
    EXPECT_FALSE(ran("light slices"));
}
