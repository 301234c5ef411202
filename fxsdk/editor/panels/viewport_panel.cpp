#include "fxsdk/editor/panels/panels.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace fx::editor {

namespace {

constexpr double kTurn = 0.008; // [rad] per pixel
constexpr double kPan = 0.0015; // distances per pixel

/// Left: orbit. Middle, or shift and left: pan. Right: pan too. Wheel: zoom.
void moveByMouse(PanelState& state)
{
    OrbitCamera& camera = state.session.camera;
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) {
        camera.zoom(std::pow(0.88, double(io.MouseWheel)));
        state.session.followsCamera = false;
    }
    if (!ImGui::IsItemActive() || (io.MouseDelta.x == 0.0f && io.MouseDelta.y == 0.0f))
        return;
    state.session.followsCamera = false;
    const bool isPan = ImGui::IsMouseDown(2) || ImGui::IsMouseDown(1) || io.KeyShift;
    if (isPan)
        camera.pan(-kPan * io.MouseDelta.x, kPan * io.MouseDelta.y);
    else
        camera.orbit(-kTurn * io.MouseDelta.x, kTurn * io.MouseDelta.y);
}

/// Arrow keys, page up and page down fly at half the distance to the target per second.
void flyByKeys(PanelState& state)
{
    if (ImGui::GetIO().WantTextInput)
        return;
    const auto isDown = [](ImGuiKey key) { return isKeyDown(key) ? 1.0 : 0.0; };
    const glm::dvec3 way(isDown(ImGuiKey_RightArrow) - isDown(ImGuiKey_LeftArrow),
                         isDown(ImGuiKey_PageUp) - isDown(ImGuiKey_PageDown),
                         isDown(ImGuiKey_UpArrow) - isDown(ImGuiKey_DownArrow));
    const double step = 0.5 * state.session.camera.distance() * double(ImGui::GetIO().DeltaTime);
    if (way == glm::dvec3(0.0))
        return;
    state.session.camera.fly(step * way);
    state.session.followsCamera = false;
}

/// A text on a dark plate.
void plate(const std::string& text, ImVec2 at)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
    draw->AddRectFilled(at, {at.x + extent.x + 12, at.y + extent.y + 8}, IM_COL32(0, 0, 0, 150), 4.0f);
    draw->AddText({at.x + 6, at.y + 4}, IM_COL32_WHITE, text.c_str());
}

/// The present picture, the one of before left of the line, or the error.
void pictures(const PanelState& state, ImVec2 low, ImVec2 high)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const PictureState& picture = state.picture;
    if (state.error.isShown && state.error.texture != 0)
        return draw->AddImage(imageOf(state.error.texture), low, high);
    if (picture.texture != 0) // rows of GL begin at the bottom
        draw->AddImage(imageOf(picture.texture), low, high, {0, 1}, {1, 0});
    const Comparison& comparison = state.session.comparison;
    const float split = float(comparison.split);
    if (comparison.isShown && picture.beforeTexture != 0)
        draw->AddImage(imageOf(picture.beforeTexture), low, {low.x + split * (high.x - low.x), high.y},
                       {0, 1}, {split, 0});
}

void failurePlate(const std::string& failure, ImVec2 low, ImVec2 high)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const float wrap = high.x - low.x - 24.0f;
    const ImVec2 size = ImGui::CalcTextSize(failure.c_str(), nullptr, false, wrap);
    draw->AddRectFilled({low.x + 6, high.y - size.y - 18}, {high.x - 6, high.y - 6},
                        IM_COL32(90, 20, 16, 220), 4.0f);
    draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + 12, high.y - size.y - 12},
                  IM_COL32(255, 225, 220, 255), failure.c_str(), nullptr, wrap);
}

} // namespace

void viewportPanel(PanelState& state)
{
    viewportBar(state);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    state.pictureSize = {std::floor(std::max(room.x, 16.0f)), std::floor(std::max(room.y, 16.0f))};
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 high(low.x + state.pictureSize.x, low.y + state.pictureSize.y);
    ImGui::InvisibleButton("picture", state.pictureSize,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    state.mark("viewport");
    pictures(state, low, high);
    const ViewProjection view(state.session.camera, {double(low.x), double(low.y)},
                              {double(state.pictureSize.x), double(state.pictureSize.y)});
    ImGui::GetWindowDrawList()->PushClipRect(low, high, true);
    drawOverlays(state, view, low, high);
    ImGui::GetWindowDrawList()->PopClipRect();
    if (!viewportHandles(state, view, low, high))
        moveByMouse(state);
    flyByKeys(state);
    char text[160];
    std::snprintf(text, sizeof text, "%u particles   %.0f ms   %.2f s%s", state.picture.particles,
                  state.picture.milliseconds, state.session.playback.time(),
                  state.session.soloMute().isActive() ? "   solo or mute" : "");
    float line = low.y + 6;
    for (const std::string& shown :
         {std::string(text), overlayText(state.session.overlays, state.picture.overlays), state.error.text})
    {
        if (shown.empty())
            continue;
        plate(shown, {low.x + 6, line});
        line += ImGui::GetFontSize() + 12.0f;
    }
    const std::string& before = state.picture.beforeFailure;
    const bool isBefore =
        state.picture.failure.empty() && state.session.comparison.isShown && !before.empty();
    if (const std::string& failure = isBefore ? before : state.picture.failure; !failure.empty())
        failurePlate(failure, low, high);
}

} // namespace fx::editor
