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
    if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f)
        camera.zoom(std::pow(0.88, double(io.MouseWheel)));
    if (!ImGui::IsItemActive())
        return;
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
    const auto isDown = [](ImGuiKey key) { return ImGui::IsKeyDown(ImGui::GetKeyIndex(key)) ? 1.0 : 0.0; };
    const glm::dvec3 way(isDown(ImGuiKey_RightArrow) - isDown(ImGuiKey_LeftArrow),
                         isDown(ImGuiKey_PageUp) - isDown(ImGuiKey_PageDown),
                         isDown(ImGuiKey_UpArrow) - isDown(ImGuiKey_DownArrow));
    const double step = 0.5 * state.session.camera.distance() * double(ImGui::GetIO().DeltaTime);
    if (way != glm::dvec3(0.0))
        state.session.camera.fly(step * way);
}

} // namespace

void viewportPanel(PanelState& state)
{
    const ImVec2 room = ImGui::GetContentRegionAvail();
    state.pictureSize = {std::max(room.x, 16.0f), std::max(room.y, 16.0f)};
    const ImVec2 low = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("picture", state.pictureSize,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    state.mark("viewport");
    moveByMouse(state);
    flyByKeys(state);
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const ImVec2 high(low.x + state.pictureSize.x, low.y + state.pictureSize.y);
    if (state.picture.texture != 0) // rows of GL begin at the bottom
        draw->AddImage(reinterpret_cast<ImTextureID>(uintptr_t(state.picture.texture)), low, high, {0, 1},
                       {1, 0});
    char text[160];
    std::snprintf(text, sizeof text, "%u particles   %.0f ms   %.2f s%s", state.picture.particles,
                  state.picture.milliseconds, state.session.playback.time(),
                  state.session.soloMute().isActive() ? "   solo or mute" : "");
    const ImVec2 extent = ImGui::CalcTextSize(text);
    draw->AddRectFilled({low.x + 6, low.y + 6}, {low.x + extent.x + 18, low.y + extent.y + 14},
                        IM_COL32(0, 0, 0, 150), 4.0f);
    draw->AddText({low.x + 12, low.y + 10}, IM_COL32(255, 255, 255, 255), text);
    if (!state.picture.failure.empty()) {
        const float wrap = state.pictureSize.x - 24.0f;
        const ImVec2 size = ImGui::CalcTextSize(state.picture.failure.c_str(), nullptr, false, wrap);
        draw->AddRectFilled({low.x + 6, high.y - size.y - 18}, {high.x - 6, high.y - 6},
                            IM_COL32(90, 20, 16, 220), 4.0f);
        draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {low.x + 12, high.y - size.y - 12},
                      IM_COL32(255, 225, 220, 255), state.picture.failure.c_str(), nullptr, wrap);
    }
}

} // namespace fx::editor
