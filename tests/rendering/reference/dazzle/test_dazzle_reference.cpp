#include "rendering/reference/dazzle/dazzle_reference.h"
#include "shaders/formulas/formula.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace {

using namespace fx;
using render::DazzleHistory;
using render::DazzleSettings;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

DazzleSettings immediate(float white)
{
    DazzleSettings settings;
    settings.white = white;
    settings.a = 1.0f; // all of the overflow, so that sums can be compared
    settings.riseTime = 0.0f;
    settings.fallTime = 0.0f;
    return settings;
}

std::vector<float> gray(std::initializer_list<float> values)
{
    std::vector<float> out(values.size() * 4, 1.0f);
    size_t pixel = 0;
    for (const float v : values) {
        std::fill_n(out.begin() + ptrdiff_t(pixel * 4), 3, v);
        ++pixel;
    }
    return out;
}

std::vector<float> once(const std::vector<float>& picture, int width, int height,
                        const DazzleSettings& settings, DazzleHistory* outHistory = nullptr)
{
    DazzleHistory history{};
    auto out = render::dazzleReference(picture, width, height, settings, 0.0, false, history);
    if (outHistory)
        *outHistory = history;
    return out;
}

/// Sum of the red channel in whole quanta of 2^-24, which are exact for white = 1.
int64_t quantaOfRed(const std::vector<float>& picture)
{
    int64_t sum = 0;
    for (size_t i = 0; i < picture.size(); i += 4)
        sum += int64_t(std::floor(double(picture[i]) * 0x1p24));
    return sum;
}

} // namespace

TEST(DazzleReference, overflowIsSharedInProportionToHeadroom)
{
    // headrooms 1, 1/2, 1/4; one unit of 7/8 overflow: each gets half of its headroom
    const auto out = once(gray({1.875f, 0.0f, 0.5f, 0.75f}), 4, 1, immediate(1.0f));
    EXPECT_EQ(out[0], 1.0f);
    EXPECT_EQ(out[4], 0.5f);
    EXPECT_EQ(out[8], 0.75f);
    EXPECT_EQ(out[12], 0.875f);
}

TEST(DazzleReference, anEmptyPictureStaysEmpty)
{
    DazzleHistory history{};
    EXPECT_TRUE(render::dazzleReference({}, 0, 0, immediate(1.0f), 0.0, false, history).empty());
    EXPECT_EQ(history.valid, 0u);
}

TEST(DazzleReference, aSinglePixelIsCutToWhite)
{
    EXPECT_EQ(once(gray({5.0f}), 1, 1, immediate(2.0f))[0], 2.0f);
    EXPECT_EQ(once(gray({1.5f}), 1, 1, immediate(2.0f))[0], 1.5f);
}

TEST(DazzleReference, moreOverflowThanRoomMakesEveryPixelWhite)
{
    const auto out = once(gray({100.0f, 0.0f, 2.9f, 3.0f}), 2, 2, immediate(3.0f));
    for (size_t i = 0; i < out.size(); i += 4)
        EXPECT_EQ(out[i], 3.0f);
}

TEST(DazzleReference, fewHighlightsOnFlatGrayDarkenNothingAndKeepTheSum)
{
    // the case in which rounding up per level overspends and darkens what is left
    std::vector<float> picture(14400 * 4, 1.0f);
    for (size_t i = 0; i < 14400; ++i)
        std::fill_n(picture.begin() + ptrdiff_t(i * 4), 3, i < 14000 ? 0.784f : (i < 14399 ? 0.196f : 40.0f));
    const auto out = once(picture, 160, 90, immediate(1.0f));
    EXPECT_EQ(quantaOfRed(out), quantaOfRed(picture));
    for (size_t i = 0; i < out.size(); i += 4)
        EXPECT_GE(out[i], std::min(picture[i], 1.0f));
}

TEST(DazzleReference, nothingAboveWhiteLeavesEveryBit)
{
    std::vector<float> picture = gray({0.1f, 1e-40f, 0.99999994f, 1.0f, -0.0f, 0.3f});
    const auto out = once(picture, 3, 2, immediate(1.0f));
    for (size_t i = 0; i < out.size(); ++i)
        EXPECT_EQ(std::bit_cast<uint32_t>(out[i]), std::bit_cast<uint32_t>(picture[i])) << i;
}

TEST(DazzleReference, brokenValuesAreReplacedCountedAndHarmOnlyThemselves)
{
    DazzleHistory history{};
    std::vector<float> picture = gray({0.25f, 0.25f, 0.25f, 0.25f});
    picture[0] = kNan;
    picture[5] = -3.0f;
    picture[10] = -kInf;
    const auto out = once(picture, 4, 1, immediate(1.0f), &history);
    EXPECT_EQ(history.replaced, 3u);
    EXPECT_EQ(out[0], 0.0f);
    EXPECT_EQ(out[5], 0.0f);
    EXPECT_EQ(out[10], 0.0f);
    EXPECT_EQ(out[1], 0.25f);
    EXPECT_EQ(out[12], 0.25f);

    picture[0] = kInf; // counts as 65504
    once(picture, 4, 1, immediate(1.0f), &history);
    EXPECT_EQ(history.replaced, 3u);
    EXPECT_EQ(history.frameMean[0], (65504.0 - 1.0) / 4.0);
}

TEST(DazzleReference, aFullFrameOfHalfFloatMaximaIsSummedExactly)
{
    // 4K: 63 bits a channel
    constexpr int kPixels = 3840 * 2160;
    std::vector<float> picture(size_t(kPixels) * 4, 65504.0f);
    DazzleHistory history{};
    const auto out = once(picture, 3840, 2160, immediate(1.0f), &history);
    EXPECT_EQ(history.frameMean[0], 65503.0);
    EXPECT_EQ(out[0], 1.0f);
    EXPECT_EQ(out[picture.size() - 2], 1.0f);
}

TEST(DazzleReference, floatSumsInSequenceWouldBeWrongByMoreThanAPercent)
{
    // the negative control of the integer sums: 4K of small values behind bright ones
    double exact = 0.0;
    float sequential = 0.0f;
    for (int i = 0; i < 3840 * 2160; ++i) {
        const float v = i < 300 ? 65504.0f : 0.4f + 0.3f * float(i % 7) / 7.0f;
        exact += v;
        sequential += v;
    }
    EXPECT_GT(std::abs(double(sequential) - exact) / exact, 0.01);
}

TEST(DazzleReference, whiteIsAWholeNumberOfQuantaForAnyWhite)
{
    for (float white = 1e-6f; white < 1e9f; white *= 1.37f) {
        const render::DazzleScale scale = render::dazzleScale(white);
        EXPECT_EQ(std::ldexp(float(scale.whiteQuanta), scale.exponent), white);
        EXPECT_GT(scale.whiteQuanta, 1u << 23);
        EXPECT_LE(scale.whiteQuanta, 1u << 24);
    }
    EXPECT_EQ(render::dazzleScale(8.0f).whiteQuanta, 1u << 24);
}

TEST(DazzleAdaptation, oneSecondAtOnceEqualsSixtyFrames)
{
    const auto bright = gray({9.0f, 0.0f, 0.0f, 0.0f});
    const auto dark = gray({1.0f, 0.0f, 0.0f, 0.0f});
    DazzleSettings settings = immediate(1.0f);
    settings.riseTime = 0.7f;
    settings.fallTime = 0.4f;
    for (const auto& second : {bright, dark}) {
        DazzleHistory whole{};
        DazzleHistory cut{};
        const auto& first = second == bright ? dark : bright;
        render::dazzleReference(first, 4, 1, settings, 0.0, true, whole);
        cut = whole;
        render::dazzleReference(second, 4, 1, settings, 1.0, false, whole);
        for (int i = 0; i < 60; ++i)
            render::dazzleReference(second, 4, 1, settings, 1.0 / 60.0, false, cut);
        const double target = second == bright ? 2.0 : 0.0;
        const double keep = std::exp(-1.0 / double(second == bright ? 0.7f : 0.4f));
        EXPECT_NEAR(whole.adapted[0], target + (2.0 - 2.0 * target) * keep, 1e-15);
        // each of 60 steps rounds a product and a sum; 4 eps of the largest value on the way
        EXPECT_NEAR(cut.adapted[0], whole.adapted[0], 4.0 * 2.0 * std::numeric_limits<double>::epsilon());
    }
}

TEST(DazzleAdaptation, timeThatDoesNotPassChangesNothing)
{
    const DazzleSettings settings{.white = 1.0f};
    DazzleHistory history{};
    render::dazzleReference(gray({3.0f, 0.0f}), 2, 1, settings, 0.0, true, history);
    for (const double dt : {0.0, -1.0, double(kNan), -double(kInf)}) {
        render::dazzleReference(gray({9.0f, 0.0f}), 2, 1, settings, dt, false, history);
        EXPECT_EQ(history.adapted[0], 1.0) << dt;
        EXPECT_EQ(history.frameMean[0], 4.0) << dt;
    }
    render::dazzleReference(gray({9.0f, 0.0f}), 2, 1, settings, double(kInf), false, history);
    EXPECT_EQ(history.adapted[0], 4.0);
}

TEST(DazzleAdaptation, aResetOrATimeConstantOfZeroTakesTheFrameAsItIs)
{
    DazzleSettings settings{.white = 1.0f};
    DazzleHistory history{};
    render::dazzleReference(gray({3.0f, 0.0f}), 2, 1, settings, 0.1, false, history); // first frame seeds
    EXPECT_EQ(history.adapted[0], 1.0);
    render::dazzleReference(gray({9.0f, 0.0f}), 2, 1, settings, 0.01, true, history);
    EXPECT_EQ(history.adapted[0], 4.0);
    settings.fallTime = 0.0f;
    render::dazzleReference(gray({2.0f, 0.0f}), 2, 1, settings, 0.01, false, history);
    EXPECT_EQ(history.adapted[0], 0.5);
}

TEST(DazzleAdaptation, glareOutlivesItsSourceAndFades)
{
    const DazzleSettings settings{.white = 1.0f};
    DazzleHistory history{};
    render::dazzleReference(gray({2.0f, 0.0f, 0.0f, 0.0f}), 4, 1, settings, 0.0, true, history);
    double last = 0.25;
    for (int i = 0; i < 5; ++i) {
        const auto out =
            render::dazzleReference(gray({0.5f, 0.0f, 0.0f, 0.0f}), 4, 1, settings, 0.1, false, history);
        EXPECT_GT(out[4], 0.0f);
        EXPECT_LT(out[4], last);
        last = out[4];
    }
}

TEST(SensorLaw, glareNeverFallsWhenTheConditionHoldsAndDoesWhenItIsBroken)
{
    const auto falls = [](double a, double b, double c) {
        double before = 0.0;
        for (double over = 1e-5; over < 40.0; over *= 1.01) {
            const double f = over * formula64::fxSensorGain(over, a, b, c);
            if (f < before)
                return true;
            before = f;
        }
        return false;
    };
    for (const float b : {-2.0f, -0.5f, 0.0f, 0.5f, 3.0f, 20.0f}) {
        const float least = b > 0.0f ? float(b * std::exp(-2.0)) : -b;
        for (const float c : {0.3f, 1.0f, 4.0f}) {
            DazzleSettings settings{.a = least * 1.001f + 1e-6f, .b = b, .c = c};
            EXPECT_TRUE(render::checkSensorLaw(settings).ok()) << b;
            EXPECT_FALSE(falls(settings.a, b, c)) << b;
            settings.a = least * 0.97f - 1e-3f;
            EXPECT_FALSE(render::checkSensorLaw(settings).ok()) << b;
            EXPECT_TRUE(falls(settings.a, b, c)) << b;
        }
    }
}

TEST(SensorLaw, theGainGoesFromAPlusBToA)
{
    EXPECT_FLOAT_EQ(formula::fxSensorGain(0.0f, 0.7f, 0.4f, 2.0f), 1.1f);
    EXPECT_NEAR(formula::fxSensorGain(0.5f, 0.7f, 0.4f, 2.0f), 0.7 + 0.4 * std::exp(-1.0), 1e-6);
    EXPECT_EQ(formula::fxSensorGain(1e30f, 0.7f, 0.4f, 3e38f), 0.7f);
    EXPECT_EQ(formula::fxSensorGain(12.0f, 0.7f, 0.0f, 2.0f), 0.7f);
}

TEST(SensorLaw, valuesThatMakeNoSenseAreRefusedByName)
{
    const auto message = [](auto change) {
        DazzleSettings settings;
        change(settings);
        const base::Status status = render::checkSensorLaw(settings);
        EXPECT_EQ(status.code(), base::Code::InvalidArgument);
        return status.message();
    };
    EXPECT_NE(message([](auto& s) { s.white = 0.0f; }).find("white"), std::string::npos);
    EXPECT_NE(message([](auto& s) { s.white = kNan; }).find("white"), std::string::npos);
    EXPECT_NE(message([](auto& s) { s.c = -1.0f; }).find("C is"), std::string::npos);
    EXPECT_NE(message([](auto& s) { s.b = kInf; }).find("B is"), std::string::npos);
    EXPECT_NE(message([](auto& s) { s.a = kNan; }).find("A is"), std::string::npos);
    EXPECT_NE(message([](auto& s) { s.riseTime = -0.1f; }).find("riseTime"), std::string::npos);
    EXPECT_NE(message([](auto& s) { s.fallTime = kNan; }).find("fallTime"), std::string::npos);
    EXPECT_TRUE(render::checkSensorLaw(DazzleSettings{}).ok());
}

TEST(SensorLaw, theDazzlesOwnGainIsAsExactAsItsArgument)
{
    for (const float c : {0.0f, 0.3f, 1.0f, 50.0f})
        for (double over = 1e-12; over < 1e6; over *= 1.0937) {
            const DazzleSettings settings{.a = 0.0f, .b = 1.0f, .c = c};
            const double want = double(expl(-static_cast<long double>(settings.c) * over));
            const double got = render::dazzleGain(over, settings);
            if (double(c) * over > 699.0)
                break;
            ASSERT_NEAR(got / want, 1.0, (4.0 + double(c) * over) * 0x1p-52) << c << " " << over;
        }
}

TEST(SensorLaw, theDazzlesOwnGainIsTheFormulas)
{
    for (const double over : {0.0, 0.01, 0.5, 3.0, 200.0}) {
        const DazzleSettings settings{.a = 0.3f, .b = 0.9f, .c = 1.5f};
        EXPECT_NEAR(render::dazzleGain(over, settings),
                    formula64::fxSensorGain(over, double(settings.a), double(settings.b), double(settings.c)),
                    1e-15);
    }
    EXPECT_EQ(render::dazzleGain(1e30, {.a = 0.7f, .b = 0.4f, .c = 3e38f}), double(0.7f));
}
