// Lights of a view: the host's, those of the effects, and the shadow of media on the host's surfaces.
#include "tests/api/view_fixture.h"
#include "tests/rendering/gl/gl_host_state.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

using fx::render::differences;
using fx::render::GlHost;

namespace {

class ViewLights : public fx::test::ViewApiTest
{
protected:
    /// Sunlight without sky.
    void sunlight(uint32_t lightSlices = 1)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.sunIlluminance[0] = settings.sunIlluminance[1] = settings.sunIlluminance[2] = 1e4f;
        settings.lightSlices = lightSlices;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    }

    FxMediaShadow shadow(uint32_t kind, uint32_t index)
    {
        FxMediaShadow shadow{};
        shadow.structSize = sizeof shadow;
        EXPECT_EQ(fxView_GetMediaShadow(view_, kind, index, &shadow), FX_OK) << fxGetLastErrorMessage();
        return shadow;
    }

    std::vector<float> render(const FxFrameDef& def)
    {
        fillPicture();
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    }

    FxFrameDef frameWithoutTargets() const
    {
        FxFrameDef def = frame();
        def.colorTexture = def.depthTexture = 0;
        return def;
    }
};

FxLight lamp()
{
    FxLight light = fxDefaultLight();
    light.position[1] = 2.0;
    light.intensity[0] = light.intensity[1] = light.intensity[2] = 1e5f;
    return light;
}

} // namespace

TEST_F(ViewLights, aPreparedFrameShowsTheMomentOfItsPreparation)
{
    sunlight();
    update(60);
    const FxFrameDef def = frame();
    const std::vector<float> before = render(def);
    const FxFrameDef early = frameWithoutTargets();
    ASSERT_EQ(fxView_PrepareLights(view_, &early), FX_OK) << fxGetLastErrorMessage();
    update(10);
    EXPECT_EQ(render(def), before);
    EXPECT_NE(render(def), before) << "the next frame shows the present again";
}

TEST_F(ViewLights, aPreparedFrameThatIsNeverDrawnChangesNothing)
{
    sunlight();
    update(60);
    FxFrameDef def = frame();
    const std::vector<float> before = render(def);
    FxFrameDef other = def;
    other.origin[0] = 1.0;
    for (int i = 0; i < 3; ++i)
        ASSERT_EQ(fxView_PrepareLights(view_, &other), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(render(def), before);
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK);
    sunlight();
    EXPECT_EQ(render(def), before);
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK); // the view is destroyed while it holds the moment
}

TEST_F(ViewLights, preparationLeavesTheStateOfGlAlone)
{
    sunlight();
    update(60);
    GlHost host(gl_->loader());
    host.makeHostile();
    FxFrameDef def = frameWithoutTargets();
    def.upperLeftOrigin = 1; // as its clip control
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK) << fxGetLastErrorMessage();
    def.origin[0] = 0.25;
    const auto before = host.probe();
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(differences(before, host.probe()), std::vector<std::string>());
}

TEST_F(ViewLights, mediaCastShadowsInTheLightsThatThereAre)
{
    sunlight();
    update(60);
    const FxLight light = lamp();
    ASSERT_EQ(fxView_SetLights(view_, &light, 1), FX_OK) << fxGetLastErrorMessage();
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK);
    const FxMediaShadow sun = shadow(FX_LIGHT_SUN, 0);
    EXPECT_NE(sun.texture, 0u);
    EXPECT_EQ(sun.tiles[0][3], 32.0f);
    EXPECT_EQ(sun.place[3], 0.0f);
    const FxMediaShadow point = shadow(FX_LIGHT_HOST, 0);
    EXPECT_EQ(point.texture, sun.texture);
    EXPECT_EQ(point.place[3], 1.0f);
    EXPECT_NEAR(point.place[1], 2.0f - 0.0f, 1e-5f);
    EXPECT_NEAR(point.place[2], -3.0f, 1e-5f) << "relative to the frame's origin";
    EXPECT_EQ(shadow(FX_LIGHT_HOST, 1).texture, 0u);
    EXPECT_EQ(shadow(FX_LIGHT_EFFECT, 99).texture, 0u);
    EXPECT_EQ(shadow(FX_LIGHT_HOST, 1).tiles[0][3], 0.0f);
    sunlight(0);
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK);
    EXPECT_EQ(shadow(FX_LIGHT_SUN, 0).texture, 0u);
    EXPECT_EQ(shadow(FX_LIGHT_SUN, 0).right[0][0], 0.0f);
}

TEST_F(ViewLights, aLightOfTheHostLightsMediaAndStaysWhenSettingsChange)
{
    sunlight();
    update(60);
    const FxFrameDef def = frame();
    const std::vector<float> without = render(def);
    const FxLight light = lamp();
    ASSERT_EQ(fxView_SetLights(view_, &light, 1), FX_OK);
    const std::vector<float> with = render(def);
    double gained = 0.0;
    for (size_t i = 0; i < with.size(); ++i)
        gained += double(with[i] - without[i]);
    EXPECT_GT(gained, 1.0);
    sunlight();
    EXPECT_EQ(render(def), with);
    ASSERT_EQ(fxView_SetLights(view_, nullptr, 0), FX_OK);
    const std::vector<float> again = render(def);
    double most = 0.0;
    for (size_t i = 0; i < again.size(); ++i)
        most = std::max(most, double(std::abs(again[i] - without[i])));
    EXPECT_LT(most, 1e-4) << "but for the rounding of places in a larger texture";
}

TEST_F(ViewLights, aLightOutOfRangeIsRefusedByNameAndTheOthersStay)
{
    sunlight();
    update(60);
    const FxFrameDef def = frame();
    const FxLight good = lamp();
    ASSERT_EQ(fxView_SetLights(view_, &good, 1), FX_OK);
    const std::vector<float> before = render(def);
    const auto refuse = [&](const char* member, void (*spoil)(FxLight&)) {
        FxLight lights[2] = {lamp(), lamp()};
        spoil(lights[1]);
        const FxResult result = fxView_SetLights(view_, lights, 2);
        EXPECT_TRUE(result == FX_ERROR_INVALID_ARGUMENT || result == FX_ERROR_VERSION) << member;
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), member), nullptr) << fxGetLastErrorMessage();
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    refuse("structSize", [](FxLight& l) { l.structSize = 3; });
    refuse("radius", [](FxLight& l) { l.radius = -1.0f; });
    refuse("radius", [](FxLight& l) { l.radius = kNan; });
    refuse("position", [](FxLight& l) { l.position[2] = 2e9; });
    refuse("intensity", [](FxLight& l) { l.intensity[1] = -1.0f; });
    refuse("axis", [](FxLight& l) { l.axis[0] = 1.0f; });
    refuse("axis", [](FxLight& l) { l.axis[0] = kNan; });
    refuse("outerConeAngle", [](FxLight& l) { l.outerConeAngle = 3.2f; });
    refuse("innerConeAngle", [](FxLight& l) { l.outerConeAngle = 0.5f; });
    const std::vector<FxLight> many(FX_MOST_LIGHTS + 1, lamp());
    EXPECT_EQ(fxView_SetLights(view_, many.data(), uint32_t(many.size())), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_SetLights(view_, nullptr, 1), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(render(def), before);
}

TEST_F(ViewLights, fireIsALightForTheLevel)
{
    uint32_t count = 99;
    EXPECT_EQ(fxView_GetEffectLightCount(view_, &count), FX_OK);
    EXPECT_EQ(count, 0u) << "no frame yet";
    update(60);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK);
    ASSERT_EQ(fxView_GetEffectLightCount(view_, &count), FX_OK);
    ASSERT_EQ(count, 1u) << "dust does not shine";
    FxLight light{};
    light.structSize = sizeof light;
    ASSERT_EQ(fxView_GetEffectLight(view_, 0, &light), FX_OK);
    EXPECT_LT(std::hypot(light.position[0], light.position[1], light.position[2]), 1.0);
    EXPECT_GT(light.intensity[0], light.intensity[2]);
    EXPECT_GT(light.radius, 0.1f);
    EXPECT_EQ(fxView_GetEffectLight(view_, 1, &light), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ViewLights, eachLightSaysWhatItsPlanesTake)
{
    uint32_t count = 99;
    EXPECT_EQ(fxView_GetLightCostCount(view_, &count), FX_OK);
    EXPECT_EQ(count, 0u) << "no frame yet";
    FxViewSettings settings = fxDefaultViewSettings();
    settings.sunIlluminance[1] = 1e4f;
    settings.skyLuminance[1] = 100.0f;
    settings.castingLights = 1;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    FxLight lamps[2] = {lamp(), lamp()};
    lamps[1].intensity[0] *= 4.0f;
    ASSERT_EQ(fxView_SetLights(view_, lamps, 2), FX_OK);
    update(60);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK);
    ASSERT_EQ(fxView_GetLightCostCount(view_, &count), FX_OK);
    uint32_t casting = 0, skies = 0;
    for (uint32_t i = 0; i < count; ++i) {
        FxLightCost cost{};
        cost.structSize = sizeof cost;
        ASSERT_EQ(fxView_GetLightCost(view_, i, &cost), FX_OK);
        EXPECT_EQ(cost.kind == FX_LIGHT_SUN, i == 0);
        EXPECT_EQ(cost.kind == FX_LIGHT_SKY, i + 1 == count);
        EXPECT_EQ(cost.planes == 0, cost.bytes == 0);
        EXPECT_EQ(cost.planes == 0, cost.rays == 0);
        EXPECT_EQ(cost.milliseconds, 0.0f) << "no frame was timed";
        if (i == 0) {
            EXPECT_EQ(cost.planes, settings.lightSlicePlanes);
            EXPECT_EQ(cost.rays, uint64_t(settings.lightSliceTexels) * settings.lightSliceTexels);
            EXPECT_EQ(cost.bytes, 8 * cost.rays * cost.planes);
        }
        casting += cost.planes > 0 ? 1 : 0;
        skies += cost.kind == FX_LIGHT_SKY ? 1 : 0;
    }
    EXPECT_EQ(skies, 1u);
    EXPECT_EQ(casting, 3u) << "the sun, one at a point, and the sky";
    FxLightCost cost{};
    EXPECT_EQ(fxView_GetLightCost(view_, 0, &cost), FX_ERROR_VERSION);
    cost.structSize = sizeof cost;
    EXPECT_EQ(fxView_GetLightCost(view_, count, &cost), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetLightCost(nullptr, 0, &cost), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetLightCostCount(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ViewLights, timedFramesSayHowLongPlanesTakeWhetherTheyWerePreparedOrNot)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.sunIlluminance[1] = 1e4f;
    settings.skyLuminance[1] = 100.0f;
    settings.budgetMilliseconds = 1e4f;
    settings.budgetClock = FX_BUDGET_CLOCK_CPU;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    double before = 0.0;
    for (const bool prepares : {false, true}) {
        update(60);
        const FxFrameDef def = frame();
        if (prepares) {
            ASSERT_EQ(fxView_PrepareLights(view_, &def), FX_OK);
        }
        ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
        uint32_t count = 0;
        ASSERT_EQ(fxView_GetLightCostCount(view_, &count), FX_OK);
        double perRay = 0.0;
        for (uint32_t i = 0; i < count; ++i) {
            FxLightCost cost{};
            cost.structSize = sizeof cost;
            ASSERT_EQ(fxView_GetLightCost(view_, i, &cost), FX_OK);
            EXPECT_EQ(cost.milliseconds > 0.0f, cost.rays > 0);
            if (cost.rays == 0)
                continue;
            if (perRay == 0.0)
                perRay = cost.milliseconds / double(cost.rays);
            EXPECT_NEAR(cost.milliseconds / double(cost.rays), perRay, 1e-3 * perRay);
        }
        EXPECT_GT(perRay, 0.0) << prepares;
        EXPECT_NE(perRay, before) << "the time of another frame";
        before = perRay;
    }
}

TEST_F(ViewLights, withoutEffectsThereIsNoCallOfGl)
{
    FxScene* empty = nullptr;
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    ASSERT_EQ(fxCreateScene(context_, &sceneDef, &empty), FX_OK);
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    FxView* view = nullptr;
    ASSERT_EQ(fxCreateView(context_, empty, &settings, &view), FX_OK);
    const FxFrameDef def = frame();
    ASSERT_EQ(fxView_PrepareLights(view, &def), FX_OK);
    ASSERT_EQ(fxView_Render(view, &def), FX_OK);
    FxViewStatistics statistics{};
    statistics.structSize = sizeof statistics;
    ASSERT_EQ(fxView_GetStatistics(view, &statistics), FX_OK);
    EXPECT_EQ(statistics.glCalls, 0u);
    FxMediaShadow shadow{};
    shadow.structSize = sizeof shadow;
    ASSERT_EQ(fxView_GetMediaShadow(view, FX_LIGHT_SUN, 0, &shadow), FX_OK);
    EXPECT_EQ(shadow.texture, 0u);
    EXPECT_EQ(fxDestroyView(view), FX_OK);
}

TEST_F(ViewLights, theGlslCompilesInAShaderOfTheHost)
{
    const std::string source =
        "#version 420 core\n" + std::string(fxGetMediaShadowGlsl()) +
        "layout(std140) uniform Shadow { FxMediaShadow shadow; };\n"
        "uniform sampler2D planes;\n"
        "in vec3 place;\n"
        "out vec4 color;\n"
        "void main() { color = vec4(fxMediaTransmittance(planes, shadow, place), 1.0); }\n";
    const char* text = source.c_str();
    const GLuint shader = host_->gl.CreateShader(GL_FRAGMENT_SHADER);
    host_->gl.ShaderSource(shader, 1, &text, nullptr);
    host_->gl.CompileShader(shader);
    GLint compiled = 0;
    host_->gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    char log[2048] = "";
    host_->gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
    EXPECT_TRUE(compiled) << log;
    host_->gl.DeleteShader(shader);
}

TEST_F(ViewLights, wrongArgumentsAreRefused)
{
    FxMediaShadow shadow{};
    uint32_t count = 0;
    FxLight light = fxDefaultLight();
    const FxFrameDef def = frame();
    EXPECT_EQ(fxView_PrepareLights(nullptr, &def), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_PrepareLights(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_SetLights(nullptr, nullptr, 0), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetMediaShadow(view_, FX_LIGHT_SUN, 0, &shadow), FX_ERROR_VERSION);
    EXPECT_EQ(fxView_GetMediaShadow(view_, FX_LIGHT_SUN, 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    shadow.structSize = sizeof shadow;
    EXPECT_EQ(fxView_GetMediaShadow(view_, 3, 0, &shadow), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetEffectLightCount(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetEffectLightCount(nullptr, &count), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetEffectLight(view_, 0, &light), FX_ERROR_INVALID_ARGUMENT);
    const auto refuse = [&](const char* member, void (*spoil)(FxFrameDef&)) {
        FxFrameDef frameDef = frame();
        spoil(frameDef);
        EXPECT_EQ(fxView_Render(view_, &frameDef), FX_ERROR_INVALID_ARGUMENT) << member;
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), member), nullptr) << fxGetLastErrorMessage();
        EXPECT_EQ(fxView_PrepareLights(view_, &frameDef), FX_ERROR_INVALID_ARGUMENT) << member;
    };
    refuse("sunShadowMatrix", [](FxFrameDef& f) { f.sunShadowMatrix[3] = 0.1f; });
    refuse("sunShadowMatrix", [](FxFrameDef& f) { f.sunShadowMatrix[0] = NAN; });
    refuse("sunShadowConvention", [](FxFrameDef& f) { f.sunShadowConvention = 2; });
    refuse("sunShadowEdge", [](FxFrameDef& f) { f.sunShadowEdge = -1.0f; });
    refuse("targetEncoding", [](FxFrameDef& f) { f.targetEncoding = 3; });
    refuse("depthFromFramebuffer", [](FxFrameDef& f) { f.depthFromFramebuffer = 2; });
    refuse("viewportX", [](FxFrameDef& f) { f.viewportX = -1; });
    refuse("viewportY", [](FxFrameDef& f) { f.viewportY = 16385; });
    refuse("displayWhite", [](FxFrameDef& f) { f.displayWhite = 0.5f; });
    refuse("reserved", [](FxFrameDef& f) { f.reserved = 1; });
    refuse("keepScissor", [](FxFrameDef& f) { f.keepScissor = 2; });
    FxFrameDef wrong = frame();
    wrong.sunShadowTexture = color_.name(); // no depth
    update(60);
    EXPECT_EQ(fxView_Render(view_, &wrong), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "sunShadowTexture"), nullptr) << fxGetLastErrorMessage();
    const auto refuseSetting = [&](const char* member, void (*spoil)(FxViewSettings&)) {
        FxViewSettings settings = fxDefaultViewSettings();
        spoil(settings);
        EXPECT_EQ(fxView_SetSettings(view_, &settings), FX_ERROR_INVALID_ARGUMENT) << member;
        EXPECT_NE(std::strstr(fxGetLastErrorMessage(), member), nullptr) << fxGetLastErrorMessage();
    };
    refuseSetting("lightSlices", [](FxViewSettings& s) { s.lightSlices = 2; });
    refuseSetting("lightSlicePlanes", [](FxViewSettings& s) { s.lightSlicePlanes = 1; });
    refuseSetting("lightSlicePlanes", [](FxViewSettings& s) { s.lightSlicePlanes = 129; });
    refuseSetting("lightSliceTexels", [](FxViewSettings& s) { s.lightSliceTexels = 12; });
    refuseSetting("lightSliceTexels", [](FxViewSettings& s) { s.lightSliceTexels = 520; });
    refuseSetting("castingLights", [](FxViewSettings& s) { s.castingLights = 5; });
    refuseSetting("lightSamples", [](FxViewSettings& s) { s.lightSamples = 0; });
    refuseSetting("lightRefreshFrames", [](FxViewSettings& s) { s.lightRefreshFrames = 17; });
    refuseSetting("multipleScattering", [](FxViewSettings& s) { s.multipleScattering = 4; });
    refuseSetting("composition", [](FxViewSettings& s) { s.composition = 77; });
    refuseSetting("slabs", [](FxViewSettings& s) { s.slabs = 7; });
}
