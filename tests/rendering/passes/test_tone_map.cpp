#include "rendering/frame_graph/recording_backend.h"
#include "rendering/passes/tone_map_pass.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;
using test::Picture;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class ToneMap : public test::PostPass
{
protected:
    std::vector<float> map(const Picture& picture, float white, Format format = Format::RGBA32F)
    {
        graph_->begin();
        const auto out =
            ToneMapPass::addTo(*graph_, {import(picture), picture.width, picture.height, white, format});
        execute(out.color);
        return read(out.color);
    }
};

/// Seven decades around 1.
Picture sweep()
{
    Picture picture(256, 1);
    for (int x = 0; x < 256; ++x)
        std::fill_n(picture.at(x, 0), 3, std::exp2(float(x) / 8.0f - 20.0f));
    return picture;
}

} // namespace

TEST(ToneCurve, blackIsBlackWhiteIsWhiteAndMiddleGrayStays)
{
    for (const double white : {1.0, 1.5, 8.0, 1000.0}) {
        EXPECT_EQ(formula64::fxToneCurve(0.0, white), 0.0);
        EXPECT_EQ(formula64::fxToneCurve(-3.0, white), 0.0);
        EXPECT_EQ(formula64::fxToneCurve(0.18, white), 0.18);
        EXPECT_EQ(formula64::fxToneCurve(0.05, white), 0.05);
        EXPECT_TRUE(white == 1.0 ||
                    formula64::fxToneCurve(0.19, white) < 0.19); // the shoulder begins at middle gray
        EXPECT_NEAR(formula64::fxToneCurve(white, white), 1.0, 1e-15);
        EXPECT_LT(formula64::fxToneCurve(0.99 * white, white), 1.0);
        EXPECT_EQ(formula64::fxToneCurve(double(kInf), white), formula64::fxToneCurve(white, white));
    }
}

TEST(ToneCurve, risesStrictlyAndWithoutAKink)
{
    for (const double white : {1.0, 8.0, 64.0}) {
        double before = -1.0;
        double slopeBefore = 1.0;
        for (double x = 0.0; x < white; x += 1e-3) {
            const double y = formula64::fxToneCurve(x, white);
            ASSERT_GT(y, before) << x;
            const double slope = (formula64::fxToneCurve(x + 1e-3, white) - y) / 1e-3;
            ASSERT_NEAR(slope, slopeBefore, 5e-3) << x; // second derivative below 2.5
            before = y;
            slopeBefore = slope;
        }
    }
}

TEST(ToneCurve, aBrighteningFireTurnsFromOrangeThroughYellowToWhite)
{
    double greenBefore = 0.0;
    double blueBefore = 0.0;
    for (const double bright : {1.0, 3.0, 10.0, 30.0, 100.0}) {
        const double r = formula64::fxToneCurve(bright * 8.0, 8.0);
        const double g = formula64::fxToneCurve(bright * 8.0 * 0.3, 8.0);
        const double b = formula64::fxToneCurve(bright * 8.0 * 0.03, 8.0);
        EXPECT_GE(r, g);
        EXPECT_GE(g, b);
        EXPECT_TRUE(g > greenBefore || g > 0.999) << bright;
        EXPECT_GT(b, blueBefore);
        greenBefore = g;
        blueBefore = b;
        EXPECT_TRUE(bright > 1.0 || b / g < 0.35); // orange
        EXPECT_TRUE(bright < 100.0 || b > 0.95);   // nearly white
    }
}

TEST(ToneCurve, floatAgreesWithDouble)
{
    for (float x = 1e-6f; x < 100.0f; x *= 1.01f)
        EXPECT_NEAR(formula::fxToneCurve(x, 8.0f), formula64::fxToneCurve(double(x), 8.0), 4e-7);
}

TEST(SrgbEncoding, hasTheCodeValuesOfTheStandard)
{
    EXPECT_EQ(formula64::fxSrgbEncode(0.0), 0.0);
    EXPECT_NEAR(formula64::fxSrgbEncode(1.0), 1.0, 1e-15);
    EXPECT_NEAR(formula64::fxSrgbEncode(0.18), 0.461356, 1e-6);
    EXPECT_NEAR(formula64::fxSrgbEncode(0.5), 0.735357, 1e-6);
    EXPECT_NEAR(formula64::fxSrgbEncode(0.0031308), formula64::fxSrgbEncode(0.0031309), 2e-6);
    for (float y = 1e-5f; y < 1.0f; y *= 1.01f)
        EXPECT_NEAR(formula::fxSrgbEncode(y), formula64::fxSrgbEncode(double(y)), 2e-7);
}

TEST_F(ToneMap, equalsTheFormulas)
{
    const Picture picture = sweep();
    for (const float white : {1.0f, 8.0f, 100.0f}) {
        const auto out = map(picture, white);
        for (size_t i = 0; i < out.size(); i += 4) {
            const double want =
                formula64::fxSrgbEncode(formula64::fxToneCurve(double(picture.texels[i]), double(white)));
            EXPECT_NEAR(out[i], want, 5e-6) << picture.texels[i];
        }
    }
}

TEST(FilmCrosstalk, growsWithTheLightUpToAFixedShare)
{
    EXPECT_EQ(formula64::fxFilmCrosstalk(0.0, 8.0), 0.0);
    EXPECT_EQ(formula64::fxFilmCrosstalk(-1.0, 8.0), 0.0);
    EXPECT_NEAR(formula64::fxFilmCrosstalk(4.0, 8.0), 0.11, 1e-15);
    EXPECT_NEAR(formula64::fxFilmCrosstalk(8.0, 8.0), 0.22, 1e-15);
    EXPECT_NEAR(formula64::fxFilmCrosstalk(double(kInf), 8.0), 0.22, 1e-15);
}

TEST_F(ToneMap, brightColorsPassLightToTheOtherChannels)
{
    Picture picture(32, 1);
    for (int x = 0; x < 32; ++x) {
        const float bright = std::exp2(float(x) / 2.0f - 8.0f);
        picture.at(x, 0)[0] = bright;
        picture.at(x, 0)[1] = 0.3f * bright;
        picture.at(x, 0)[2] = 0.03f * bright;
    }
    const auto out = map(picture, 8.0f);
    for (int x = 0; x < 32; ++x) {
        double light[3];
        for (int channel = 0; channel < 3; ++channel)
            light[channel] = std::min(double(picture.at(x, 0)[channel]), 8.0);
        const double mean = (light[0] + light[1] + light[2]) / 3.0;
        const double share = formula64::fxFilmCrosstalk(light[0], 8.0);
        for (int channel = 0; channel < 3; ++channel) {
            const double mixed = light[channel] + share * (mean - light[channel]);
            const double want = formula64::fxSrgbEncode(formula64::fxToneCurve(mixed, 8.0));
            EXPECT_NEAR(out[size_t(x * 4 + channel)], want, 5e-6) << x << ", channel " << channel;
        }
    }
}

TEST_F(ToneMap, brokenValuesGiveDefinedOnes)
{
    Picture picture(3, 1, {kInf, kInf, kInf, 0.25f});
    std::fill_n(picture.at(1, 0), 3, kNan);
    std::fill_n(picture.at(2, 0), 3, -kInf);
    const auto out = map(picture, 8.0f);
    for (size_t channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(out[channel], 1.0f, 1e-6f);
        EXPECT_EQ(out[4 + channel], 0.0f);
        EXPECT_EQ(out[8 + channel], 0.0f);
    }
    EXPECT_EQ(out[3], 0.25f);
    for (const float white : {0.0f, -1.0f, kNan})
        EXPECT_NEAR(map(Picture(1, 1, {1.0f, 1.0f, 1.0f, 1.0f}), white)[0], 1.0f, 1e-6f);
}

TEST_F(ToneMap, ditherMovesNoValueByAStepAndKeepsTheMean)
{
    for (const float gray : {0.0f, 0.003f, 0.07f, 0.1803f, 0.5f, 8.0f}) {
        const Picture picture(64, 64, {gray, gray, gray, 1.0f});
        const double want = 255.0 * formula64::fxSrgbEncode(formula64::fxToneCurve(double(gray), 8.0));
        double mean = 0.0;
        const auto out = map(picture, 8.0f, Format::RGBA8);
        for (size_t i = 0; i < out.size(); i += 4) {
            ASSERT_LT(std::abs(255.0 * double(out[i]) - want), 1.0);
            mean += 255.0 * double(out[i]) / (64 * 64);
        }
        // Exact code values stay. Storing a value may round up from as much as 0.6 of a step on (NVIDIA:
        // 0.56).
        EXPECT_NEAR(mean, want, gray == 0.0f || gray == 8.0f ? 1e-9 : 0.1) << gray;
    }
}

TEST_F(ToneMap, isTheSameEveryTime)
{
    const Picture picture(64, 32, {0.3f, 0.2f, 0.1f, 1.0f});
    EXPECT_EQ(test::differentBits(map(picture, 8.0f, Format::RGBA8), map(picture, 8.0f, Format::RGBA8)), 0u);
}

TEST(ToneMapInTheGraph, drawsOnceWhenUsedAndNeverOtherwise)
{
    for (const bool used : {true, false}) {
        FrameGraph graph(std::pmr::new_delete_resource());
        graph.begin();
        const ResourceId color = graph.importTexture({"color", 16, 16, Format::RGBA32F}, 1);
        const auto out = ToneMapPass::addTo(graph, {color, 16, 16, 8.0f, Format::RGBA8});
        if (used)
            graph.keep(out.color);
        graph.compile();
        RecordingBackend backend(graph);
        graph.execute(backend);
        EXPECT_TRUE(backend.violations().empty());
        EXPECT_EQ(backend.count(RecordingBackend::Kind::Draw), used ? 1u : 0u);
    }
}
