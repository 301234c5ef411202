// Hosts whose targets hold codes of a display, or several samples, or whose depth is not a texture.
#include "shaders/formulas/formula.h"
#include "tests/api/encoded_targets.h"
#include "tests/rendering/gl/gl_host_state.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

using TargetEncoding = fx::test::EncodedTargetTest;
using fx::render::differences;
using fx::test::EncodedDepth;
using fx::test::EncodedTarget;
using fx::test::Outcome;

namespace {

constexpr uint32_t kDisplays[] = {FX_TARGET_DISPLAY_SRGB, FX_TARGET_DISPLAY_GAMMA};
constexpr const char* kEncodingNames[] = {"linear", "sRGB", "gamma"};

struct Format
{
    GLenum format;
    const char* name;
    double absolute; ///< tolerance of a stored value
    double relative; ///< tolerance relative to the value
    bool isSrgb;
    bool hasAlpha;
};

/// Three halves of a step; linear light is also rounded when it is blended.
constexpr Format kFormats[] = {
    {GL_RGBA8, "RGBA8", 1.5 / 255, 0, false, true},
    {GL_SRGB8_ALPHA8, "SRGB8_ALPHA8", 2.75 / 255, 0, true, true},
    {GL_RGB10_A2, "RGB10_A2", 1.5 / 1023, 0, false, false},
    {GL_RGBA16F, "RGBA16F", 0x1p-11, 0x1p-9, false, true},
    {GL_R11F_G11F_B10F, "R11F_G11F_B10F", 0x1p-11, 0x1p-4, false, false},
    // a copied depth of 24 bits may differ by a step, 5 um at the wall
    {GL_RGBA32F, "RGBA32F", 2e-4, 2e-4, false, true},
};

struct Row
{
    size_t drawn = 0;   ///< pictures
    double worst = 0.0; ///< largest error, in tolerances
    size_t outside = 0; ///< pixels outside of the effects that changed
    size_t states = 0;  ///< GL states that changed
};

} // namespace

class TargetTable : public fx::test::EncodedTargetTest
{
protected:
    void compare(const Format& format, const EncodedTarget& target, const EncodedDepth& depth,
                 uint32_t encoding, Row& io)
    {
        attach(target, depth);
        store(target, gradient());
        const std::vector<float> before = stored(target);
        fx::render::GlHost probing(gl_->loader());
        const fx::render::GlProbe states = probing.probe();
        const Outcome outcome = render(frameOf(target, depth, encoding));
        io.states += differences(states, probing.probe()).size();
        ASSERT_EQ(outcome.result, FX_OK) << outcome.words;
        const std::vector<float> after = stored(target);
        const Media& media = media_.at(depth.precision);
        const std::vector<double> wanted = byHand(media, before, encoding, format.isSrgb, 8.0);
        for (size_t i = 0; i < after.size(); ++i) {
            if (!media.touches(i / 4)) {
                io.outside +=
                    i % 4 == 0 && std::bit_cast<uint32_t>(after[i]) != std::bit_cast<uint32_t>(before[i]);
                continue;
            }
            if (i % 4 == 3 && !format.hasAlpha)
                continue;
            const bool isClamped = format.relative == 0;
            const double want = isClamped ? std::clamp(wanted[i], 0.0, 1.0) : wanted[i];
            const double allowed = format.absolute + format.relative * std::abs(want);
            io.worst = std::max(io.worst, std::abs(double(after[i]) - want) / allowed);
        }
        ++io.drawn;
    }

    std::map<GLenum, Media> media_{{0, media()},
                                   {GL_DEPTH_COMPONENT16, media(GL_DEPTH_COMPONENT16)},
                                   {GL_DEPTH_COMPONENT24, media(GL_DEPTH_COMPONENT24)},
                                   {GL_DEPTH_COMPONENT32F, media(GL_DEPTH_COMPONENT32F)}};
};

TEST_F(TargetTable, everyFormatOfColorAndDepthShowsThePictureInEveryEncoding)
{
    std::ostringstream table;
    for (const Format& format : kFormats) {
        for (const EncodedTarget& target : targetsOf(format.format)) {
            const bool hasSamples = target.name.find("samples") != std::string::npos;
            const std::vector<EncodedDepth> depths = depthsOf(hasSamples ? 4 : 1);
            for (uint32_t encoding = 0; encoding < 3; ++encoding) {
                if (format.isSrgb && encoding == FX_TARGET_DISPLAY_GAMMA && target.texture != 0)
                    continue; // refused
                Row row;
                for (const EncodedDepth& depth : depths) {
                    SCOPED_TRACE(format.name + (", " + target.name) + ", " + depth.name + ", " +
                                 kEncodingNames[encoding]);
                    compare(format, target, depth, encoding, row);
                    EXPECT_LE(row.worst, 1.0);
                    EXPECT_EQ(row.outside, 0u);
                    EXPECT_EQ(row.states, 0u);
                }
                table << "| GL_" << format.name << " | " << target.name << " | " << kEncodingNames[encoding]
                      << " | " << row.drawn << " | " << (row.worst <= 1.0 ? "right" : "wrong") << " | "
                      << row.outside << " | " << row.states << " |\n";
            }
        }
    }
    std::ofstream(FX_BINARY_DIR "/tests/target_encodings.txt") << table.str();
    std::ifstream file(std::filesystem::path(FX_SOURCE_DIR) / "docs/howto/host-targets.md");
    std::ostringstream documented;
    for (std::string line; std::getline(file, line);)
        if (line.rfind("| GL_", 0) == 0)
            documented << line << "\n";
    EXPECT_EQ(documented.str(), table.str())
        << "the wanted rows are in " FX_BINARY_DIR "/tests/target_encodings.txt";
}

TEST_F(TargetEncoding, fireOverCodesKeepsItsColor)
{
    // radiance of the flames goes to several times white: linear light in an LDR target clips it
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    settings.shimmerStrength = 0;
    settings.exposureEv100 = 13.0f;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const auto clipped = [&](uint32_t encoding) {
        const EncodedTarget target = targetsOf(GL_RGBA8).front();
        store(target, std::vector<float>(size_t(kSize * kSize * 4), 0.0f));
        EXPECT_EQ(render(frameOf(target, {}, encoding)).result, FX_OK);
        const std::vector<float> codes = stored(target);
        size_t both = 0; // red and green: what should be orange is yellow
        for (size_t i = 0; i < codes.size(); i += 4)
            both += codes[i] == 1.0f && codes[i + 1] == 1.0f;
        return both;
    };
    const size_t linear = clipped(FX_TARGET_LINEAR);
    EXPECT_GT(linear, 100u);
    EXPECT_LT(clipped(FX_TARGET_DISPLAY_SRGB), linear / 20);
    EXPECT_LT(clipped(FX_TARGET_DISPLAY_GAMMA), linear / 20);
}

TEST_F(TargetEncoding, withGlareButWithoutOverflowUntouchedPixelsKeepTheirBits)
{
    const Media open = media();
    FxViewSettings settings = fxDefaultViewSettings();
    settings.shimmerStrength = 0;
    settings.dazzleWhite = 1000.0f; // nothing is as bright
    for (const EncodedTarget& target : targetsOf(GL_RGB10_A2))
        for (const uint32_t encoding : kDisplays) {
            ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
            store(target, gradient());
            const std::vector<float> before = stored(target);
            ASSERT_EQ(render(frameOf(target, {}, encoding)).result, FX_OK);
            const std::vector<float> after = stored(target);
            for (size_t i = 0; i < after.size(); ++i)
                if (!open.touches(i / 4)) {
                    ASSERT_EQ(after[i], before[i]) << target.name << " value " << i;
                }
        }
}

TEST_F(TargetEncoding, shimmerBendsCodesAsItBendsLight)
{
    // by hand: the linear picture of the same light; white is so far above that crosstalk is nothing
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    settings.dazzleWhite = 1e6f;
    settings.shimmerMaxOffset = 100.0f;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const Media open = media();
    namespace f = fx::formula64;
    std::vector<float> light = gradient(), given = gradient();
    for (size_t i = 0; i < light.size(); ++i)
        if (i % 4 != 3) {
            const double y =
                0.9 * f::fxSrgbDecode(double(light[i])); // codes near 1 stand for very much light
            light[i] = float(f::fxToneCurveInverse(y, 1e6));
            given[i] = float(f::fxSrgbEncode(y));
        }
    for (const EncodedTarget& target : targetsOf(GL_RGBA32F)) {
        const std::vector<float> wanted = reference(frameOf(target, {}, FX_TARGET_LINEAR), light);
        store(target, given);
        FxFrameDef def = frameOf(target, {}, FX_TARGET_DISPLAY_SRGB);
        def.displayWhite = 1e6f;
        const Outcome outcome = render(def);
        ASSERT_EQ(outcome.result, FX_OK) << outcome.words;
        const std::vector<std::string> passes = fx::test::passNamesOf(view_);
        EXPECT_NE(std::find(passes.begin(), passes.end(), "heat shimmer"), passes.end()) << target.name;
        const std::vector<float> shown = stored(target);
        for (size_t i = 0; i < shown.size(); ++i)
            if (i % 4 != 3 && open.touches(i / 4)) {
                ASSERT_NEAR(shown[i], f::fxSrgbEncode(f::fxToneCurve(double(wanted[i]), 1e6)), 1.0 / 255)
                    << target.name << " value " << i;
            }
    }
}

TEST_F(TargetEncoding, smokeAttenuatesCodesOfClampedColorsWithoutAHaloInOneChannel)
{
    // blue has reached the end of its scale, and stands for more light only as far as displayWhite says
    const EncodedTarget target = targetsOf(GL_RGBA32F).front();
    const Media open = media();
    const auto bluest = [&](float white) {
        std::vector<float> codes;
        for (int i = 0; i < kSize * kSize; ++i)
            codes.insert(codes.end(), {0.7f, 0.8f, 1.0f, 1.0f});
        store(target, codes);
        FxFrameDef def = frameOf(target, {}, FX_TARGET_DISPLAY_SRGB);
        def.displayWhite = white;
        EXPECT_EQ(render(def).result, FX_OK) << fxGetLastErrorMessage();
        const std::vector<float> shown = stored(target);
        float most = 0.0f;
        for (size_t i = 0; i < shown.size(); i += 4)
            if (open.share[i] < 0.7f)
                most = std::max(most, shown[i + 2] - shown[i + 1]);
        return most;
    };
    EXPECT_LT(bluest(1.0f), 0.2f); // as in the codes themselves
    EXPECT_LT(bluest(2.0f), bluest(8.0f));
}

TEST_F(TargetEncoding, glareReachesCodesBesideTheFireAsItReachesLight)
{
    const Media open = media();
    FxViewSettings settings = fxDefaultViewSettings();
    settings.shimmerStrength = 0;
    settings.exposureEv100 = 9.0f; // fire overflows
    settings.dazzleA = 0.2f;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    namespace f = fx::formula64;
    const std::vector<float> black(size_t(kSize * kSize * 4), 0.0f);
    const std::vector<float> light = reference(frame(), black);
    for (const EncodedTarget& target : targetsOf(GL_RGBA32F)) {
        store(target, black);
        ASSERT_EQ(render(frameOf(target, {}, FX_TARGET_DISPLAY_SRGB)).result, FX_OK);
        const std::vector<float> codes = stored(target);
        double glare = 0.0, wanted = 0.0;
        for (size_t i = 0; i < codes.size(); ++i)
            if (i % 4 != 3 && !open.touches(i / 4)) {
                glare += f::fxToneCurveInverse(f::fxSrgbDecode(double(codes[i])), 8.0);
                wanted += double(light[i]);
            }
        EXPECT_GT(wanted, 0.0);
        EXPECT_NEAR(glare / wanted, 1.0, 0.1) << target.name; // crosstalk has moved light between channels
    }
}

TEST_F(TargetEncoding, fireAboveWhiteHasTheColorsOfTheToneMappedLinearPicture)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    settings.shimmerStrength = 0;
    settings.exposureEv100 = 7.0f; // the brightest channel is far above white
    const std::vector<float> black(size_t(kSize * kSize * 4), 0.0f);
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const std::vector<float> light = reference(frame(), black);
    const EncodedTarget target = targetsOf(GL_RGBA32F).front();
    FxFrameDef def = frameOf(target, {}, FX_TARGET_DISPLAY_SRGB);
    for (const float white : {8.0f, 4.0f, 2.0f, 1.0f}) {
        settings.dazzleWhite = white;
        settings.toneMap = 1;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
        const std::vector<float> wanted = reference(frame(), black);
        settings.toneMap = 0;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
        store(target, black);
        def.displayWhite = white;
        ASSERT_EQ(render(def).result, FX_OK);
        const std::vector<float> shown = stored(target);
        // A channel above white loses light by crosstalk in the linear picture, and none here: most in pure
        // red, 2.8, 5.3, 9.8 and 17.2 of 255 codes with these whites, as docs/howto/host-targets.md says.
        namespace f = fx::formula64;
        const double red = white * (1.0 - f::fxFilmCrosstalk(white, white) * 2.0 / 3.0);
        const double most = 1.0 - f::fxSrgbEncode(f::fxToneCurve(red, white));
        size_t bright = 0;
        for (size_t i = 0; i < shown.size(); ++i)
            if (i % 4 != 3) {
                ASSERT_NEAR(shown[i], wanted[i], most + 0.2 / 255) << "white " << white << " value " << i;
                bright += light[i] > 2.0f * white ? 1 : 0;
            }
        EXPECT_GT(bright, 10u);
    }
}

TEST_F(TargetEncoding, aPictureFromATextureComesOutWholeInCodes)
{
    for (const GLenum source : {GL_RGBA8, GL_SRGB8_ALPHA8}) {
        const GLuint color = textures_.make2D(source, kSize);
        write(color, gradient());
        const EncodedTarget target = targetsOf(GL_RGBA8)[1];
        store(target, std::vector<float>(size_t(kSize * kSize * 4), 0.0f));
        FxFrameDef def = frameOf(target, {}, FX_TARGET_DISPLAY_SRGB);
        def.colorTexture = color;
        ASSERT_EQ(render(def).result, FX_OK) << fxGetLastErrorMessage();
        const std::vector<float> given = read(color), codes = stored(target);
        const std::vector<double> wanted = byHand(media(), given, FX_TARGET_DISPLAY_SRGB, false, 8.0);
        const Media open = media();
        for (size_t i = 0; i < codes.size(); ++i) {
            ASSERT_NEAR(codes[i], std::min(wanted[i], 1.0), 1.5 / 255) << "value " << i;
            if (!open.touches(i / 4)) {
                ASSERT_EQ(codes[i], given[i]) << "value " << i;
            }
        }
    }
}

TEST_F(TargetEncoding, noStateOfAHostileHostChangesInAnyMode)
{
    std::vector<FxFrameDef> frames;
    for (const EncodedTarget& target : targetsOf(GL_RGBA8)) {
        const bool hasSamples = target.name.find("samples") != std::string::npos;
        for (const EncodedDepth& depth : depthsOf(hasSamples ? 4 : 1))
            if (depth.renderbuffer != 0) {
                attach(target, depth);
                for (uint32_t encoding = 0; encoding < 3; ++encoding)
                    frames.push_back(frameOf(target, depth, encoding));
            }
    }
    fx::render::GlHost host(gl_->loader());
    host.makeHostile();
    size_t changed = 0;
    for (FxFrameDef& def : frames) {
        GLint origin = GL_LOWER_LEFT;
        textures_.gl.GetIntegerv(GL_CLIP_ORIGIN, &origin);
        def.upperLeftOrigin = origin == GL_UPPER_LEFT ? 1 : 0;
        const fx::render::GlProbe before = host.probe();
        const Outcome outcome = render(def);
        EXPECT_EQ(outcome.result, FX_OK) << outcome.words;
        changed += differences(before, host.probe()).size();
        RecordProperty("states_probed", int(before.size()));
    }
    EXPECT_EQ(changed, 0u);
    host.release();
}

TEST_F(TargetEncoding, contradictionsAreRefusedInWords)
{
    const auto refused = [&](const FxFrameDef& def, const char* words) {
        const Outcome outcome = render(def);
        EXPECT_EQ(outcome.result, FX_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(outcome.words.find(words), std::string::npos) << outcome.words;
    };
    FxFrameDef def = frameOf(targetsOf(GL_SRGB8_ALPHA8).front(), {}, FX_TARGET_DISPLAY_GAMMA);
    refused(def, "set frame.targetEncoding to FX_TARGET_DISPLAY_SRGB");
    def = frameOf(targetsOf(GL_RGBA8)[1], {}, FX_TARGET_DISPLAY_SRGB);
    def.depthFromFramebuffer = 1;
    refused(def, "frame.framebuffer has no depth");
    def.depthTexture = depth_.name();
    refused(def, "give one of them");
    useSettings(true, true);
    refused(frameOf(targetsOf(GL_RGBA8).front(), {}, FX_TARGET_DISPLAY_SRGB), "tone-map twice");
}
