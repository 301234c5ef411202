#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/editor/session/time_edits.h"
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

void tooltip(const char* text)
{
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", text);
}

/// Adds a trigger at the present time; where an instance listens to several events, one of them is chosen.
void triggerButton(PanelState& state)
{
    Session& session = state.session;
    sameLineIfItFits("+ trigger");
    if (button(state, "+ trigger", "timeline/trigger")) {
        state.triggered = triggeredInstance(session.document, session.selection);
        state.triggerNames = triggerNames(session.document, session.name(), state.triggered);
        if (state.triggerNames.empty())
            session.message =
                "Nothing listens to a trigger: an emitter needs an event with \"on\": \"host\" and a name.";
        else if (state.triggerNames.size() > 1)
            ImGui::OpenPopup("trigger popup");
        else
            session.run(addTrigger(session.document, state.triggered, state.triggerNames[0],
                                   session.playback.time()));
    }
    tooltip("Triggers an event of the host at the present time; of a scene: that of the selected instance");
    if (!ImGui::BeginPopup("trigger popup"))
        return;
    for (const std::string& name : state.triggerNames) {
        if (ImGui::Selectable(name.c_str()))
            session.run(addTrigger(session.document, state.triggered, name, session.playback.time()));
        state.mark("timeline/trigger/" + name);
    }
    ImGui::EndPopup();
}

void cameraButtons(PanelState& state)
{
    Session& session = state.session;
    sameLineIfItFits("+ camera key");
    if (button(state, "+ camera key", "timeline/camera key"))
        session.run(addCameraKey(session.document, session.camera, session.playback.time()));
    tooltip("Lets the camera of the document be at this view at the present time");
    if (!session.hasCameraKeys())
        return;
    sameLineIfItFits(ImGui::CalcTextSize("follow camera").x + ImGui::GetFrameHeight() + 8.0f);
    ImGui::Checkbox("follow camera", &session.followsCamera);
    state.mark("timeline/follow");
    tooltip("Looks through the camera of the document while its keys are played, until the view is moved");
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
    case MarkKind::Trigger:
        return IM_COL32(255, 110, 200, 230);
    case MarkKind::CameraKey:
        return IM_COL32(240, 235, 150, 230);
    }
    return IM_COL32_WHITE;
}

/// A ball for what the effect does, a diamond for what is done to it.
void drawMark(const TimeMark& mark, float x, ImVec2 low, float height, bool isHeld)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const ImU32 color = colorOf(mark.kind);
    const float radius = isHeld ? 5.0f : 3.5f;
    draw->AddLine({x, low.y + 2}, {x, low.y + height - 2}, color, isHeld ? 4.0f : 2.0f);
    if (mark.isRemovable())
        draw->AddNgonFilled({x, low.y + (mark.kind == MarkKind::Trigger ? 16.0f : 8.0f)}, radius + 2.0f,
                            color, 4);
    else
        draw->AddCircleFilled({x, low.y + height - 4}, radius, color);
}

/// What is under the mouse: its name, and its end by a click of the right button. @return whether it is gone
bool touchMark(PanelState& state, const TimeMark& mark)
{
    Session& session = state.session;
    ImGui::SetTooltip("%s%s", markText(session.document, mark).c_str(),
                      mark.isRemovable() ? "\ndrag: move   right click: remove" : "\ndrag: move");
    if (!mark.isRemovable() || !ImGui::IsMouseClicked(1))
        return false;
    session.run(removeTimed(session.document, mark.pointer));
    return true;
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
    const bool isHovered = ImGui::IsItemHovered();
    const std::vector<TimeMark> all = timeMarks(session.document);
    float nearest = kMarkGrab;
    const TimeMark* touched = nullptr;
    for (const TimeMark& mark : all) {
        if (mark.time > end)
            continue;
        const float x = low.x + size.x * float(mark.time / end);
        const std::string name = "mark" + mark.pointer;
        state.places[name] = {{x - 3, low.y}, {x + 3, low.y + size.y}, true};
        if (std::abs(mouse.x - x) < nearest) {
            nearest = std::abs(mouse.x - x);
            touched = &mark;
            if (isTaken)
                state.heldMark = name;
        }
        drawMark(mark, x, low, size.y, state.heldMark == name);
    }
    if (touched && isHovered && !isActive && touchMark(state, *touched))
        return true;
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
    triggerButton(state);
    cameraButtons(state);
    bar(state);
}

} // namespace fx::editor
