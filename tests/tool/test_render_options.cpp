#include "fxsdk/cli/render/render_options.h"
#include "fxsdk/cli/scene/view_settings.h"

#include <gtest/gtest.h>

#include <limits>

namespace fx::cli {
namespace {

RenderArguments argumentsFor(const std::string& output)
{
    RenderArguments arguments;
    arguments.input = "library:explosion";
    arguments.output = output;
    return arguments;
}

render::ViewSettings settingsFor(RenderArguments arguments, OutputKind kind)
{
    render::ViewSettings settings;
    applyArguments(arguments, kind, settings);
    return settings;
}

TEST(RenderOptions, aStillIsOneFrameAtItsTime)
{
    RenderArguments arguments = argumentsFor("a.png");
    arguments.time = 0.6;
    arguments.size = "640x360";
    const auto plan = planRender(arguments);
    ASSERT_TRUE(plan.ok());
    ASSERT_EQ(plan->frames.size(), 1u);
    EXPECT_EQ(plan->frames[0].tick, base::toTicks(0.6));
    EXPECT_EQ(plan->width, 640);
    EXPECT_EQ(plan->height, 360);
}

TEST(RenderOptions, aFigureStandsWhereThreeNumbersSayOrNowhere)
{
    RenderArguments arguments = argumentsFor("a.png");
    EXPECT_FALSE(planRender(arguments)->figure.has_value());
    EXPECT_FALSE(planRender(arguments)->noFigure);
    arguments.figure = "off";
    EXPECT_TRUE(planRender(arguments)->noFigure);
    arguments.figure = "-1.5,0,2e3";
    const auto plan = planRender(arguments);
    ASSERT_TRUE(plan.ok());
    EXPECT_EQ(*plan->figure, glm::vec3(-1.5f, 0.0f, 2e3f));
    for (const char* wrong : {"on", "1", "1,2", "1,2,3,4", "1,2,", "1,2,nan", "1,2,1e6", "1,2,3x"}) {
        arguments.figure = wrong;
        const auto refused = planRender(arguments);
        ASSERT_FALSE(refused.ok()) << wrong;
        EXPECT_NE(refused.status().message().find("expected off or X,Y,Z"), std::string::npos) << wrong;
    }
}

TEST(RenderOptions, framesAreCountedFromFirstToLastAndTimedByTheRate)
{
    RenderArguments arguments = argumentsFor("a.%d.png");
    arguments.frames = "24:48";
    arguments.framesPerSecond = 24.0;
    const auto plan = planRender(arguments);
    ASSERT_TRUE(plan.ok());
    ASSERT_EQ(plan->frames.size(), 25u);
    EXPECT_EQ(plan->frames.front().number, 24);
    EXPECT_EQ(plan->frames.front().tick, base::kTicksPerSecond);
    EXPECT_EQ(plan->frames.back().tick, 2 * base::kTicksPerSecond);
}

TEST(RenderOptions, twoSecondsAreTheDefaultOfASequence)
{
    EXPECT_EQ(planRender(argumentsFor("a.mp4"))->frames.size(), 60u);
}

TEST(RenderOptions, oneMomentAndASequenceAreRefusedTogether)
{
    for (const char* output : {"a.%d.png", "a.%d.exr", "a.mp4"}) {
        RenderArguments arguments = argumentsFor(output);
        arguments.time = 1.0;
        const auto plan = planRender(arguments);
        ASSERT_FALSE(plan.ok()) << output;
        EXPECT_NE(plan.status().message().find("--frames or --times"), std::string::npos);
    }
}

TEST(RenderOptions, numbersThatMakeNoSenseAreRefused)
{
    for (const char* size :
         {"", "x", "10", "10x", "x10", "10x10x10", "0x5", "-1x5", "16385x1", "10x10 ", "1e3x10"})
    {
        RenderArguments arguments = argumentsFor("a.png");
        arguments.size = size;
        EXPECT_FALSE(planRender(arguments).ok()) << size;
    }
    for (const char* frames : {"1", "1:", ":1", "2:1", "-1:1", "0:1:2", "0:99999999999"}) {
        RenderArguments arguments = argumentsFor("a.%d.png");
        arguments.frames = frames;
        EXPECT_FALSE(planRender(arguments).ok()) << frames;
    }
    RenderArguments arguments = argumentsFor("a.png");
    arguments.time = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(planRender(arguments).ok());
}

TEST(RenderOptions, exrHoldsTheLinearPictureThatItsLayersAddUpTo)
{
    const render::ViewSettings exr = settingsFor(argumentsFor("a.exr"), OutputKind::Exr);
    EXPECT_FALSE(exr.toneMap || exr.dazzle.enabled);
    EXPECT_EQ(exr.shimmer.strength, 0.0f);
    EXPECT_TRUE(exr.layerOutputs);
    const render::ViewSettings png = settingsFor(argumentsFor("a.png"), OutputKind::Png);
    EXPECT_TRUE(png.toneMap && png.dazzle.enabled);
    EXPECT_GT(png.shimmer.strength, 0.0f);
    EXPECT_FALSE(png.layerOutputs);
}

TEST(RenderOptions, aFormThatIsNamedWinsOverTheQuality)
{
    RenderArguments arguments = argumentsFor("a.png");
    arguments.quality = "low";
    EXPECT_EQ(settingsFor(arguments, OutputKind::Png).form, render::BillboardForm::Constant);
    arguments.form = "kernel";
    EXPECT_EQ(settingsFor(arguments, OutputKind::Png).form, render::BillboardForm::Kernel);
    arguments.form = "planar";
    EXPECT_EQ(settingsFor(arguments, OutputKind::Png).form, render::BillboardForm::Planar);
}

TEST(RenderOptions, aCompositionThatIsNamedWinsOverTheScene)
{
    RenderArguments arguments = argumentsFor("a.png");
    EXPECT_EQ(settingsFor(arguments, OutputKind::Png).composition, render::Composition::Sorted);
    arguments.composition = "slabs";
    arguments.slabs = "6";
    const render::ViewSettings settings = settingsFor(arguments, OutputKind::Png);
    EXPECT_EQ(settings.composition, render::Composition::Slabs);
    EXPECT_EQ(settings.slabs, 6);
    EXPECT_EQ(toApi(settings).composition, uint32_t(FX_COMPOSITION_SLABS));
    EXPECT_EQ(toApi(settings).slabs, 6u);
}

TEST(ViewSettings, everyMemberArrivesInTheApiUnderItsName)
{
    render::ViewSettings s;
    s.exposureEv100 = 1.0f;
    s.lighting = {{2.0f, 3.0f, 4.0f}, {5.0f, 6.0f, 7.0f}, {8.0f, 9.0f, 10.0f}, 11.0f};
    s.shimmer = {12.0f, 13.0f};
    s.dazzle = {false, 14.0f, 15.0f, 16.0f, 17.0f, 18.0f, 19.0f};
    s.form = render::BillboardForm::Constant;
    s.saveState = false;
    s.detail = false;
    s.toneMap = s.layerOutputs = s.countOverdraw = true;
    const FxViewSettings api = toApi(s);
    const float values[] = {
        api.exposureEv100,     api.sunDirection[0],   api.sunDirection[1],   api.sunDirection[2],
        api.sunIlluminance[0], api.sunIlluminance[1], api.sunIlluminance[2], api.skyLuminance[0],
        api.skyLuminance[1],   api.skyLuminance[2],   api.groundAlbedo,      api.shimmerStrength,
        api.shimmerMaxOffset,  api.dazzleWhite,       api.dazzleA,           api.dazzleB,
        api.dazzleC,           api.dazzleRiseTime,    api.dazzleFallTime};
    float expected = 1.0f;
    for (const float value : values)
        EXPECT_EQ(value, expected++);
    EXPECT_EQ(api.billboardForm, uint32_t(FX_BILLBOARD_CONSTANT));
    EXPECT_EQ(api.dazzle + api.saveState + api.detail, 0u);
    EXPECT_EQ(api.toneMap + api.layerOutputs + api.countOverdraw, 3u);
}

} // namespace
} // namespace fx::cli
