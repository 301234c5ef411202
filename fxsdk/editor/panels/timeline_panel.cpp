#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/editor/session/time_marks.h"

#include <algorithm>
#include <cmath>

namespace fx::editor {

namespace {

void transport(PanelState& state)
{
    Playback& playback = state.session.playback;
    if (button(state, playback.isPlaying ? "pause" : "play", "timeline/play"))
        playback.isPlaying = !playback.isPlaying;
    ImGui::SameLine();
    if (button(state, "|<", "timeline/start"))
        playback.scrub(0.0);
    ImGui::SameLine();
    if (button(state, "<", "timeline/back"))
        playback.scrub(playback.time() - 1.0 / Playback::kStepsPerSecond);
    ImGui::SameLine();
    if (button(state, ">", "timeline/forward"))
        playback.scrub(playback.time() + 1.0 / Playback::kStepsPerSecond);
    ImGui::SameLine();
    ImGui::Checkbox("loop", &playback.isLooping);
    state.mark("timeline/loop");
    const float width = ImGui::GetFontSize() * 4.2f;
    Member seconds;
    seconds.kind = MemberKind::Number;
    seconds.unit = "s";
    const auto field = [&](const char* label, const char* name, double value) {
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(label);
        ImGui::SameLine();
        return numberField(state, name, value, seconds, width);
    };
    if (const auto edit = field("at", "timeline/time", playback.time()))
        playback.scrub(edit->value);
    if (const auto edit = field("of", "timeline/end", playback.end))
        playback.end = std::clamp(edit->value, 0.1, 3600.0);
    if (const auto edit = field("s, speed", "timeline/speed", playback.speed))
        playback.speed = std::clamp(edit->value, 0.0, 16.0);
}

constexpr float kMarkGrab = 6.0f; // [pixel]

ImU32 colorOf(MarkKind kind)
{
    switch (kind) {
    case MarkKind::Start:
        return IM_COL32(120, 190, 255, 200);
    case MarkKind::Burst:
        return IM_COL32(255, 140, 90, 220);
    case MarkKind::Event:
        return IM_COL32(170, 230, 120, 220);
    }
    return IM_COL32_WHITE;
}

/// Draws the marks, and drags the one that is held. Call it after the item of the bar.
/// @return whether the mouse holds one
bool marks(PanelState& state, ImVec2 low, ImVec2 size)
{
    Session& session = state.session;
    const double end = session.playback.end;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool isTaken = ImGui::IsItemActivated() && ImGui::IsMouseDown(0);
    const bool isActive = ImGui::IsItemActive();
    if (!isActive)
        state.heldMark.clear();
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const std::vector<TimeMark> all = timeMarks(session.document);
    float nearest = kMarkGrab;
    for (const TimeMark& mark : all) {
        if (mark.time > end)
            continue;
        const float x = low.x + size.x * float(mark.time / end);
        const std::string name = "mark" + mark.pointer;
        state.places[name] = {{x - 3, low.y}, {x + 3, low.y + size.y}, true};
        if (isTaken && std::abs(mouse.x - x) < nearest) {
            nearest = std::abs(mouse.x - x);
            state.heldMark = name;
        }
        const bool isHeld = state.heldMark == name;
        draw->AddLine({x, low.y + 2}, {x, low.y + size.y - 2}, colorOf(mark.kind), isHeld ? 4.0f : 2.0f);
        draw->AddCircleFilled({x, low.y + size.y - 4}, isHeld ? 5.0f : 3.5f, colorOf(mark.kind));
    }
    if (isTaken)
        ++state.gesture;
    if (state.heldMark.empty() || isTaken || ImGui::GetIO().MouseDelta.x == 0.0f)
        return !state.heldMark.empty();
    for (const TimeMark& mark : all)
        if ("mark" + mark.pointer == state.heldMark)
            session.run(session.document.set(
                mark.pointer, timeAt(session.document, mark, double((mouse.x - low.x) / size.x) * end),
                state.gesture));
    return true;
}

void bar(PanelState& state)
{
    Playback& playback = state.session.playback;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 50.0f), ImGui::GetFontSize() * 2.2f);
    ImGui::InvisibleButton("bar", size);
    state.mark("timeline/bar");
    const bool isPressed = ImGui::IsItemActive();
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(24, 27, 33, 255));
    if (!marks(state, low, size) && isPressed) {
        playback.isPlaying = false;
        playback.scrub(double((ImGui::GetIO().MousePos.x - low.x) / size.x) * playback.end);
    }
    for (int i = 0; i <= 10; ++i) {
        const float x = low.x + size.x * float(i) / 10.0f;
        draw->AddLine({x, low.y + size.y * 0.7f}, {x, low.y + size.y}, IM_COL32(255, 255, 255, 60));
        if (i < 10)
            draw->AddText({x + 3, low.y + size.y * 0.45f}, IM_COL32(150, 155, 165, 255),
                          numberText(playback.end * i / 10.0).c_str());
    }
    const float x = low.x + size.x * float(playback.time() / playback.end);
    draw->AddLine({x, low.y}, {x, low.y + size.y}, IM_COL32(255, 255, 255, 255), 2.0f);
    draw->AddTriangleFilled({x - 6, low.y}, {x + 6, low.y}, {x, low.y + 9}, IM_COL32(255, 255, 255, 255));
}

} // namespace

void timelinePanel(PanelState& state)
{
    transport(state);
    bar(state);
}

} // namespace fx::editor
