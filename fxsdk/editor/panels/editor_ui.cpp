#include "fxsdk/editor/panels/editor_ui.h"

#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>

namespace fx::editor {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

/// Names of windows are global in ImGui: those of a game and of another editor must differ.
std::string windowName(const PanelState& state, const char* title)
{
    char id[64];
    std::snprintf(id, sizeof id, "###fxsdk %p ", static_cast<const void*>(&state));
    return std::string(title) + id + title;
}

template <class Contents>
void panelWindow(const std::string& name, float x, float y, float width, float height, ImGuiWindowFlags flags,
                 Contents&& contents)
{
    ImGui::SetNextWindowPos({x, y});
    ImGui::SetNextWindowSize({std::max(width, 32.0f), std::max(height, 32.0f)});
    if (ImGui::Begin(name.c_str(), nullptr, kFixed | flags))
        contents();
    ImGui::End();
}

void tab(PanelState& state, const char* title, void (*contents)(PanelState&))
{
    const bool isOpen = ImGui::BeginTabItem(title);
    state.mark(std::string("tab/") + title);
    if (!isOpen)
        return;
    contents(state);
    ImGui::EndTabItem();
}

void lowerTabs(PanelState& state)
{
    if (!ImGui::BeginTabBar("lower"))
        return;
    tab(state, "Curve", curvePanel);
    tab(state, "Findings", findingsPanel);
    tab(state, "Changes", changesPanel);
    tab(state, "Budget", budgetPanel);
    tab(state, "Running games", gamesPanel);
    ImGui::EndTabBar();
}

void shortcuts(Session& session)
{
    const ImGuiIO& io = ImGui::GetIO();
    if (io.WantTextInput)
        return;
    if (isKeyPressed(ImGuiKey_Space))
        session.playback.isPlaying = !session.playback.isPlaying;
    if (!io.KeyCtrl)
        return;
    if (isKeyPressed(ImGuiKey_Z) && !io.KeyShift)
        session.undo();
    else if (isKeyPressed(ImGuiKey_Y) || (isKeyPressed(ImGuiKey_Z) && io.KeyShift))
        session.redo();
    else if (isLetterPressed('S'))
        session.save();
}

} // namespace

void applyStyle(float scale)
{
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.FrameRounding = style.WindowRounding = style.TabRounding = 3.0f;
    style.WindowBorderSize = 1.0f;
    style.CellPadding = {4.0f, 2.0f};
    style.Colors[ImGuiCol_WindowBg] = {0.13f, 0.14f, 0.17f, 1.0f};
    style.Colors[ImGuiCol_FrameBg] = {0.21f, 0.23f, 0.27f, 1.0f};
    style.Colors[ImGuiCol_Button] = {0.26f, 0.30f, 0.37f, 1.0f};
    style.Colors[ImGuiCol_Header] = {0.24f, 0.32f, 0.45f, 1.0f};
    style.Colors[ImGuiCol_TitleBgActive] = style.Colors[ImGuiCol_TitleBg] = {0.17f, 0.19f, 0.23f, 1.0f};
    style.ScaleAllSizes(scale);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr; // the layout is fixed
    constexpr std::array kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};
    for (const char* font : kFonts)
        if (std::filesystem::exists(font) && io.Fonts->AddFontFromFileTTF(font, 16.0f * scale))
            return;
    setTextScale(1.25f * scale); // the built-in font has 13 pixels
}

void drawEditor(PanelState& state, ImVec2 low, ImVec2 size)
{
    state.places.clear();
    state.closedHeaders.clear();
    const float line = ImGui::GetFontSize();
    const float top = line * 2.3f;
    const float left = std::min(size.x * 0.22f, line * 18.0f);
    const float right = std::min(size.x * 0.36f, line * 30.0f);
    const float middle = size.x - left - right;
    const float time = line * 6.6f;
    const float lower = std::max(size.y * 0.26f, line * 11.0f);
    const auto window = [&](const char* title, float x, float y, float w, float h, ImGuiWindowFlags flags,
                            auto&& contents) {
        panelWindow(windowName(state, title), low.x + x, low.y + y, w, h, flags, contents);
    };
    window("Commands", 0, 0, size.x, top, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar,
           [&] { topBar(state); });
    window("Elements", 0, top, left, size.y - top, 0, [&] { outlinerPanel(state); });
    window("Inspector", left + middle, top, right, size.y - top, 0, [&] { inspectorPanel(state); });
    window("Picture", left, top, middle, size.y - top - time - lower,
           ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar, [&] { viewportPanel(state); });
    window("Timeline", left, size.y - time - lower, middle, time, ImGuiWindowFlags_NoTitleBar,
           [&] { timelinePanel(state); });
    window("Details", left, size.y - lower, middle, lower, ImGuiWindowFlags_NoTitleBar,
           [&] { lowerTabs(state); });
    if (state.session.recovery() || state.session.conflict()) {
        ImGui::SetNextWindowPos({low.x + left + 24.0f, low.y + top + 48.0f});
        if (ImGui::Begin(windowName(state, "Question").c_str(), nullptr,
                         ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                             ImGuiWindowFlags_NoCollapse))
            questionPanel(state);
        ImGui::End();
    }
    shortcuts(state.session);
}

} // namespace fx::editor
