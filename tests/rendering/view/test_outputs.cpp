// Instances, motion and depths against a march of small steps, in all compositions.
#include "rendering/gl/gl_read_texture.h"
#include "tests/rendering/gl/gl_host_state.h"
#include "tests/rendering/gl/heap_counter.h"
#include "tests/rendering/view/outputs_truth.h"
#include "tests/rendering/view/particle_fixture.h"

#include <algorithm>
#include <string>

using namespace fx;
using namespace fx::test;
namespace column = base::blob_column;
namespace constant = base::particle_constant;
namespace output = render::view_output;

namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr double kStep = 1.0 / 60.0;  ///< [s] between the two snapshots
constexpr double kFrame = 1.0 / 30.0; ///< [s] between the two frames
constexpr render::Composition kCompositions[] = {render::Composition::Sorted, render::Composition::Slabs,
                                                 render::Composition::Volume};

struct Seen
{
    std::vector<uint32_t> ids;
    std::vector<float> motion, first, mean, depth;

    uint64_t id(size_t i) const { return ids[2 * i] | uint64_t(ids[2 * i + 1]) << 32; }
};

class Outputs : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kWidth, kHeight);
        view_->settings().outputs = output::kAll;
    }

    static render::CameraView camera(const glm::dvec3& position = {0.0, 0.0, 6.0},
                                     const glm::dvec3& target = glm::dvec3(0.0))
    {
        return render::perspectiveView({position, target}, 0.8f, float(kWidth) / kHeight, 0.1f);
    }

    /// Two snapshots around the moment at which balls are where `balls` says.
    void addBalls(base::FrameSnapshot& snapshot, const std::vector<MovingBall>& balls, double seconds)
    {
        uint32_t solver = 0;
        for (size_t i = 0; i < balls.size(); ++i) {
            const MovingBall& ball = balls[i];
            auto& group = snapshot.addGroup(schema_.find("blob"), 1);
            for (size_t c = 0; c < column::Count; ++c)
                group.editColumn(c)[0] = 0.0f;
            for (size_t k = 0; k < 3; ++k) {
                group.editColumn(column::PositionX + k)[0] =
                    float(ball.center[int(k)] + seconds * ball.velocity[int(k)]);
                group.editColumn(column::VelocityX + k)[0] = float(ball.velocity[int(k)]);
            }
            group.editColumn(column::Radius)[0] = float(ball.radius);
            group.editColumn(column::CrossSection)[0] = float(ball.crossSection());
            group.editColumn(column::Age)[0] = 1.0f;
            group.editIds()[0] = i;
            group.editInfo().count = 1;
            group.editInfo().solver = solver++;
            group.editInfo().instance = ball.instance;
            group.editConstants()[base::blob_constant::Layer] = 1.0f;
        }
    }

    base::FrameSnapshot snapshotAt(const std::vector<MovingBall>& balls, double seconds)
    {
        base::FrameSnapshot snapshot(&schema_, std::pmr::get_default_resource());
        snapshot.begin(base::Ticks((1.0 + seconds) * double(base::kTicksPerSecond)), ++sequence_);
        addBalls(snapshot, balls, seconds);
        return snapshot;
    }

    render::FrameRequest request(const render::CameraView& camera, double time)
    {
        render::FrameRequest request;
        request.camera = camera;
        request.targets = {color_->name(), useDepth_ ? depth_->name() : 0, 0, false, kWidth, kHeight};
        request.interpolation = 0.5;
        request.time = time;
        request.deltaTime = kFrame;
        return request;
    }

    Seen readOutputs()
    {
        const auto floats = [&](size_t number, int channels) {
            return render::readTexture(*device_, view_->output(number), kWidth, kHeight, channels);
        };
        return {render::readUintTexture(*device_, view_->output(0), kWidth, kHeight, 2), floats(1, 2),
                floats(2, 1), floats(3, 1), floats(4, 1)};
    }

    /// The frame at 1 s, after one with another camera.
    Seen seenAfter(const base::SnapshotPair& pair, const render::CameraView& now,
                   const render::CameraView& past)
    {
        EXPECT_TRUE(view_->render(pair, request(past, 1.0 - kFrame)).ok());
        const base::Status status = view_->render(pair, request(now, 1.0));
        EXPECT_TRUE(status.ok()) << status.message();
        return readOutputs();
    }

    Seen seen(const std::vector<MovingBall>& balls, const render::CameraView& now,
              const render::CameraView& past, render::Composition composition)
    {
        view_->settings().composition = composition;
        const auto older = snapshotAt(balls, -0.5 * kStep), newer = snapshotAt(balls, 0.5 * kStep);
        return seenAfter({&newer, &older}, now, past);
    }

    struct Bounds
    {
        double first, mean;  ///< [m]
        double motion;       ///< [pixel]
        double opticalDepth; ///< [1] relative
        double lead;         ///< [1] least lead of an instance that must be told
    };
    void expectTrue(const Seen& seen, const std::vector<MovingBall>& balls, const render::CameraView& now,
                    const render::CameraView& past, const Bounds& bounds, int stride = 3)
    {
        size_t told = 0;
        for (int y = 1; y < kHeight; y += stride)
            for (int x = 1; x < kWidth; x += stride) {
                const TrueOutputs truth =
                    trueOutputs(balls, now, past, kFrame, x + 0.5, y + 0.5, kWidth, kHeight);
                const size_t i = size_t(y) * kWidth + size_t(x);
                const std::string where = "pixel " + std::to_string(x) + ", " + std::to_string(y);
                EXPECT_NEAR(seen.depth[i], truth.opticalDepth,
                            bounds.opticalDepth * truth.opticalDepth + 1e-5)
                    << where;
                if (truth.opacity > 1e-4) {
                    EXPECT_NEAR(seen.mean[i], truth.mean, bounds.mean) << where;
                }
                if (std::abs(truth.opticalDepth - 0.01) < 2e-4)
                    continue; // on the silhouette
                if (truth.instance == 0) {
                    EXPECT_EQ(seen.id(i), 0u) << where;
                    EXPECT_TRUE(std::isinf(seen.first[i])) << where;
                    EXPECT_EQ(seen.motion[2 * i], 0.0f) << where;
                    continue;
                }
                EXPECT_NEAR(seen.first[i], truth.first, bounds.first) << where;
                EXPECT_NEAR(seen.motion[2 * i], truth.motion.x, bounds.motion) << where;
                EXPECT_NEAR(seen.motion[2 * i + 1], truth.motion.y, bounds.motion) << where;
                if (truth.lead > bounds.lead) {
                    EXPECT_EQ(seen.id(i), truth.instance) << where;
                    ++told;
                }
            }
        EXPECT_GT(told, 20u);
    }
};

const MovingBall kBall{{0.2, -0.1, 0.0}, 1.3, 2.0, {1.5, -0.7, 2.0}, 7};
const std::vector<MovingBall> kTwo{{{-0.4, 0.1, 1.0}, 0.9, 1.2, {2.0, 0.5, -1.0}, (uint64_t(3) << 32) | 5},
                                   {{0.5, -0.2, 0.4}, 1.2, 3.0, {-1.0, 1.0, 0.0}, 9}};

} // namespace

TEST_F(Outputs, aBallHasTheDepthsMotionAndSilhouetteOfItsIntegralInAllCompositions)
{
    for (const render::Composition composition : kCompositions) {
        SCOPED_TRACE(int(composition));
        const auto now = camera(), past = camera({0.1, -0.05, 6.2}, {0.05, 0.0, 0.0});
        expectTrue(seen({kBall}, now, past, composition), {kBall}, now, past, {2e-3, 2e-3, 0.02, 1e-4, 0.01},
                   1);
    }
}

TEST_F(Outputs, ballsOfTwoInstancesThatOverlapAreToldApartInAllCompositions)
{
    for (const render::Composition composition : kCompositions) {
        SCOPED_TRACE(int(composition));
        const auto now = camera(), past = camera({0.1, -0.05, 6.2}, {0.05, 0.0, 0.0});
        expectTrue(seen(kTwo, now, past, composition), kTwo, now, past, {2e-3, 4e-3, 0.03, 1e-4, 0.01}, 2);
    }
}

TEST_F(Outputs, manyInstancesOfOneCloudAreTold)
{
    std::vector<MovingBall> many;
    for (int i = 0; i < 40; ++i) {
        const double a = 2.4 * i, r = 0.25 * std::sqrt(double(i));
        many.push_back({{r * std::cos(a), r * std::sin(a), 0.4 * std::sin(3.0 * a)},
                        0.6,
                        0.5 + 0.05 * i,
                        {0.0, 0.0, 0.1 * i},
                        uint64_t(100 + i)});
    }
    const auto now = camera();
    expectTrue(seen(many, now, now, render::Composition::Sorted), many, now, now,
               {4e-3, 1e-2, 0.05, 1e-4, 0.05});
}

TEST_F(Outputs, thousandsOfBallsInOneTileAreTheOneBall)
{
    const MovingBall whole{{0.0, 0.0, -12.0}, 0.5, 2.0, {1.5, -0.7, 2.0}, 7};
    MovingBall part = whole;
    constexpr size_t kParts = 4500;
    part.depth /= double(kParts);
    const auto now = camera(), past = camera({0.1, -0.05, 6.2}, {0.05, 0.0, 0.0});
    const Seen one = seen({whole}, now, past, render::Composition::Sorted);
    const Seen many = seen(std::vector<MovingBall>(kParts, part), now, past, render::Composition::Sorted);
    size_t met = 0;
    for (size_t i = 0; i < size_t(kWidth) * kHeight; ++i) {
        met += one.id(i) == 7 ? 1 : 0;
        ASSERT_EQ(one.id(i), many.id(i)) << i;
        if (one.id(i) != 7)
            continue;
        ASSERT_NEAR(one.depth[i], many.depth[i], 1e-3) << i;
        ASSERT_NEAR(one.mean[i], many.mean[i], 1e-2) << i;
        ASSERT_NEAR(one.motion[2 * i], many.motion[2 * i], 1e-3) << i;
    }
    EXPECT_GT(met, 5u);
}

TEST_F(Outputs, aParallelViewMovesByMetres)
{
    const auto now =
        render::orthographicView({{0, 0, 10}, {0, 0, 0}}, 6.4f, float(kWidth) / kHeight, 0.1f, 100.0f);
    const auto past =
        render::orthographicView({{0.3, 0, 10}, {0.3, 0, 0}}, 6.4f, float(kWidth) / kHeight, 0.1f, 100.0f);
    const Seen picture = seen({kBall}, now, past, render::Composition::Slabs);
    const size_t middle = size_t(kHeight / 2) * kWidth + kWidth / 2;
    EXPECT_NEAR(picture.motion[2 * middle], 10.0 * (1.5 * kFrame + 0.3), 1e-3) << "10 pixels a metre";
    EXPECT_NEAR(picture.motion[2 * middle + 1], 10.0 * -0.7 * kFrame, 1e-3);
    EXPECT_EQ(picture.id(middle), 7u);
}

TEST_F(Outputs, anEffectThatIsMovedAndTurnedMovesItsBalls)
{
    const std::vector<MovingBall> resting{{{1.0, 0.0, 0.0}, 1.0, 2.0, glm::dvec3(0.0), 3}};
    auto older = snapshotAt(resting, -0.5 * kStep), newer = snapshotAt(resting, 0.5 * kStep);
    const float turn = 0.01f;
    for (auto* snapshot : {&older, &newer}) {
        const float sign = snapshot == &newer ? 1.0f : -1.0f;
        auto& place = snapshot->editGroup(0).editInfo().placement;
        place.position = {0.0, 0.005 * sign, 0.0};
        place.rotation = glm::angleAxis(sign * turn, glm::vec3(0, 0, 1));
    }
    const auto now =
        render::orthographicView({{0, 0, 10}, {0, 0, 0}}, 6.4f, float(kWidth) / kHeight, 0.1f, 100.0f);
    const Seen picture = seenAfter({&newer, &older}, now, now);
    const size_t at = size_t(kHeight / 2) * kWidth + kWidth / 2 + 10;
    EXPECT_NEAR(picture.motion[2 * at + 1], 10.0 * (2 * 0.005 + 2 * turn) / kStep * kFrame, 0.02);
    EXPECT_NEAR(picture.motion[2 * at], 0.0, 0.02);
}

TEST_F(Outputs, withoutATimeBetweenFramesOnlyTheCameraMoves)
{
    const auto older = snapshotAt({kBall}, -0.5 * kStep), newer = snapshotAt({kBall}, 0.5 * kStep);
    ASSERT_TRUE(view_->render({&newer, &older}, request(camera(), 1.0)).ok());
    const size_t middle = size_t(kHeight / 2) * kWidth + kWidth / 2;
    EXPECT_GT(std::abs(readOutputs().motion[2 * middle]), 0.5f) << "the first frame counts deltaTime";
    ASSERT_TRUE(view_->render({&newer, &older}, request(camera(), 1.0)).ok());
    EXPECT_NEAR(readOutputs().motion[2 * middle], 0.0f, 1e-4f);
}

TEST_F(Outputs, anOpaqueSurfaceOfTheHostEndsRaysAndIsNoInstance)
{
    setDepth(std::vector<float>(size_t(kWidth) * kHeight, 1.0f - 0.1f / 3.0f)); // 3 m before the eye
    const auto now = camera();
    const Seen hidden = seen({kBall}, now, now, render::Composition::Volume);
    EXPECT_EQ(*std::ranges::max_element(hidden.ids), 0u);
    EXPECT_TRUE(std::ranges::all_of(hidden.first, [](float x) { return std::isinf(x); }));
    EXPECT_EQ(*std::ranges::max_element(hidden.depth), 0.0f);
}

TEST_F(Outputs, spritesAndMeshesHaveInstancesMotionAndDepths)
{
    makeTargets(kWidth, kHeight);
    const auto flat =
        render::orthographicView({{0, 0, 10}, {0, 0, 0}}, 6.4f, float(kWidth) / kHeight, 0.1f, 100.0f);
    const auto particlesAt = [&](double seconds) {
        base::FrameSnapshot snapshot = emptySnapshot(1.0 + seconds);
        const auto add = [&](const glm::vec3& center, const glm::vec3& velocity, uint64_t instance,
                             base::ParticleBlend blend) -> base::SnapshotGroup& {
            TestParticle p{center + float(seconds) * velocity, 1.0f, {1, 1, 1, 0.5f}};
            auto& group = addParticles(snapshot, {p}, base::particle_column::kAlways);
            group.editInfo().instance = instance;
            set(group, constant::Blend, float(blend));
            return group;
        };
        add({-3, 0, 0}, {3, 0, 0}, 11, base::ParticleBlend::Alpha);
        add({0, 0, 1}, {0, -3, 0}, 12, base::ParticleBlend::Additive);
        auto& solid = add({3, 0, 2}, {0, 0, 0}, 13, base::ParticleBlend::Opaque);
        set(solid, constant::Shape, float(base::ParticleShape::Mesh));
        const glm::vec3 n(0, 0, 1);
        const std::vector<base::MeshVertex> corners{{{-1, -1, 0}, n, {0, 0}},
                                                    {{1, -1, 0}, n, {1, 0}},
                                                    {{1, 1, 0}, n, {1, 1}},
                                                    {{-1, 1, 0}, n, {0, 1}}};
        static const float mesh = float(*assets_.addMesh(corners, std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
        set(solid, constant::Mesh, mesh);
        solid.editInfo().placement.rotation = glm::angleAxis(float(seconds), glm::vec3(0, 0, 1)); // 1 rad/s
        return snapshot;
    };
    const auto older = particlesAt(-0.5 * kStep), newer = particlesAt(0.5 * kStep);
    for (const render::Composition composition : kCompositions) {
        SCOPED_TRACE(int(composition));
        view_->settings().composition = composition;
        const Seen picture = seenAfter({&newer, &older}, flat, flat);
        const auto at = [](double x, double y) {
            return size_t(kHeight / 2 + int(10 * y)) * kWidth + size_t(kWidth / 2 + int(10 * x));
        };
        const size_t sprite = at(-3, 0), glow = at(0, 0), mesh = at(3, 0), edge = at(3.5, 0),
                     nothing = at(0, 2.5);
        EXPECT_EQ(picture.id(sprite), 11u);
        EXPECT_NEAR(picture.motion[2 * sprite], 10 * 3 * kFrame, 1e-2);
        EXPECT_NEAR(picture.first[sprite], 10.0, 1e-3);
        EXPECT_NEAR(picture.mean[sprite], 10.0, 1e-3);
        EXPECT_NEAR(picture.depth[sprite], -std::log(0.5), 0.02);
        EXPECT_EQ(picture.id(glow), 12u) << "what only adds has an instance";
        EXPECT_NEAR(picture.motion[2 * glow + 1], -10 * 3 * kFrame, 1e-2);
        EXPECT_TRUE(std::isinf(picture.first[glow])) << "and hides nothing";
        EXPECT_EQ(picture.id(mesh), 13u);
        EXPECT_NEAR(picture.first[mesh], 8.0, 1e-3);
        EXPECT_NEAR(picture.mean[mesh], 8.0, 1e-3);
        EXPECT_NEAR(picture.motion[2 * edge + 1], 10 * 3.5 * kFrame, 0.05 * 10 * 3.5 * kFrame) << "it turns";
        EXPECT_EQ(picture.id(nothing), 0u);
        EXPECT_TRUE(std::isinf(picture.mean[nothing]));
    }
}

TEST_F(Outputs, layersHaveTheDepthsOfTheIntegralInAllCompositions)
{
    view_->settings().layerOutputs = true;
    const auto now = camera();
    for (const render::Composition composition : kCompositions) {
        SCOPED_TRACE(int(composition));
        const bool isVolume = composition == render::Composition::Volume;
        seen({kBall}, now, now, composition);
        const auto depth = read(view_->layers().depth, 1).texels,
                   whole = read(view_->layers().opticalDepth, 1).texels;
        for (int y = 1; y < kHeight; y += 3)
            for (int x = 1; x < kWidth; x += 3) {
                const size_t i = size_t(y) * kWidth + size_t(x);
                const TrueOutputs truth =
                    trueOutputs({kBall}, now, now, 0.0, x + 0.5, y + 0.5, kWidth, kHeight);
                EXPECT_NEAR(whole[i], truth.opticalDepth, isVolume ? 0.03 : 1e-4) << x << " " << y;
                if (truth.opticalDepth > 0.05) {
                    EXPECT_NEAR(depth[i], truth.mean, isVolume ? 0.04 : 0.02) << x << " " << y;
                }
            }
    }
}

TEST_F(Outputs, nothingOfThemExistsWhileTheyAreOff)
{
    view_->settings().outputs = 0;
    const auto now = camera();
    const auto older = snapshotAt(kTwo, -0.5 * kStep), newer = snapshotAt(kTwo, 0.5 * kStep);
    const base::SnapshotPair pair{&newer, &older};
    ASSERT_TRUE(view_->warmUp().ok());
    ASSERT_TRUE(view_->render(pair, request(now, 1.0)).ok());
    const uint64_t bytes = view_->statistics().textureBytes, memory = view_->statistics().unsharedBytes;
    const uint32_t passes = view_->statistics().passes;
    EXPECT_EQ(view_->statistics().programsCompiled, 0u);
    for (size_t i = 0; i < output::kCount; ++i)
        EXPECT_EQ(view_->output(i), 0u);
    const auto names = [&] {
        return std::vector<std::string_view>(view_->executedPasses().begin(), view_->executedPasses().end());
    };
    EXPECT_EQ(std::ranges::count(names(), "outputs"), 0);

    view_->settings().outputs = output::Motion;
    ASSERT_TRUE(view_->render(pair, request(now, 1.0)).ok());
    EXPECT_EQ(std::ranges::count(names(), "outputs"), 1);
    EXPECT_GT(view_->statistics().programsCompiled, 0u) << "they were not compiled before";
    EXPECT_GT(view_->statistics().textureBytes, bytes);
    EXPECT_NE(view_->output(1), 0u);
    for (const size_t i : {0u, 2u, 3u, 4u})
        EXPECT_EQ(view_->output(i), 0u) << "only what is asked for";

    view_->settings().outputs = 0;
    ASSERT_TRUE(view_->render(pair, request(now, 1.0)).ok());
    EXPECT_EQ(view_->statistics().passes, passes);
    EXPECT_EQ(view_->statistics().unsharedBytes, memory);
    EXPECT_EQ(view_->output(1), 0u);
}

TEST_F(Outputs, thePictureIsTheSameWithThem)
{
    const auto now = camera();
    const auto older = snapshotAt(kTwo, -0.5 * kStep), newer = snapshotAt(kTwo, 0.5 * kStep);
    for (const render::Composition composition : kCompositions) {
        const auto drawn = [&](uint32_t outputs) {
            view_->settings().outputs = outputs;
            setPicture(std::vector<float>(size_t(kWidth) * kHeight * 4, 0.5f));
            EXPECT_TRUE(view_->render({&newer, &older}, request(now, 1.0)).ok());
            return read(color_->name());
        };
        view_->settings().composition = composition;
        EXPECT_EQ(maxDifference(drawn(0), drawn(output::InstanceId | output::FirstDepth)), 0.0);
    }
}

TEST_F(Outputs, aWarmFrameAllocatesAndCompilesNothing)
{
    for (const render::Composition composition : kCompositions) {
        view_->settings().composition = composition;
        const auto a = snapshotAt(kTwo, -0.5 * kStep), b = snapshotAt(kTwo, 0.5 * kStep),
                   c = snapshotAt(kTwo, 1.5 * kStep);
        const base::SnapshotPair pairs[] = {{&b, &a}, {&c, &b}, {&a, &c}};
        render::FrameRequest one = request(camera(), 1.0);
        for (int frame = 0; frame < 9; ++frame)
            ASSERT_TRUE(view_->render(pairs[frame % 3], one).ok());
        for (int frame = 0; frame < 6; ++frame) {
            render::HeapCounter counter;
            const bool good = view_->render(pairs[frame % 3], one).ok();
            EXPECT_EQ(counter.stop(), 0) << "frame " << frame;
            ASSERT_TRUE(good);
            EXPECT_EQ(view_->statistics().programsCompiled, 0u);
        }
    }
}

TEST_F(Outputs, theHostsStateIsAsItWas)
{
    const auto older = snapshotAt(kTwo, -0.5 * kStep), newer = snapshotAt(kTwo, 0.5 * kStep);
    render::GlHost host(context_->loader());
    host.makeHostile();
    const render::GlProbe before = host.probe();
    render::FrameRequest one = request(camera(), 1.0);
    one.camera.upperLeftOrigin = true; // as the host's clip control
    EXPECT_TRUE(view_->render({&newer, &older}, one).ok());
    for (const std::string& difference : render::differences(before, host.probe()))
        ADD_FAILURE() << difference;
    host.release();
}
