// Particles together with media: order, layers, small sizes, the budget, and what a frame leaves behind.
#include "particle_fixture.h"

#include "rendering/draw_order/draw_batcher.h"
#include "rendering/gl/gl_state_guard.h"
#include "tests/rendering/gl/gl_host_state.h"
#include "tests/rendering/gl/heap_counter.h"

#include <cmath>

using namespace fx;
using namespace fx::test;
namespace constant = base::particle_constant;
namespace column = base::particle_column;

namespace {

constexpr int kSide = 64;

class ParticleLayersTest : public ParticleTest
{
protected:
    void SetUp() override
    {
        ParticleTest::SetUp();
        makeTargets(kSide, kSide);
        const std::vector<uint8_t> texel{255, 255, 255, 255};
        white_ = float(*assets_.addImage(1, 1, true, texel));
    }
    Picture draw(const base::FrameSnapshot& snapshot)
    {
        setPicture(std::vector<float>(size_t(kSide) * kSide * 4, 0.0f));
        return renderPair(snapshot, nullptr, 1.0, flatCamera());
    }
    /// Two thick black balls at z = 2 and z = -2 and a white sprite at `z`.
    base::FrameSnapshot sandwich(float z)
    {
        TestBlob near{{0, 0, 2}, 1.5f, 3.0f};
        TestBlob far{{0, 0, -2}, 1.5f, 3.0f};
        auto snapshot = snapshotOf({near, far});
        set(addParticles(snapshot, {{{0, 0, z}, 1.5f}}, column::kAlways), constant::Texture, white_);
        return snapshot;
    }
    /// A mixture of everything.
    base::FrameSnapshot mixture()
    {
        auto snapshot =
            snapshotOf({{{0, 0, 0}, 2.0f, 2.0f, 0.5f, 0.0f, 0.3f}, {{1, 1, 1}, 1.0f, 1.0f, 1.0f}});
        std::vector<TestParticle> many;
        for (int i = 0; i < 40; ++i)
            many.push_back({{std::sin(float(i)) * 3, std::cos(float(i) * 1.7f) * 3, float(i % 7) - 3.0f},
                            0.6f,
                            {0.8f, 0.5f, 0.2f, 0.5f}});
        auto& smoke = addParticles(snapshot, many);
        set(smoke, constant::Order, float(base::ParticleOrder::Depth));
        auto& sparks = addParticles(snapshot, many);
        set(sparks, constant::Blend, float(base::ParticleBlend::Additive));
        set(sparks, constant::Layer, 0.0f);
        auto& chips = addParticles(snapshot, {{{-2, 0, 0}, 0.7f}, {{2, -1, 1}, 0.5f}});
        set(chips, constant::Blend, float(base::ParticleBlend::Opaque));
        set(chips, constant::Layer, 2.0f);
        addRibbon(snapshot, {{{-4, -4, 0}, 0.3f}, {{0, -3, 1}, 0.3f}, {{4, -4, 0}, 0.3f}});
        return snapshot;
    }
    float white_ = 0.0f;
};

} // namespace

TEST_F(ParticleLayersTest, aSpriteBetweenTwoBallsOfSmokeIsCoveredByTheNearerOnly)
{
    const float behind = draw(sandwich(-4.0f)).at(32, 32)[0];
    const float between = draw(sandwich(0.0f)).at(32, 32)[0];
    const float before = draw(sandwich(4.0f)).at(32, 32)[0];
    EXPECT_EQ(before, 1.0f);
    EXPECT_NEAR(behind, between * between, 1e-3f) << "each ball lets the same share through";
    EXPECT_LT(between, 0.5f);
}

TEST_F(ParticleLayersTest, withLayersThePictureIsTheSame)
{
    const Picture plain = draw(mixture());
    view_->settings().layerOutputs = true;
    const Picture layered = draw(mixture());
    EXPECT_LT(maxDifference(plain, layered), 2e-6);
    const Picture fire = read(view_->layers().fire);
    const Picture smoke = read(view_->layers().smoke);
    const Picture dust = read(view_->layers().dust);
    double sum[3] = {};
    for (size_t i = 0; i < plain.texels.size(); ++i) {
        ASSERT_NEAR(fire.texels[i] + smoke.texels[i] + dust.texels[i], layered.texels[i], 1e-5f);
        sum[0] += double(fire.texels[i]);
        sum[1] += double(smoke.texels[i]);
        sum[2] += double(dust.texels[i]);
    }
    for (const double part : sum)
        EXPECT_GT(part, 10.0);
    const Picture depth = read(view_->layers().depth, 1);
    EXPECT_NEAR(depth.texels[size_t(32 * kSide + 22)], 10.0f, 3.0f);
}

TEST_F(ParticleLayersTest, halfAndQuarterSizeLookAlikeAndKeepTheEdgesOfSolidThings)
{
    std::vector<float> stored(size_t(kSide) * kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) // a wall before everything on the left
            stored[size_t(y * kSide + x)] = x < 29 ? 0.02f : 0.9f;
    auto snapshot = emptySnapshot();
    addParticles(snapshot, {{{0, 0, 0}, 4.0f}, {{0.5f, 1.0f, 1.0f}, 3.0f}});
    setDepth(stored);
    const Picture full = draw(snapshot);
    for (const int divisor : {2, 4}) {
        view_->settings().layerDivisor = divisor;
        const Picture small = draw(snapshot);
        EXPECT_EQ(view_->statistics().layerDivisor, divisor);
        double sum = 0.0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                sum += std::abs(double(full.at(x, y)[0] - small.at(x, y)[0]));
                if (x < 29) {
                    ASSERT_LT(small.at(x, y)[0], 0.01f)
                        << "light leaks before the wall at " << x << ", " << y;
                }
            }
        EXPECT_LT(sum / (kSide * kSide), divisor == 2 ? 0.005 : 0.015);
        EXPECT_NEAR(small.at(29, 32)[0], full.at(29, 32)[0], 0.05f) << "no dark seam beside the wall";
    }
}

TEST_F(ParticleLayersTest, whatHidesStaysSharpWhenMediaAreSmall)
{
    view_->settings().layerDivisor = 4;
    auto snapshot = emptySnapshot();
    auto& group = addParticles(snapshot, {{{0, 0, 0}, 1.0f}});
    set(group, constant::Texture, white_);
    set(group, constant::Blend, float(base::ParticleBlend::Opaque));
    addParticles(snapshot, {{{3, 3, 0}, 0.5f, {1, 1, 1, 0.5f}}});
    const Picture picture = draw(snapshot);
    for (int x = 0; x < kSide; ++x)
        ASSERT_EQ(picture.at(x, 32)[0], x >= 26 && x < 38 ? 1.0f : 0.0f) << x;
}

TEST_F(ParticleLayersTest, whatHidesCutsSmallMediaAtItsOwnDistance)
{
    auto snapshot = emptySnapshot();
    const auto addSquare = [&](float z, float radius, const glm::vec4& color, base::ParticleBlend blend) {
        auto& group = addParticles(snapshot, {{{0, 0, z}, radius, color}});
        set(group, constant::Texture, white_);
        set(group, constant::Blend, float(blend));
    };
    addSquare(-2.0f, 20.0f, {0.75f, 0.0f, 0.0f, 0.5f}, base::ParticleBlend::Alpha);
    addSquare(0.0f, 1.3f, {0.0f, 0.5f, 0.0f, 1.0f}, base::ParticleBlend::Opaque);
    addSquare(2.0f, 20.0f, {0.0f, 0.0f, 1.0f, 0.25f}, base::ParticleBlend::Alpha);
    const glm::vec3 onSquare(0.0f, 0.375f, 0.25f);
    const glm::vec3 beside(0.75f * 0.5f * 0.75f, 0.0f, 0.25f);
    for (const bool layers : {false, true})
        for (const int divisor : {1, 2, 4}) {
            view_->settings().layerOutputs = layers;
            view_->settings().layerDivisor = divisor;
            const Picture picture = draw(snapshot);
            for (int x = 0; x < kSide; ++x)
                for (int k = 0; k < 3; ++k) // 2.6 m of 10 are 16.6 of 64 pixels
                    ASSERT_NEAR(picture.at(x, 32)[k], (x >= 24 && x < 40 ? onSquare : beside)[k], 1e-3f)
                        << "pixel " << x << " divisor " << divisor << (layers ? " layers" : "");
        }
    const Picture depth = read(view_->layers().depth, 1);
    const Picture thickness = read(view_->layers().opticalDepth, 1);
    const size_t middle = size_t(32 * kSide + 32);
    EXPECT_NEAR(depth.texels[middle], 0.25f * 8.0f + 0.75f * 10.0f, 1e-3f);
    EXPECT_NEAR(thickness.texels[middle - 16], -std::log(0.5f) - std::log(0.75f), 1e-3f);
}

TEST_F(ParticleLayersTest, smallLayersMakeTheSamePictureTogetherAsOneTarget)
{
    for (const int divisor : {2, 4}) {
        view_->settings().layerDivisor = divisor;
        view_->settings().layerOutputs = false;
        const Picture plain = draw(mixture());
        view_->settings().layerOutputs = true;
        EXPECT_LT(maxDifference(plain, draw(mixture())), 2e-6) << divisor;
    }
}

TEST_F(ParticleLayersTest, aBudgetCountsSpritesAndRibbonsButNotWhatHides)
{
    const double pixels = kSide / 10.0; // of a metre
    auto snapshot = emptySnapshot();
    addParticles(snapshot, std::vector<TestParticle>(100, {{0, 0, 0}, 1.0f}));
    view_->settings().fragmentBudget = uint64_t(100 * 4.0 * pixels * pixels) - 100;
    (void)draw(snapshot);
    EXPECT_EQ(view_->statistics().layerDivisor, 2);
    EXPECT_NEAR(double(view_->statistics().estimatedFragments), 100 * pixels * pixels, 2.0);
    view_->settings().fragmentBudget = 0;
    auto strip = emptySnapshot();
    addRibbon(strip, {{{-2, 0, 0}, 0.5f}, {{2, 0, 0}, 0.5f}});
    (void)draw(strip);
    EXPECT_NEAR(double(view_->statistics().estimatedFragments), 4.0 * pixels * pixels, 2.0 + 2.0 * pixels);
    auto chips = emptySnapshot();
    set(addParticles(chips, {{{0, 0, 0}, 1.0f}}), constant::Blend, float(base::ParticleBlend::Opaque));
    (void)draw(chips);
    EXPECT_EQ(view_->statistics().estimatedFragments, 0u);
}

TEST_F(ParticleLayersTest, sizesThatAreNoMultipleDoNotShiftThePicture)
{
    makeTargets(61, 59);
    auto snapshot = emptySnapshot();
    addParticles(snapshot, {{{-1, 1, 0}, 3.0f}});
    const auto camera = flatCamera(61.0f / 59.0f);
    setPicture(std::vector<float>(61 * 59 * 4, 0.0f));
    const Picture full = renderPair(snapshot, nullptr, 1.0, camera);
    view_->settings().layerDivisor = 4;
    setPicture(std::vector<float>(61 * 59 * 4, 0.0f));
    const Picture small = renderPair(snapshot, nullptr, 1.0, camera);
    double shift[2] = {};
    double sum = 0.0;
    for (int y = 0; y < 59; ++y)
        for (int x = 0; x < 61; ++x) {
            shift[0] += double(x) * double(small.at(x, y)[0] - full.at(x, y)[0]);
            shift[1] += double(y) * double(small.at(x, y)[0] - full.at(x, y)[0]);
            sum += double(full.at(x, y)[0]);
        }
    EXPECT_LT(std::abs(shift[0] / sum), 0.3) << "of a pixel";
    EXPECT_LT(std::abs(shift[1] / sum), 0.3);
}

TEST_F(ParticleLayersTest, aWarmFrameAllocatesNothingCompilesNothingAndLeavesTheHostsState)
{
    ASSERT_TRUE(view_->warmUp().ok());
    const auto a = mixture();
    const auto b = mixture();
    const auto c = mixture();
    render::FrameRequest request;
    request.camera = flatCamera();
    request.targets = {color_->name(), 0, 0, false, kSide, kSide};
    request.interpolation = 0.5;
    const base::SnapshotPair pairs[] = {{&b, &a}, {&c, &b}, {&a, &c}};
    for (int frame = 0; frame < 9; ++frame)
        ASSERT_TRUE(view_->render(pairs[frame % 3], request).ok());
    for (int frame = 0; frame < 6; ++frame) {
        render::HeapCounter counter;
        const bool good = view_->render(pairs[frame % 3], request).ok();
        EXPECT_EQ(counter.stop(), 0) << "frame " << frame;
        ASSERT_TRUE(good);
        EXPECT_EQ(view_->statistics().programsCompiled, 0u);
    }
}

TEST_F(ParticleLayersTest, theHostsStateIsAsItWas)
{
    const auto snapshot = mixture();
    view_->settings().layerDivisor = 2;
    render::GlHost host(context_->loader());
    host.makeHostile();
    const render::GlProbe before = host.probe();
    render::FrameRequest request;
    request.camera = flatCamera();
    request.camera.upperLeftOrigin = true; // as the host's clip control
    request.targets = {color_->name(), 0, 0, false, kSide, kSide};
    EXPECT_TRUE(
        view_->render({&snapshot, nullptr}, request).ok()); // the first frame: textures are made as well
    for (const std::string& difference : render::differences(before, host.probe()))
        ADD_FAILURE() << difference;
    host.release();
}

TEST(DrawBatcher, streamsThatDoNotOverlapStayWhole)
{
    const float far[] = {9, 8, 7}, near[] = {3, 2, 1};
    const uint32_t order[] = {0, 1, 2};
    render::DrawBatcher batcher(std::pmr::get_default_resource());
    const render::DrawStream streams[] = {
        {0, 3, near, order, false, 0}, {1, 3, far, order, false, 0}, {2, 5, nullptr, nullptr, false, 5}};
    const auto built = batcher.build(streams);
    ASSERT_EQ(built.size(), 3u);
    EXPECT_EQ(built[0].batch, 1u);
    EXPECT_EQ(built[1].batch, 2u);
    EXPECT_EQ(built[2].batch, 0u);
    EXPECT_EQ(built[1].count, 5u);
}

TEST(DrawBatcher, everyElementIsDrawnOnceAndTheOrderIsRightToASlab)
{
    std::vector<float> a, b;
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < 1000; ++i) {
        a.push_back(20.0f - 0.01f * float(i));
        b.push_back(std::pow(17.0f - 0.01f * float(i), 2.0f));
        order.push_back(i);
    }
    render::DrawBatcher batcher(std::pmr::get_default_resource());
    const render::DrawStream streams[] = {{0, 1000, a.data(), order.data(), false, 0},
                                          {1, 1000, b.data(), order.data(), true, 0}};
    uint32_t next[2] = {};
    float least = 100.0f;
    const float slab = 7.0f / 13.0f;
    const auto built = batcher.build(streams);
    for (const auto& batch : built) {
        ASSERT_EQ(batch.first, next[batch.batch]);
        next[batch.batch] += batch.count;
        for (uint32_t i = batch.first; i < next[batch.batch]; ++i) {
            const float distance = streams[batch.batch].at(i);
            EXPECT_LT(distance, least + slab * 1.01f);
            least = std::min(least, distance);
        }
    }
    EXPECT_EQ(next[0], 1000u);
    EXPECT_EQ(next[1], 1000u);
    EXPECT_LE(built.size(), render::DrawBatcher::kMaxBatches);
    EXPECT_GE(built.size(), 15u);
}

TEST(DrawBatcher, whatOnlyAddsIsNotCutAgainstOthersThatAdd)
{
    std::vector<float> distances;
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < 100; ++i) {
        distances.push_back(100.0f - float(i));
        order.push_back(i);
    }
    render::DrawBatcher batcher(std::pmr::get_default_resource());
    render::DrawStream streams[3];
    for (uint32_t s = 0; s < 3; ++s) {
        streams[s] = {s, 100, distances.data(), order.data(), false, 0};
        streams[s].adds = true;
    }
    EXPECT_EQ(batcher.build(streams).size(), 3u);
    streams[1].adds = false;
    EXPECT_GT(batcher.build(streams).size(), 3u) << "the control: one of them covers";
    EXPECT_LE(batcher.build(streams).size(), render::DrawBatcher::kMaxBatches);
}

TEST(DrawBatcher, manyStreamsAreWholeRatherThanManyBatches)
{
    std::vector<float> distances;
    std::vector<uint32_t> order;
    for (uint32_t i = 0; i < 100; ++i) {
        distances.push_back(100.0f - float(i));
        order.push_back(i);
    }
    render::DrawBatcher batcher(std::pmr::get_default_resource());
    std::vector<render::DrawStream> streams;
    for (uint32_t s = 0; s < 40; ++s) {
        streams.push_back({s, 100, distances.data(), order.data(), false, 0});
        uint64_t drawn = 0;
        const auto built = batcher.build(streams);
        for (const auto& batch : built)
            drawn += batch.count;
        EXPECT_EQ(drawn, 100 * streams.size());
        EXPECT_LE(built.size(), std::max<size_t>(render::DrawBatcher::kMaxBatches, streams.size()));
    }
}
