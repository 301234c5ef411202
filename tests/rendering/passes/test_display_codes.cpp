// Codes of displays and the light that they stand for.
#include "rendering/passes/display_decode_pass.h"
#include "rendering/passes/present_changes_pass.h"
#include "shaders/formulas/formula.h"
#include "tests/rendering/passes/post_pass_harness.h"

#include <cmath>
#include <limits>

namespace {

using namespace fx;
using namespace fx::render;
using test::Picture;

DisplayBlock block(TargetEncoding encoding, float white, bool whole = false)
{
    HostTargets targets;
    targets.encoding = encoding;
    return makeDisplayBlock(targets, white, false, whole);
}

class DisplayCodes : public test::PostPass
{
protected:
    /// Decodes, applies a gain to every second pixel, and encodes over a target that holds -1.
    std::vector<float> roundTrip(const Picture& codes, TargetEncoding encoding, float white)
    {
        graph_->begin();
        const ResourceId source = import(codes);
        const DisplayBlock display = block(encoding, white, true);
        const ResourceId light =
            DisplayDecodePass::addTo(*graph_, {source, codes.width, codes.height, display}).color;
        const Picture zero(codes.width, codes.height, {0, 0, 0, 0});
        const auto out =
            PresentChangesPass::addTo(*graph_, {light, import(zero), source, import(zero), display});
        execute(out.target);
        return read(out.target);
    }
};

} // namespace

TEST(ToneCurveInverse, undoesTheToneCurve)
{
    for (const double white : {1.0, 1.5, 8.0, 1000.0}) {
        EXPECT_EQ(formula64::fxToneCurveInverse(0.0, white), 0.0);
        EXPECT_EQ(formula64::fxToneCurveInverse(-1.0, white), 0.0);
        EXPECT_NEAR(formula64::fxToneCurveInverse(1.0, white), white, 1e-12 * white);
        EXPECT_LE(formula64::fxToneCurveInverse(2.0, white), white);
        for (double y = 0.0; y <= 1.0; y += 1e-3) {
            const double x = formula64::fxToneCurveInverse(y, white);
            EXPECT_NEAR(formula64::fxToneCurve(x, white), y, 1e-14);
            EXPECT_NEAR(
                formula::fxToneCurve(formula::fxToneCurveInverse(float(y), float(white)), float(white)), y,
                4e-7);
        }
    }
}

TEST(ToneCurveInverse, isTheIdentityWhereWhiteIsOne)
{
    for (double y = 0.0; y <= 1.0; y += 1e-3)
        EXPECT_NEAR(formula64::fxToneCurveInverse(y, 1.0), y, 1e-15);
}

TEST(DisplayComposite, isTheSumOfLightWhereBothWhitesAreEqual)
{
    for (const double white : {1.0, 2.0, 8.0})
        for (double y = 0.0; y <= 1.0; y += 0.05)
            for (const double light : {0.0, 0.1, 1.0, 5.0, 20.0})
                for (const double share : {0.0, 0.3, 1.0}) {
                    const double sum = share * formula64::fxToneCurveInverse(y, white) + light;
                    const double got = formula64::fxDisplayComposite(y, light, share, white, white);
                    EXPECT_NEAR(formula64::fxToneCurve(got, white), formula64::fxToneCurve(sum, white), 2e-6);
                    EXPECT_NEAR(std::max(got - white, 0.0), std::max(sum - white, 0.0), 1e-9);
                }
}

TEST(DisplayComposite, keepsWhatNoEffectCoversAndShowsEffectsOverBlackByTheirOwnCurve)
{
    for (const double hostWhite : {1.0, 2.0, 8.0}) {
        for (double y = 0.0; y <= 1.0; y += 0.01)
            EXPECT_NEAR(
                formula64::fxToneCurve(formula64::fxDisplayComposite(y, 0.0, 1.0, hostWhite, 8.0), 8.0), y,
                1e-12);
        for (const double light : {0.01, 0.5, 3.0, 7.9, 30.0})
            EXPECT_NEAR(formula64::fxDisplayComposite(0.0, light, 0.5, hostWhite, 8.0), light, 1e-9);
    }
}

TEST(DisplayComposite, risesWithTheLightAndMixesClampedColorsLinearly)
{
    for (double y = 0.0; y <= 1.0; y += 0.1) {
        double before = -1.0;
        for (double light = 0.0; light < 10.0; light += 0.01) {
            const double x = formula64::fxDisplayComposite(y, light, 0.7, 2.0, 8.0);
            ASSERT_GE(x, before);
            ASSERT_LE(formula64::fxToneCurve(x, 8.0), 1.0);
            before = x;
        }
        // smoke without light of its own over a host without a curve: a linear mix
        const double dark = formula64::fxDisplayComposite(y, 0.0, 0.3, 1.0, 8.0);
        EXPECT_NEAR(formula64::fxToneCurve(dark, 8.0), 0.3 * y, 1e-12);
    }
}

TEST(DisplayComposite, floatAgreesWithDouble)
{
    for (float y = 0.0f; y <= 1.0f; y += 0.01f)
        for (const float light : {0.0f, 0.01f, 1.0f, 7.0f})
            for (const float share : {0.0f, 0.5f, 0.99f}) {
                const float got = formula::fxDisplayComposite(y, light, share, 2.0f, 8.0f);
                const double want =
                    formula64::fxDisplayComposite(double(y), double(light), double(share), 2.0, 8.0);
                EXPECT_NEAR(formula64::fxToneCurve(double(got), 8.0), formula64::fxToneCurve(want, 8.0),
                            4e-6);
            }
}

TEST(DisplayEncoding, decodingUndoesEncoding)
{
    EXPECT_EQ(formula64::fxGammaEncode(0.0), 0.0);
    EXPECT_EQ(formula64::fxGammaDecode(0.0), 0.0);
    EXPECT_NEAR(formula64::fxGammaEncode(0.5), 0.729740, 1e-6);
    EXPECT_NEAR(formula64::fxSrgbDecode(0.461356), 0.18, 1e-6);
    EXPECT_NEAR(formula64::fxSrgbDecode(0.04045), formula64::fxSrgbDecode(0.0404501), 1e-7);
    for (double code = 0.0; code <= 1.0; code += 1.0 / 1023) {
        EXPECT_NEAR(formula64::fxSrgbEncode(formula64::fxSrgbDecode(code)), code, 1e-6);
        EXPECT_NEAR(formula64::fxGammaEncode(formula64::fxGammaDecode(code)), code, 1e-12);
        EXPECT_NEAR(formula::fxSrgbDecode(float(code)), formula64::fxSrgbDecode(code), 4e-7);
        EXPECT_NEAR(formula::fxGammaDecode(float(code)), formula64::fxGammaDecode(code), 4e-7);
        EXPECT_NEAR(formula::fxGammaEncode(float(code)), formula64::fxGammaEncode(code), 2e-7);
    }
}

TEST_F(DisplayCodes, decodingAndEncodingAreInverseOnTheGpu)
{
    Picture codes(256, 1);
    for (int x = 0; x < 256; ++x)
        for (int c = 0; c < 3; ++c)
            codes.at(x, 0)[c] = float((x + 85 * c) % 256) / 255.0f;
    for (const TargetEncoding encoding : {TargetEncoding::DisplaySrgb, TargetEncoding::DisplayGamma})
        for (const float white : {1.0f, 2.0f, 8.0f, 1000.0f}) {
            const auto out = roundTrip(codes, encoding, white);
            for (size_t i = 0; i < out.size(); ++i)
                ASSERT_NEAR(out[i], codes.texels[i], 1e-4) << "value " << i << ", white " << white;
        }
}

TEST_F(DisplayCodes, brokenCodesBecomeBlackOrWhite)
{
    Picture codes(3, 1);
    codes.at(0, 0)[0] = std::numeric_limits<float>::quiet_NaN();
    codes.at(1, 0)[0] = -1.0f;
    codes.at(2, 0)[0] = std::numeric_limits<float>::infinity();
    const auto out = roundTrip(codes, TargetEncoding::DisplaySrgb, 8.0f);
    EXPECT_EQ(out[0], 0.0f);
    EXPECT_EQ(out[4], 0.0f);
    EXPECT_NEAR(out[8], 1.0f, 1e-5f);
}

TEST_F(DisplayCodes, onlyChangedPixelsAreWritten)
{
    Picture before(4, 1, {0.5f, 0.25f, 0.125f, 1.0f});
    before.at(3, 0)[1] = std::numeric_limits<float>::quiet_NaN();
    Picture picture = before;
    picture.at(1, 0)[2] = 0.25f;
    picture.at(2, 0)[3] = 0.5f;
    const Picture target(4, 1, {7, 7, 7, 7});
    for (const TargetEncoding encoding :
         {TargetEncoding::Linear, TargetEncoding::DisplaySrgb, TargetEncoding::DisplayGamma})
    {
        graph_->begin();
        const auto out = PresentChangesPass::addTo(
            *graph_, {import(picture), import(before), {}, import(target), block(encoding, 8.0f)});
        execute(out.target);
        const auto texels = read(out.target);
        for (const size_t kept : {0, 3})
            for (size_t c = 0; c < 4; ++c)
                EXPECT_EQ(texels[4 * kept + c], 7.0f) << kept;
        EXPECT_NE(texels[4], 7.0f);
        EXPECT_EQ(texels[11], 0.5f);
    }
}
