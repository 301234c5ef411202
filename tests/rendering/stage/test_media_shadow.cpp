// The shadow of media on surfaces that the view does not draw, against the closed form of the optical depth.
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "rendering/frame/exposure.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/stage/stage_renderer.h"
#include "rendering/techniques/draw_techniques.h"
#include "shaders/formulas/formula.h"
#include "view_fixture.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace fx;
using namespace fx::test;

namespace {

constexpr int kSize = 64;
constexpr float kGround = 20.0f; ///< [m] half side
constexpr float kPi = std::numbers::pi_v<float>;

class MediaShadow : public ViewTest
{
protected:
    void SetUp() override
    {
        ViewTest::SetUp();
        makeTargets(kSize, kSize);
        stage_ = std::make_unique<render::StageRenderer>(device_.get());
        render::StageMesh mesh;
        const glm::vec3 corner[] = {{-kGround, 0.0f, kGround},
                                    {kGround, 0.0f, kGround},
                                    {kGround, 0.0f, -kGround},
                                    {-kGround, 0.0f, -kGround}};
        for (const int i : {0, 1, 2, 0, 2, 3}) {
            mesh.positions.push_back(corner[i]);
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
            mesh.colors.emplace_back(1.0f);
        }
        ASSERT_TRUE(stage_->setMesh(mesh).ok());
        render::Lighting& lighting = view_->settings().lighting;
        lighting.sunDirection = glm::normalize(glm::vec3(0.4f, 1.0f, -0.3f));
        lighting.sunIlluminance = glm::vec3(1000.0f);
        lighting.groundAlbedo = 0.0f;
    }
    void TearDown() override
    {
        stage_.reset();
        ViewTest::TearDown();
    }

    render::FrameRequest request(const glm::dvec3& eye = {9.0, 6.0, 12.0})
    {
        render::FrameRequest request;
        request.camera = render::perspectiveView({eye, {0.0, 0.0, 0.0}}, 0.9f, 1.0f, 0.1f);
        request.targets.color = color_->name();
        request.targets.width = request.targets.height = kSize;
        return request;
    }

    std::vector<float> stagePicture(const render::FrameRequest& frame, const render::StageLighting& lit)
    {
        EXPECT_TRUE(stage_->render(frame.camera, lit, kEv100, kSize, kSize).ok());
        return render::readTexture(*device_, stage_->colorTexture(), kSize, kSize, 4);
    }

    void prepare(const base::FrameSnapshot& snapshot, const render::FrameRequest& request)
    {
        base::SnapshotPair pair;
        pair.newer = &snapshot;
        const base::Status status = view_->prepareLights(pair, request);
        ASSERT_TRUE(status.ok()) << status.message();
    }

    /// The ground in the light of the sun alone, in units of the light without a shadow.
    std::vector<float> ground(const render::FrameRequest& request, bool isShaded)
    {
        render::StageLighting lit;
        lit.lighting = view_->settings().lighting;
        if (isShaded) {
            lit.sunShadow = view_->mediaShadow(render::LightKind::Sun, 0, request.camera.origin);
            lit.shadowTexture = view_->mediaShadowTexture();
        }
        const base::Status status = stage_->render(request.camera, lit, kEv100, kSize, kSize);
        EXPECT_TRUE(status.ok()) << status.message();
        return render::readTexture(*device_, stage_->colorTexture(), kSize, kSize, 4);
    }

    /// Where a pixel sees the ground; false: it sees none.
    static bool groundAt(const render::CameraView& camera, int x, int y, glm::vec3& out)
    {
        const glm::mat4 back = glm::inverse(camera.projection * camera.view);
        const glm::vec2 ndc = (glm::vec2(float(x), float(y)) + 0.5f) * (2.0f / float(kSize)) - 1.0f;
        const glm::vec4 nearest = back * glm::vec4(ndc, -1.0f, 1.0f),
                        farther = back * glm::vec4(ndc, 0.5f, 1.0f);
        const glm::vec3 a = glm::vec3(nearest) / nearest.w, b = glm::vec3(farther) / farther.w;
        const glm::vec3 eye = a + glm::vec3(camera.origin), d = glm::normalize(b - a);
        if (d.y > -0.05f)
            return false;
        out = eye - (eye.y / d.y) * d;
        return std::max(std::abs(out.x), std::abs(out.z)) < kGround - 0.5f;
    }

    /// Optical depth from a place to the sun.
    float depthToSun(const std::vector<TestBlob>& blobs, const glm::vec3& place) const
    {
        const glm::vec3 sun = view_->settings().lighting.sunDirection;
        float sum = 0.0f;
        for (const TestBlob& blob : blobs) {
            const glm::vec3 d = blob.center - place;
            const float tc = glm::dot(d, sun);
            const float h = glm::length(d - tc * sun);
            if (h < blob.radius)
                sum += formula::fxKernelOpticalDepth(blob.crossSection, blob.radius, h, tc, 0.0f, 1e30f);
        }
        return sum;
    }

    std::unique_ptr<render::StageRenderer> stage_;
};

/// A ball of an optical depth through its middle.
std::vector<TestBlob> ball(float depth)
{
    TestBlob blob{{0.0f, 3.0f, 0.0f}, 2.0f, 1.0f};
    blob.crossSection = depth / formula::fxKernelOpticalDepth(1.0f, blob.radius, 0.0f, 0.0f, -1e30f, 1e30f);
    return {blob};
}

/// A wide and even slab of a vertical optical depth.
std::vector<TestBlob> slab(float depth)
{
    constexpr float kApart = 0.75f; // [m] with radius 1.5 the sum is even within a few percent
    std::vector<TestBlob> blobs;
    for (int x = -8; x <= 8; ++x)
        for (int z = -8; z <= 8; ++z)
            blobs.push_back({{kApart * float(x), 4.0f, kApart * float(z)}, 1.5f, depth * kApart * kApart});
    return blobs;
}

} // namespace

TEST_F(MediaShadow, groundIsDarkerByWhatTheClosedFormSaysAtEveryPixel)
{
    for (const bool isBall : {true, false})
        for (const float depth : {0.1f, 0.5f, 1.0f, 3.0f}) {
            const std::vector<TestBlob> blobs = isBall ? ball(depth) : slab(depth);
            const auto snapshot = snapshotOf(blobs);
            const render::FrameRequest frame = request();
            prepare(snapshot, frame);
            const std::vector<float> shaded = ground(frame, true), open = ground(frame, false);
            double worst = 0.0, darkest = 1.0;
            for (int y = 0; y < kSize; ++y)
                for (int x = 0; x < kSize; ++x) {
                    glm::vec3 place;
                    if (!groundAt(frame.camera, x, y, place))
                        continue;
                    const size_t at = size_t(y * kSize + x) * 4;
                    const double ratio = double(shaded[at]) / double(open[at]);
                    const double expected = std::exp(-double(depthToSun(blobs, place)));
                    worst = std::max(worst, std::abs(ratio - expected));
                    darkest = std::min(darkest, expected);
                }
            EXPECT_LT(darkest, std::exp(-0.9 * double(depth))) << "the shadow is in the picture";
            EXPECT_LT(worst, 0.02) << (isBall ? "ball " : "slab ") << depth;
        }
}

TEST_F(MediaShadow, inPointsAndSpotsFollowsTheClosedFormToo)
{
    render::HostLights& lights = view_->settings().hostLights;
    view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
    lights.count = 2;
    lights.lights[0] = {{0.0, 6.0, 0.0}, glm::vec3(500.0f), 0.05f};
    lights.lights[1] = {
        {3.0, 6.0, 1.0}, glm::vec3(400.0f), 0.05f, glm::normalize(glm::vec3(-3, -6, -1)), 0.8f, 0.6f};
    const std::vector<TestBlob> blobs = ball(1.5f);
    const auto snapshot = snapshotOf(blobs);
    const render::FrameRequest frame = request();
    prepare(snapshot, frame);
    for (uint32_t i = 0; i < 2; ++i) {
        const render::HostLight& light = lights.lights[i];
        render::StageLight given{light};
        render::StageLighting lit;
        lit.lighting.groundAlbedo = 0.0f;
        lit.lights = {&given, 1};
        const std::vector<float> open = stagePicture(frame, lit);
        given.shadow = view_->mediaShadow(render::LightKind::Host, i, frame.camera.origin);
        lit.shadowTexture = view_->mediaShadowTexture();
        EXPECT_GT(given.shadow->tiles[0].w, 0.5f);
        const std::vector<float> shaded = stagePicture(frame, lit);
        double worst = 0.0;
        int shadowed = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                glm::vec3 place;
                const size_t at = size_t(y * kSize + x) * 4;
                if (!groundAt(frame.camera, x, y, place) || !(open[at] > 1e-4f))
                    continue;
                const glm::vec3 toLight = glm::vec3(light.position) - place;
                const glm::vec3 d = glm::normalize(toLight);
                const glm::vec3 toBall = blobs[0].center - place;
                const float tc = glm::dot(toBall, d), h = glm::length(toBall - tc * d);
                const float depth =
                    h < blobs[0].radius
                        ? formula::fxKernelOpticalDepth(blobs[0].crossSection, blobs[0].radius, h, tc, 0.0f,
                                                        glm::length(toLight))
                        : 0.0f;
                worst = std::max(worst, std::abs(double(shaded[at] / open[at]) - std::exp(-double(depth))));
                shadowed += depth > 0.5f ? 1 : 0;
            }
        EXPECT_GT(shadowed, 50);
        EXPECT_LT(worst, 0.05) << i; // planes of points have half of the texels
    }
}

TEST_F(MediaShadow, isThereWhereTheMediaAreOutOfView)
{
    const auto snapshot = snapshotOf(ball(3.0f));
    render::FrameRequest frame = request();
    // looks down at the ground from below the ball
    frame.camera = render::perspectiveView({{0.5, 0.9, 0.5}, {-0.9, 0.0, 0.7}}, 0.5f, 1.0f, 0.05f);
    prepare(snapshot, frame);
    const std::vector<float> shaded = ground(frame, true), open = ground(frame, false);
    const size_t middle = size_t(kSize / 2 * kSize + kSize / 2) * 4;
    EXPECT_LT(shaded[middle], 0.5f * open[middle]);
}

TEST_F(MediaShadow, aPreparedFrameIsDrawnWithoutDoingAnythingTwice)
{
    const auto snapshot = snapshotOf(slab(1.0f));
    render::FrameRequest frame = request();
    frame.camera.origin.x += 1.0;
    setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
    base::SnapshotPair pair;
    pair.newer = &snapshot;
    const auto countOf = [&](std::string_view name) {
        const auto names = view_->executedPasses();
        return std::count(names.begin(), names.end(), name);
    };
    prepare(snapshot, frame);
    ASSERT_TRUE(view_->render(pair, frame).ok());
    const Picture prepared = read(color_->name());
    EXPECT_EQ(countOf("light slices"), 1);
    EXPECT_EQ(countOf("light list"), 1);
    EXPECT_EQ(countOf("blob upload"), 1);
    EXPECT_FALSE(view_->statistics().keptLists);
    for (int again = 0; again < 2; ++again) { // everything rests
        setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
        prepare(snapshot, frame);
        ASSERT_TRUE(view_->render(pair, frame).ok());
        EXPECT_EQ(countOf("light slices"), 0);
        EXPECT_EQ(countOf("light list"), 0);
        EXPECT_TRUE(view_->statistics().keptLists);
        EXPECT_EQ(maxDifference(read(color_->name()), prepared), 0.0);
    }
    // prepared for another camera, or twice: the picture is that of the frame
    render::FrameRequest other = frame;
    other.camera.origin.z += 0.5;
    prepare(snapshot, other);
    prepare(snapshot, other);
    setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
    ASSERT_TRUE(view_->render(pair, frame).ok());
    EXPECT_LT(maxDifference(read(color_->name()), prepared), 2e-3) << "but for planes at other places";
    EXPECT_FALSE(view_->statistics().keptLists);
}

// What erosion makes of the medium is in the planes before the stage reads them.
TEST_F(MediaShadow, hasTheBumpsInTheFirstPreparedFrame)
{
    namespace constant = base::material_constant;
    const base::KindId material = schema_.add(base::kMaterialKind);
    view_->settings().composition = render::Composition::Volume;
    const std::vector<TestBlob> blobs = ball(3.0f);
    const auto shown = [&](bool isDetailed) {
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        const base::FrameSnapshot smooth = snapshotOf(blobs);
        snapshot.begin(0, ++sequence_);
        for (size_t g = 0; g < smooth.groupCount(); ++g) {
            const base::SnapshotGroup& from = smooth.group(g);
            const uint32_t count = uint32_t(from.count());
            if (count == 0)
                continue;
            base::SnapshotGroup& to = snapshot.addGroup(schema_.find("blob"), count);
            to.editInfo() = from.info();
            std::copy_n(from.ids().begin(), count, to.editIds().begin());
            std::copy(from.constants().begin(), from.constants().end(), to.editConstants().begin());
            for (size_t c = 0; c < base::blob_column::Count; ++c)
                std::copy_n(from.column(c).begin(), count, to.editColumn(c).begin());
            if (!isDetailed)
                continue;
            base::SnapshotGroup& carried = snapshot.addGroup(material, count);
            const base::KindId kind = carried.info().kind;
            carried.editInfo() = from.info();
            carried.editInfo().kind = kind;
            std::copy_n(from.ids().begin(), count, carried.editIds().begin());
            for (size_t c = 0; c < base::material_column::Count; ++c)
                std::copy_n(from.column(base::blob_column::PositionX + c % 3).begin(), count,
                            carried.editColumn(c).begin());
            const auto set = [&](size_t c, float value) { carried.editConstants()[c] = value; };
            set(constant::Generation, 6.0f);
            set(constant::Fade, 0.3f);
            for (const size_t c : {constant::Length0, constant::Length1})
                set(c, 0.8f);
            for (const size_t c : {constant::Growth0, constant::Growth1})
                set(c, 1.0f);
            set(constant::Thinnest, 0.1f);
            set(constant::Densest, 5.0f);
            set(constant::Ramp, 0.25f);
            set(constant::Gain, 0.55f);
        }
        return snapshot;
    };
    const render::FrameRequest frame = request();
    const auto difference = [](const std::vector<float>& a, const std::vector<float>& b) {
        float most = 0.0f;
        for (size_t i = 0; i < a.size(); ++i)
            most = std::max(most, std::abs(a[i] - b[i]));
        return most;
    };
    const std::vector<float> open = ground(frame, false);
    const float brightest = *std::max_element(open.begin(), open.end());
    const base::FrameSnapshot plain = shown(false), bumpy = shown(true);
    prepare(plain, frame);
    const std::vector<float> smooth = ground(frame, true);
    prepare(bumpy, frame);
    const std::vector<float> first = ground(frame, true);
    EXPECT_GT(difference(first, smooth), 0.1f * brightest);
    base::SnapshotPair pair;
    pair.newer = &bumpy;
    setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
    ASSERT_TRUE(view_->render(pair, frame).ok());
    const auto names = view_->executedPasses();
    EXPECT_EQ(std::count(names.begin(), names.end(), "field fill"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "field slices"), 1);
    const Picture prepared = read(color_->name());
    EXPECT_EQ(difference(ground(frame, true), first), 0.0f);
    // without preparation the frame is the same
    setPicture(std::vector<float>(kSize * kSize * 4, 0.0f));
    render::FrameRequest again = frame;
    again.resetHistory = true;
    ASSERT_TRUE(view_->render(pair, again).ok());
    EXPECT_EQ(maxDifference(read(color_->name()), prepared), 0.0);
}

// The intensity of a fire is that outside of its own medium, so that eroded soot must not hide it again.
TEST_F(MediaShadow, ofAFireIsNotThatOfItsOwnBumps)
{
    view_->settings().composition = render::Composition::Volume;
    view_->settings().lighting.sunIlluminance = glm::vec3(0.0f);
    std::vector<TestBlob> blobs = ball(12.0f);
    blobs[0].emission = 2.0f;
    const auto snapshot = detailedSnapshotOf(blobs, 1.0f, 0.55f);
    const render::FrameRequest frame = request();
    prepare(snapshot, frame);
    std::array<render::EffectLight, 1> fires;
    ASSERT_EQ(render::effectLights(snapshot, fires), 1u);
    render::StageLight given = render::effectStageLight(fires[0]);
    render::StageLighting lit;
    lit.lighting.groundAlbedo = 0.0f;
    lit.lights = {&given, 1};
    const std::vector<float> open = stagePicture(frame, lit);
    given.shadow = view_->mediaShadow(render::LightKind::Effect, 0, frame.camera.origin);
    lit.shadowTexture = view_->mediaShadowTexture();
    ASSERT_GT(given.shadow->tiles[0].w, 0.5f);
    const std::vector<float> shaded = stagePicture(frame, lit);
    double worst = 0.0;
    int seen = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            glm::vec3 place;
            const size_t at = size_t(y * kSize + x) * 4;
            if (!groundAt(frame.camera, x, y, place) || !(open[at] > 0.0f))
                continue;
            ++seen;
            worst = std::max(worst, 1.0 - double(shaded[at] / open[at]));
        }
    EXPECT_GT(seen, 500);
    EXPECT_LT(worst, 0.02);
}
