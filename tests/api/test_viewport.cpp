// Parts of a target: split screens and the host's scissor test.
#include "tests/api/encoded_targets.h"

#include <cmath>

using fx::test::EncodedDepth;
using fx::test::EncodedTarget;

namespace {

constexpr int kHalf = 32; ///< [pixel] side of a quarter of the picture

} // namespace

class Viewport : public fx::test::EncodedTargetTest
{
protected:
    /// The same frame in a quarter of the target.
    FxFrameDef quarter(FxFrameDef def, int x, int y)
    {
        def.width = def.height = kHalf;
        def.viewportX = x * kHalf;
        def.viewportY = y * kHalf;
        return def;
    }

    std::vector<float> part(const std::vector<float>& picture, int x, int y) const
    {
        std::vector<float> out;
        for (int row = 0; row < kHalf; ++row) {
            const float* first = &picture[size_t(((y * kHalf + row) * kSize + x * kHalf) * 4)];
            out.insert(out.end(), first, first + kHalf * 4);
        }
        return out;
    }

    /// The whole picture repeats its lower left quarter.
    std::vector<float> repeated() const
    {
        const std::vector<float> full = gradient();
        std::vector<float> out(full.size());
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                for (int c = 0; c < 4; ++c)
                    out[size_t((y * kSize + x) * 4 + c)] =
                        full[size_t((y % kHalf * kSize + x % kHalf) * 4 + c)];
        return out;
    }
};

TEST_F(Viewport, eachQuarterShowsThePictureOfItsOwnAndTheOthersKeepTheirBits)
{
    for (const bool inPlace : {true, false})
        for (const uint32_t encoding : {FX_TARGET_LINEAR, FX_TARGET_DISPLAY_SRGB})
            for (const EncodedTarget& target : targetsOf(GL_RGBA16F)) {
                SCOPED_TRACE(target.name + (inPlace ? "" : ", with glare") + ", encoding " +
                             std::to_string(encoding));
                useSettings(inPlace);
                std::vector<float> first;
                for (int i = 0; i < 4; ++i) {
                    store(target, repeated());
                    const std::vector<float> before = stored(target);
                    const auto outcome = render(quarter(frameOf(target, {}, encoding), i % 2, i / 2));
                    ASSERT_EQ(outcome.result, FX_OK) << outcome.words;
                    const std::vector<float> after = stored(target);
                    for (int other = 0; other < 4; ++other) {
                        if (other != i) {
                            ASSERT_EQ(part(after, other % 2, other / 2), part(before, other % 2, other / 2))
                                << other << " beside " << i;
                        }
                    }
                    const std::vector<float> drawn = part(after, i % 2, i / 2);
                    ASSERT_NE(drawn, part(before, i % 2, i / 2));
                    if (i == 0)
                        first = drawn;
                    for (size_t k = 0; k < drawn.size(); ++k)
                        ASSERT_NEAR(drawn[k], first[k], 0x1p-9f * std::abs(first[k]) + 1e-6f)
                            << i << ", value " << k;
                }
            }
}

TEST_F(Viewport, depthIsThatOfTheSamePixels)
{
    for (const EncodedTarget& target : targetsOf(GL_RGBA32F)) {
        const bool hasSamples = target.name.find("samples") != std::string::npos;
        for (const EncodedDepth& depth : depthsOf(hasSamples ? 4 : 1)) {
            SCOPED_TRACE(target.name + ", " + depth.name);
            attach(target, depth);
            const EncodedDepth none;
            std::vector<std::vector<float>> shown;
            for (const EncodedDepth* given : {&depth, &none})
                for (int x = 0; x < 2; ++x) { // the wall stands in the right half
                    store(target, repeated());
                    ASSERT_EQ(render(quarter(frameOf(target, *given, 0), x, 0)).result, FX_OK);
                    shown.push_back(part(stored(target), x, 0));
                }
            EXPECT_EQ(shown[0], shown[2]) << "far plane";
            EXPECT_EQ(shown[1] != shown[3], depth.precision != 0);
        }
    }
}

TEST_F(Viewport, theFrameMustLieWithinItsTarget)
{
    FxFrameDef def = quarter(frameOf(targetsOf(GL_RGBA16F).front(), {}, 0), 1, 1);
    def.viewportX += 1;
    const auto outcome = render(def);
    EXPECT_EQ(outcome.result, FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(outcome.words.find("frame.width is 32 from viewportX 33"), std::string::npos) << outcome.words;
}

TEST_F(Viewport, theHostsScissorTestLimitsWhatIsWrittenWhereTheFrameSaysSo)
{
    auto& gl = textures_.gl;
    const EncodedDepth none;
    for (const bool inPlace : {true, false})
        for (const uint32_t encoding : {FX_TARGET_LINEAR, FX_TARGET_DISPLAY_SRGB})
            for (const EncodedTarget& target : targetsOf(GL_RGBA32F)) {
                SCOPED_TRACE(target.name + (inPlace ? "" : ", with glare") + ", encoding " +
                             std::to_string(encoding));
                useSettings(inPlace);
                const auto draw = [&](bool keep, bool enable) {
                    store(target, gradient());
                    FxFrameDef def = frameOf(target, none, encoding);
                    def.keepScissor = keep ? 1 : 0;
                    gl.Scissor(0, 0, kHalf, kSize);
                    enable ? gl.Enable(GL_SCISSOR_TEST) : gl.Disable(GL_SCISSOR_TEST);
                    EXPECT_EQ(render(def).result, FX_OK) << fxGetLastErrorMessage();
                    EXPECT_EQ(gl.IsEnabled(GL_SCISSOR_TEST), enable ? GL_TRUE : GL_FALSE);
                    gl.Disable(GL_SCISSOR_TEST);
                    return stored(target);
                };
                store(target, gradient());
                const std::vector<float> before = stored(target);
                const std::vector<float> whole = draw(false, false);
                EXPECT_EQ(draw(false, true), whole);
                EXPECT_EQ(draw(true, false), whole);
                const std::vector<float> cut = draw(true, true);
                for (int y = 0; y < 2; ++y) {
                    EXPECT_EQ(part(cut, 0, y), part(whole, 0, y));
                    EXPECT_EQ(part(cut, 1, y), part(before, 1, y));
                    EXPECT_NE(part(whole, 1, y), part(before, 1, y));
                }
            }
}
