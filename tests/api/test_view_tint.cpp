// The tint of an instance in pictures of every technique that draws particles and media.
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

constexpr float kRed[3] = {1.0f, 0.0f, 0.0f};
constexpr float kBlack[3] = {0.0f, 0.0f, 0.0f};

/// An effect, and how it is drawn.
struct TintedEffect
{
    const char* name;
    std::string preset; ///< text, or a name of the library
    uint32_t composition;
    int updates;
};

std::string emitterWith(const std::string& members)
{
    return R"({"version":1,"ground":false,"emitters":[{"shape":"sphere","size":0.4,"emission":{"rate":60},"lifetime":1,
        "speed":1,"radius":0.3,"forces":{"gravity":0},)" +
           members + "}]}";
}

std::vector<TintedEffect> effects()
{
    const std::string smoke = emitterWith(R"("albedoOverLife":[0.6,0.7,0.8],"opticalDepth":1)");
    const std::string fire =
        emitterWith(R"("layer":"fire","temperature":1700,"albedoOverLife":[0.2,0.2,0.2])");
    const std::string glow = emitterWith(R"("emissionOverLife":[2000,3000,4000])");
    return {
        {"sprites", emitterWith(R"("appearance":{"kind":"sprite","luminance":3000})"), FX_COMPOSITION_SORTED,
         20},
        {"meshes",
         emitterWith(R"("appearance":{"kind":"mesh","mesh":"library:debris-chunk.obj","blend":"opaque"})"),
         FX_COMPOSITION_SORTED, 20},
        {"trails",
         emitterWith(R"("appearance":{"kind":"none"},"trail":{"lifetime":0.5,"width":0.2,"luminance":3000})"),
         FX_COMPOSITION_SORTED, 20},
        {"sprites of the GPU",
         emitterWith(R"("compute":"gpu","maxParticles":100,"appearance":{"kind":"sprite","luminance":3000})"),
         FX_COMPOSITION_SORTED, 20},
        {"smoke, sorted", smoke, FX_COMPOSITION_SORTED, 20},
        {"fire, sorted", fire, FX_COMPOSITION_SORTED, 20},
        {"glow, sorted", glow, FX_COMPOSITION_SORTED, 20},
        {"fire in slabs", fire, FX_COMPOSITION_SLABS, 20},
        {"smoke in slabs", smoke, FX_COMPOSITION_SLABS, 20},
        {"fire in a volume", fire, FX_COMPOSITION_VOLUME, 20},
        {"smoke in a volume", smoke, FX_COMPOSITION_VOLUME, 20},
        {"blocks", "ash-plume", FX_COMPOSITION_SLABS, 8},
        {"blocks in a volume", "ash-plume", FX_COMPOSITION_VOLUME, 8}};
}

class ViewTint : public fx::test::ViewApiTest
{
protected:
    std::vector<float> drawn(const TintedEffect& effect, const float* tint)
    {
        FxScene* scene = nullptr;
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        FxInstanceDef def = fxDefaultInstanceDef();
        if (effect.preset.front() == '{')
            def.preset = fx::test::loadText(context_, effect.preset);
        else
            EXPECT_EQ(fxLoadPresetLibrary(context_, effect.preset.c_str(), &def.preset), FX_OK);
        if (tint)
            std::copy_n(tint, 3, def.tint);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK) << fxGetLastErrorMessage();
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.shimmerStrength = 0;
        settings.composition = effect.composition;
        settings.exposureEv100 = 12.0f;
        settings.blockError = 0.0f; // a tint changes which blocks are impostors
        for (int i = 0; i < 3; ++i) {
            settings.sunIlluminance[i] = 20'000.0f;
            settings.skyLuminance[i] = 1'000.0f;
        }
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        for (int i = 0; i < effect.updates; ++i)
            EXPECT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        FxFrameDef target = frame();
        if (effect.preset.front() != '{') {
            target.origin[1] = 30.0;
            target.origin[2] = 150.0;
        }
        std::vector<float> result;
        const int frames = effect.preset.find("gpu") == std::string::npos ? 1 : 2; // the GPU needs one before
        for (int i = 0; i < frames; ++i) {
            fillPicture();
            EXPECT_EQ(fxView_Render(view, &target), FX_OK) << fxGetLastErrorMessage();
            result = picture();
        }
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
        return result;
    }
};

} // namespace

TEST_F(ViewTint, aRedTintLeavesRedAsItIsAndNoLightOfOtherColors)
{
    for (const TintedEffect& effect : effects()) {
        SCOPED_TRACE(effect.name);
        const std::vector<float> plain = drawn(effect, nullptr), red = drawn(effect, kRed);
        ASSERT_EQ(plain.size(), red.size());
        float redChange = 0, brightest = 0, greenest = 0, plainGreenest = 0;
        for (size_t i = 0; i < plain.size(); i += 4) {
            const float level = std::max(plain[i], 1.0f);
            redChange = std::max(redChange, std::abs(red[i] - plain[i]) / level);
            brightest = std::max(brightest, std::abs(plain[i] - kBackground));
            greenest = std::max({greenest, red[i + 1], red[i + 2]});
            plainGreenest = std::max({plainGreenest, plain[i + 1], plain[i + 2]});
        }
        EXPECT_GT(brightest, 0.02f); // it is seen
        EXPECT_LE(redChange, 0.02f);
        EXPECT_LE(greenest, kBackground * 1.001f);
        EXPECT_GT(plainGreenest, kBackground * 1.02f);
    }
}

TEST_F(ViewTint, aBlackTintOnlyHidesWhatIsBehind)
{
    for (const TintedEffect& effect : effects()) {
        const std::string name = effect.name;
        if (name != "meshes" && name != "trails" && name != "fire, sorted" && name != "smoke in slabs")
            continue;
        SCOPED_TRACE(name);
        const std::vector<float> black = drawn(effect, kBlack);
        float darkest = kBackground;
        for (size_t i = 0; i < black.size(); ++i) {
            if (i % 4 == 3)
                continue;
            ASSERT_LE(black[i], kBackground * 1.001f);
            darkest = std::min(darkest, black[i]);
        }
        EXPECT_LT(darkest, 0.98f * kBackground);
    }
}
