#include "tests/fuzz/calls_player.h"

namespace fx::fuzz {

std::span<const CallsPlayer::Call> CallsPlayer::callsOfViews()
{
    static constexpr std::array<Call, 6> kCalls{&CallsPlayer::createView,     &CallsPlayer::render,
                                                &CallsPlayer::setSettings,    &CallsPlayer::readView,
                                                &CallsPlayer::setCalibration, &CallsPlayer::destroyView};
    return kCalls;
}

FxViewSettings CallsPlayer::anySettings()
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.structSize = structSize(sizeof settings);
    settings.shimmerStrength = floatNumber(2.0);
    settings.dazzle = input_.below(2);
    settings.billboardForm = input_.below(4);
    settings.saveState = input_.below(2);
    settings.detail = input_.below(2);
    settings.toneMap = input_.below(2);
    settings.layerOutputs = input_.below(2);
    settings.outputs = input_.below(33);
    settings.countOverdraw = input_.below(2);
    constexpr std::array<float, 4> kScales{1.0f, 0.5f, 0.25f, 0.3f};
    settings.layerScale = kScales[input_.below(4)];
    settings.lodBias = floatNumber(8.0);
    settings.lodImpostorPixels = floatNumber(13.0);
    settings.blockParallax = floatNumber(16.0);
    settings.blockError = floatNumber(1.0);
    settings.activationOverlay = input_.below(2);
    settings.budgetMilliseconds = floatNumber(10.0);
    settings.budgetClock = FX_BUDGET_CLOCK_CPU;
    return settings;
}

void CallsPlayer::createView()
{
    PlayedContext& played = anyContext();
    FxScene* const scene = input_.one(8) ? anyScene().scene : sceneOf(played).scene;
    FxView*& slot = viewOf(played);
    if (slot)
        return;
    const FxViewSettings settings = anySettings();
    FxView* made = nullptr;
    const FxResult result =
        checked(fxCreateView(played.context, scene, input_.one(2) ? nullptr : &settings, &made));
    require((result == FX_OK) == (made != nullptr), "only a created view is handed out");
    if (made && slot) // a callback has made one
        checked(fxDestroyView(made));
    else if (made)
        slot = made;
}

void CallsPlayer::destroyView()
{
    PlayedContext& played = anyContext();
    FxView*& slot = viewOf(played);
    FxView* const view = slot;
    if (checked(fxDestroyView(view)) == FX_OK && slot == view)
        slot = nullptr;
}

void CallsPlayer::setSettings()
{
    FxView* const view = anyView();
    const FxViewSettings settings = anySettings();
    checked(fxView_SetSettings(view, input_.one(8) ? nullptr : &settings));
}

void CallsPlayer::render()
{
    FxView* const view = anyView();
    const GlHost& gl = glHost();
    FxFrameDef frame = fxDefaultFrameDef();
    frame.structSize = structSize(sizeof frame);
    frame.origin[2] = 3.0 + number(3.0);
    const float nearPlane = 0.1f, farPlane = 100.0f;
    frame.projection[0] = frame.projection[5] = input_.one(8) ? floatNumber(2.0) : 1.0f;
    frame.projection[10] = (farPlane + nearPlane) / (nearPlane - farPlane);
    frame.projection[11] = -1.0f;
    frame.projection[14] = 2.0f * farPlane * nearPlane / (nearPlane - farPlane);
    frame.projection[15] = 0.0f;
    frame.colorTexture = input_.one(8) ? input_.byte() : gl.color;
    frame.depthTexture = input_.one(4) ? 0 : input_.one(8) ? input_.byte() : gl.depth;
    frame.width = frame.height = input_.one(8) ? int32_t(input_.below(64)) : gl.size;
    frame.depthConvention = input_.one(8) ? 1 : 0;
    frame.deltaTime = 1.0 / 60.0;
    frame.resetHistory = input_.below(2);
    checked(fxView_Render(view, input_.one(16) ? nullptr : &frame));
}

void CallsPlayer::readView()
{
    FxView* const view = anyView();
    FxViewStatistics statistics = sized<FxViewStatistics>();
    checked(fxView_GetStatistics(view, &statistics));
    FxLayerTextures textures = sized<FxLayerTextures>();
    checked(fxView_GetLayerTextures(view, &textures));
    FxOutputTextures outputs = sized<FxOutputTextures>();
    checked(fxView_GetOutputTextures(view, &outputs));
    FxQualityReport report = sized<FxQualityReport>();
    checked(fxView_GetQualityReport(view, &report));
    FxQualityChoice choice = sized<FxQualityChoice>();
    checked(fxView_GetQualityChoice(view, input_.below(4), &choice));
    uint32_t passes = 0;
    checked(fxView_GetPassCount(view, &passes));
    std::array<char, 8> name{};
    checked(fxView_GetPassName(view, input_.below(8), name.data(), input_.below(9)));
}

void CallsPlayer::setCalibration()
{
    FxView* const view = anyView();
    constexpr std::string_view kText = R"({"version": 1, "ladders": []})";
    const bool isBuiltIn = input_.one(2);
    checked(fxView_SetQualityCalibration(view, isBuiltIn ? nullptr : kText.data(),
                                         isBuiltIn ? 0 : kText.size(), "recorded"));
}

} // namespace fx::fuzz
