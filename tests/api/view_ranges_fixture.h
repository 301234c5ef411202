/// @file view_ranges_fixture.h
/// Frames that are drawn range by range of depth, between the transparent surfaces of a host.
#pragma once

#include "rendering/image/image.h"
#include "tests/api/view_fixture.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace fx::test {

constexpr float kStep = 1.0f / 255.0f; ///< of a display
constexpr float kEndless = 1e9f;       ///< [m] FxFrameDef::rangeFar of all effects

/// An effect, and where ranges begin that cut it.
struct Cut
{
    const char* preset;
    double distance;           ///< [m] from the eye to the origin of the effect
    double height;             ///< [m] of the eye over the origin
    int updates;               ///< before the picture
    std::array<float, 2> ends; ///< [m] ascending
};

constexpr Cut kCampfire{"campfire", 3.0, 0.8, 60, {2.8f, 3.1f}};
constexpr Cut kExplosion{kLargeEffect, 14.0, 2.0, 40, {12.0f, 14.5f}};
constexpr Cut kDebris{"debris", 6.0, 0.8, 25, {5.4f, 6.3f}}; // opaque meshes in dust
constexpr Cut kNearExplosion{kLargeEffect, 9.0, 2.0, 40, {}};
constexpr Cut kSparks{"sparks", 3.0, 0.8, 60, {2.8f, 3.1f}};
constexpr Cut kCloud{"cumulus", 2'500.0, 900.0, 2, {2'300.0f, 2'600.0f}};

class ViewRangesTest : public ViewApiTest
{
protected:
    FxView* show(const Cut& cut, uint32_t composition)
    {
        const std::string name = cut.preset;
        const size_t colon = name.find(':');
        FxPresetId preset{};
        EXPECT_EQ(
            fxLoadPresetLibrary(context_, name.substr(colon == name.npos ? 0 : colon + 1).c_str(), &preset),
            FX_OK)
            << fxGetLastErrorMessage();
        return showPreset(preset, cut.updates, sunny(composition));
    }
    FxView* showPreset(FxPresetId preset, int updates, const FxViewSettings& settings)
    {
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &def, &shown_), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = preset;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(shown_, &instance, &id), FX_OK);
        step(updates);
        return makeView(settings);
    }
    static FxViewSettings sunny(uint32_t composition)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.composition = composition;
        settings.dazzle = 0;
        settings.exposureEv100 = 15.0f; // bright daylight
        for (int i = 0; i < 3; ++i) {
            settings.sunIlluminance[i] = 60'000.0f;
            settings.skyLuminance[i] = 4'000.0f;
        }
        return settings;
    }
    FxView* makeView(const FxViewSettings& settings)
    {
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, shown_, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        return view;
    }
    void step(int updates)
    {
        for (int i = 0; i < updates; ++i)
            EXPECT_EQ(fxScene_Update(shown_, kFrame), FX_OK);
    }
    void hide(FxView* view)
    {
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        EXPECT_EQ(fxDestroyScene(shown_), FX_OK);
    }
    FxFrameDef eye(const Cut& cut) const
    {
        FxFrameDef def = frame();
        def.origin[1] = cut.height;
        def.origin[2] = cut.distance;
        return def;
    }
    void clear(float value)
    {
        const float color[4] = {value, value, value, 1.0f};
        host_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, color);
    }
    void render(FxView* view, FxFrameDef def, uint32_t part, float from, float to)
    {
        def.rangePart = part;
        def.rangeNear = from;
        def.rangeFar = to;
        ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
    }
    std::vector<float> whole(FxView* view, const FxFrameDef& def, float background)
    {
        clear(background);
        render(view, def, FX_RANGE_ONLY, 0.0f, kEndless);
        return picture();
    }
    std::vector<float> inRanges(FxView* view, const Cut& cut, float background)
    {
        return inRanges(view, cut, eye(cut), background);
    }
    std::vector<float> inRanges(FxView* view, const Cut& cut, const FxFrameDef& def, float background)
    {
        clear(background);
        render(view, def, FX_RANGE_FIRST, cut.ends[1], kEndless);
        render(view, def, FX_RANGE_NEXT, cut.ends[0], cut.ends[1]);
        render(view, def, FX_RANGE_LAST, 0.0f, cut.ends[0]);
        return picture();
    }
    /// A pane of green glass in the middle of the picture: it lets through a share of each color, and
    /// reflects.
    static void tint(std::vector<float>& io)
    {
        constexpr std::array<float, 3> kThrough{0.2f, 0.7f, 0.35f}, kReflected{0.02f, 0.03f, 0.04f};
        for (int y = kSize / 8; y < kSize * 7 / 8; ++y)
            for (int x = kSize / 3; x < kSize * 2 / 3; ++x)
                for (size_t c = 0; c < 3; ++c) {
                    float& value = io[(size_t(y) * kSize + size_t(x)) * 4 + c];
                    value = value * kThrough[c] + kReflected[c];
                }
    }
    void drawGlass()
    {
        std::vector<float> pixels = picture();
        tint(pixels);
        host_->gl.TextureSubImage2D(color_.name(), 0, 0, 0, kSize, kSize, GL_RGBA, GL_FLOAT, pixels.data());
    }
    /// Writes a PNG if FXSDK_PICTURES names a folder, four pixels for each, with a curve for bright light.
    static void writePicture(const std::string& name, const std::vector<float>& pixels)
    {
        const char* const folder = std::getenv("FXSDK_PICTURES");
        if (!folder)
            return;
        constexpr int kEach = 4, kSide = kSize * kEach;
        image::Image image{kSide, kSide, 3, std::vector<float>(size_t(kSide) * kSide * 3)};
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x)
                for (size_t c = 0; c < 3; ++c) {
                    const size_t row = size_t((kSide - 1 - y) / kEach); // the top row comes first
                    const float value = pixels[(row * kSize + size_t(x / kEach)) * 4 + c];
                    image.at(x, y)[c] = image::linearToSrgb(value / (value + 0.5f));
                }
        const auto bytes = image::writePng(image);
        ASSERT_TRUE(bytes.ok()) << bytes.status().message();
        std::ofstream(std::string(folder) + "/glass-" + name + ".png", std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes->data()), std::streamsize(bytes->size()));
    }
    FxViewStatistics countsOf(FxView* view)
    {
        FxViewStatistics counts{};
        counts.structSize = sizeof counts;
        EXPECT_EQ(fxView_GetStatistics(view, &counts), FX_OK);
        return counts;
    }

    FxScene* shown_ = nullptr;
};

/// Share of the background that is seen in each pixel, from pictures over two backgrounds.
inline std::vector<float> transmittance(const std::vector<float>& dark, const std::vector<float>& bright)
{
    std::vector<float> through;
    for (size_t i = 0; i < dark.size(); i += 4)
        through.push_back(std::min(bright[i] - dark[i], 1.0f));
    return through;
}

} // namespace fx::test
