#include "foundation/random/philox.h"
#include "rendering/frame_graph/recording_backend.h"
#include "rendering/passes/dazzle_pass.h"
#include "rendering/reference/dazzle/dazzle_reference.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;
using test::Picture;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class DazzleOnGpu : public test::PostPass
{
protected:
    /// One frame; `ioHistory` moves on.
    std::vector<float> frame(const Picture& picture, const DazzleSettings& settings, DazzleHistory& ioHistory,
                             double deltaTime = 0.0, bool reset = false)
    {
        graph_->begin();
        const ResourceId color = import(picture);
        const ResourceId history = importBytes(std::as_bytes(std::span(&ioHistory, 1)));
        const auto out = DazzlePass::addTo(
            *graph_, {color, history, picture.width, picture.height, settings, deltaTime, reset});
        execute(out.color);
        ioHistory = readBuffer<DazzleHistory>();
        return read(out.color);
    }

    void expectEqualToReference(const Picture& picture, const DazzleSettings& settings)
    {
        DazzleHistory onGpu{};
        DazzleHistory onCpu{};
        const auto got = frame(picture, settings, onGpu);
        const auto want =
            dazzleReference(picture.texels, picture.width, picture.height, settings, 0.0, false, onCpu);
        EXPECT_EQ(test::differentBits(got, want), 0u) << picture.width << " x " << picture.height;
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_EQ(onGpu.adapted[channel], onCpu.adapted[channel]);
            EXPECT_EQ(onGpu.frameMean[channel], onCpu.frameMean[channel]);
        }
        EXPECT_EQ(onGpu.replaced, onCpu.replaced);
        EXPECT_EQ(onGpu.valid, 1u);
    }
};

/// High dynamic range: five decades, a few per mille far above white.
Picture randomPicture(int width, int height, uint64_t seed)
{
    Picture picture(width, height);
    for (size_t i = 0; i < picture.texels.size(); i += 4) {
        const auto u = base::randomUnit4(seed, 0, i, base::RandomPurpose::Noise);
        for (size_t channel = 0; channel < 3; ++channel)
            picture.texels[i + channel] = std::exp(11.0f * u[channel] - 9.0f);
        if (u[3] < 0.004f)
            picture.texels[i] = 300.0f * u[1];
        picture.texels[i + 3] = u[3];
    }
    return picture;
}

/// Whole quanta of one channel.
int64_t quanta(const std::vector<float>& texels, size_t channel, float white)
{
    const DazzleScale scale = dazzleScale(white);
    int64_t sum = 0;
    for (size_t i = channel; i < texels.size(); i += 4)
        sum += int64_t(std::floor(std::ldexp(double(texels[i]), -scale.exponent)));
    return sum;
}

constexpr int kSizes[][2] = {{1, 1}, {17, 3}, {16, 16}, {33, 70}, {641, 359}};

} // namespace

TEST_F(DazzleOnGpu, equalsTheReferenceBitForBit)
{
    for (const auto& size : kSizes)
        for (const float white : {1.0f, 1.7f, 8.0f})
            expectEqualToReference(randomPicture(size[0], size[1], 7), {.white = white, .a = 1.0f});
}

TEST_F(DazzleOnGpu, keepsEveryQuantumOfLight)
{
    for (const auto& size : kSizes)
        for (const float white : {1.0f, 1.7f, 4.0f}) {
            const Picture picture = randomPicture(size[0], size[1], 3);
            DazzleHistory history{};
            const auto out = frame(picture, {.white = white, .a = 1.0f}, history);
            for (size_t channel = 0; channel < 3; ++channel) {
                const int64_t room = int64_t(size[0]) * size[1] * int64_t(dazzleScale(white).whiteQuanta);
                EXPECT_EQ(quanta(out, channel, white), std::min(room, quanta(picture.texels, channel, white)))
                    << size[0] << " x " << size[1] << " channel " << channel;
            }
            for (size_t i = 3; i < out.size(); i += 4)
                ASSERT_EQ(out[i], picture.texels[i]);
        }
}

TEST_F(DazzleOnGpu, addsToDarkPixelsAndExceedsWhiteNowhere)
{
    const Picture picture = randomPicture(120, 80, 5);
    DazzleHistory history{};
    const auto out = frame(picture, {.white = 2.0f, .a = 1.0f}, history);
    for (size_t i = 0; i < out.size(); i += 4) {
        ASSERT_LE(out[i], 2.0f);
        ASSERT_GE(out[i], std::min(picture.texels[i], 2.0f) - 0x1p-23f); // a part of a quantum may be dropped
    }
}

TEST_F(DazzleOnGpu, allZeroAllSaturatedAndAllWhiteAreDefined)
{
    for (const float v : {0.0f, 1.0f, 65504.0f, 1e30f}) {
        const Picture picture(40, 24, {v, v, v, 0.5f});
        expectEqualToReference(picture, {.white = 1.0f, .a = 1.0f});
        DazzleHistory history{};
        const auto out = frame(picture, {.white = 1.0f, .a = 1.0f}, history);
        for (size_t i = 0; i < out.size(); i += 4)
            ASSERT_EQ(out[i], std::min(v, 1.0f));
    }
}

TEST_F(DazzleOnGpu, sumsBeyond64BitsAreExact)
{
    // 2^54 quanta in each of 230,119 pixels: 72 bits a channel, more than 16K of 65504
    Picture picture(641, 359, {3e38f, 65504.0f, 0.0f, 1.0f});
    picture.at(640, 358)[1] = 0.75f;
    expectEqualToReference(picture, {.white = 1.0f, .a = 1.0f});
    DazzleHistory history{};
    frame(picture, {.white = 1.0f, .a = 1.0f}, history);
    EXPECT_NEAR(history.frameMean[0], 0x1p30 - 1.0, 1e-6);
    EXPECT_EQ(history.replaced, 641u * 359u);
}

TEST_F(DazzleOnGpu, nothingAboveWhiteLeavesEveryBit)
{
    const Picture picture = randomPicture(129, 65, 11);
    DazzleHistory history{};
    const auto out = frame(picture, {.white = 512.0f, .a = 1.0f}, history);
    EXPECT_EQ(test::differentBits(out, picture.texels), 0u);
    EXPECT_EQ(history.adapted[0], 0.0);
}

TEST_F(DazzleOnGpu, brokenValuesAreReplacedCountedAndHarmOnlyThemselves)
{
    Picture picture(50, 30, {0.25f, 0.25f, 0.25f, 1.0f});
    picture.at(3, 4)[0] = kNan;
    picture.at(20, 17)[0] = -kNan;
    picture.at(7, 4)[1] = -2.0f;
    picture.at(9, 29)[2] = -kInf;
    DazzleHistory history{};
    auto out = frame(picture, {.white = 1.0f, .a = 1.0f}, history);
    EXPECT_EQ(history.replaced, 4u);
    Picture want = picture;
    want.at(3, 4)[0] = want.at(20, 17)[0] = want.at(7, 4)[1] = want.at(9, 29)[2] = 0.0f;
    EXPECT_EQ(test::differentBits(out, want.texels), 0u);

    picture.at(49, 0)[2] = kInf;
    picture.at(48, 0)[2] = 3e38f;
    expectEqualToReference(picture, {.white = 1.0f, .a = 1.0f});
}

TEST_F(DazzleOnGpu, adaptsLikeTheReferenceFromFrameToFrame)
{
    const DazzleSettings settings{.white = 1.0f, .a = 1.0f};
    DazzleHistory onGpu{};
    DazzleHistory onCpu{};
    const double steps[] = {0.0, 0.016, 0.016, kNan, 0.5, -1.0, 0.2};
    for (size_t i = 0; i < std::size(steps); ++i) {
        const Picture picture =
            i % 3 == 2 ? Picture(61, 37, {0.2f, 0.3f, 0.4f, 1.0f}) : randomPicture(61, 37, i);
        const auto got = frame(picture, settings, onGpu, steps[i], i == 4);
        const auto want = dazzleReference(picture.texels, 61, 37, settings, steps[i], i == 4, onCpu);
        EXPECT_EQ(test::differentBits(got, want), 0u) << "frame " << i;
        EXPECT_EQ(onGpu.adapted[1], onCpu.adapted[1]) << "frame " << i;
    }
}

TEST_F(DazzleOnGpu, equalsTheReferenceBitForBitForEverySensorLaw)
{
    const float laws[][3] = {{0.01f, 0.0f, 1.0f}, {0.3f, 0.9f, 1.5f},  {1.0f, -1.0f, 0.7f},
                             {0.5f, 3.0f, 40.0f}, {0.05f, 0.3f, 1e6f}, {0.4f, 0.1f, 0.0f}};
    for (const auto& law : laws)
        for (const float white : {0.05f, 1.0f, 4.0f})
            expectEqualToReference(randomPicture(113, 75, 13),
                                   {.white = white, .a = law[0], .b = law[1], .c = law[2]});
}

TEST_F(DazzleOnGpu, adaptsLikeTheReferenceWithASensorLawThatBends)
{
    const DazzleSettings settings{.white = 1.0f, .a = 0.2f, .b = 0.7f, .c = 2.0f};
    DazzleHistory onGpu{}, onCpu{};
    for (uint64_t i = 0; i < 6; ++i) {
        const Picture picture = randomPicture(61, 37, i);
        const auto got = frame(picture, settings, onGpu, 0.03);
        const auto want = dazzleReference(picture.texels, 61, 37, settings, 0.03, false, onCpu);
        EXPECT_EQ(test::differentBits(got, want), 0u) << "frame " << i;
        EXPECT_EQ(onGpu.adapted[2], onCpu.adapted[2]) << "frame " << i;
    }
}

TEST_F(DazzleOnGpu, theSensorLawScalesTheGlareWithinTheBoundOfTheGain)
{
    const Picture picture = randomPicture(128, 96, 9);
    const DazzleSettings settings{.white = 4.0f, .a = 0.3f, .b = 0.9f, .c = 1.5f};
    DazzleHistory onGpu{};
    DazzleHistory onCpu{};
    const auto got = frame(picture, settings, onGpu);
    const auto want = dazzleReference(picture.texels, 128, 96, settings, 0.0, false, onCpu);
    for (size_t channel = 0; channel < 3; ++channel) {
        int64_t capped = 0;
        for (size_t i = channel; i < picture.texels.size(); i += 4)
            capped += int64_t(std::floor(std::ldexp(double(std::min(picture.texels[i], 4.0f)), 22)));
        const double over = onGpu.frameMean[channel];
        const double f = over * (0.3 + 0.9 * std::exp(-1.5 * over)) * 128 * 96 * 0x1p24;
        const double added = double(quanta(got, channel, 4.0f) - capped);
        EXPECT_NEAR(added, f, f * 0x1p-20 + 1.0);
        EXPECT_NEAR(added, double(quanta(want, channel, 4.0f) - capped), f * 0x1p-20 + 1.0);
    }
}

TEST(DazzlePassInTheGraph, isAbsentWhenSwitchedOffOrRefused)
{
    FrameGraph graph(std::pmr::new_delete_resource());
    graph.begin();
    const ResourceId color = graph.importTexture({"color", 8, 8, Format::RGBA32F}, 1);
    const ResourceId history = graph.importBuffer({"history", sizeof(DazzleHistory)}, 2);
    for (const DazzleSettings& settings : {DazzleSettings{.enabled = false}, DazzleSettings{.a = -1.0f}}) {
        const auto out = DazzlePass::addTo(graph, {color, history, 8, 8, settings, 0.0, false});
        EXPECT_EQ(out.color.index, color.index);
        EXPECT_EQ(out.history.index, history.index);
    }
    graph.keep(color);
    graph.compile();
    EXPECT_TRUE(graph.executedPasses().empty());
}

TEST(DazzlePassInTheGraph, declaresWhatItTouchesAndIsCulledWhenUnused)
{
    for (const bool used : {true, false}) {
        FrameGraph graph(std::pmr::new_delete_resource());
        graph.begin();
        const ResourceId color = graph.importTexture({"color", 100, 50, Format::RGBA32F}, 1);
        const ResourceId history = graph.importBuffer({"history", sizeof(DazzleHistory)}, 2);
        const auto out = DazzlePass::addTo(graph, {color, history, 100, 50, {}, 0.0, false});
        if (used)
            graph.keep(out.color);
        graph.compile();
        RecordingBackend backend(graph);
        graph.execute(backend);
        EXPECT_TRUE(backend.violations().empty()) << backend.violations().front();
        EXPECT_EQ(backend.count(RecordingBackend::Kind::Dispatch), used ? 3u : 0u);
    }
}
