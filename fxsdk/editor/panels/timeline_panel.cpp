#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>

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
    const float width = ImGui::GetFontSize() * 4.5f;
    Member seconds;
    seconds.kind = MemberKind::Number;
    seconds.unit = "s";
    const auto field = [&](const char* label, const char* name, double value) {
        ImGui::SameLine(0.0f, 10.0f);
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(label);
        ImGui::SameLine();
        return numberField(state, name, value, seconds, width);
    };
    if (const auto edit = field("time s", "timeline/time", playback.time()))
        playback.scrub(edit->value);
    if (const auto edit = field("end s", "timeline/end", playback.end))
        playback.end = std::clamp(edit->value, 0.1, 3600.0);
    if (const auto edit = field("speed", "timeline/speed", playback.speed))
        playback.speed = std::clamp(edit->value, 0.0, 16.0);
}

/// Starts and bursts of all elements, at their times.
void marks(const Json& document, const Json& schema, ImVec2 low, ImVec2 size, double end)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const auto line = [&](const Json& time, ImU32 color) {
        if (!time.is_number() || time.get<double>() > end)
            return;
        const float x = low.x + size.x * float(time.get<double>() / end);
        draw->AddLine({x, low.y + 2}, {x, low.y + size.y - 2}, color, 2.0f);
    };
    for (const std::string& pointer : soloElements(document, schema)) {
        const Json& element = document.at(Json::json_pointer(pointer));
        if (!element.is_object())
            continue;
        line(element.value("start", Json()), IM_COL32(120, 190, 255, 200));
        const Json emission = element.value("emission", Json::object());
        if (!emission.is_object())
            continue;
        line(emission.value("start", Json()), IM_COL32(120, 190, 255, 200));
        const Json bursts = emission.value("bursts", Json::array());
        for (const Json& burst : bursts)
            if (burst.is_object())
                line(burst.value("time", Json()), IM_COL32(255, 140, 90, 220));
    }
}

void bar(PanelState& state)
{
    Playback& playback = state.session.playback;
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x, 50.0f), ImGui::GetFontSize() * 2.2f);
    ImGui::InvisibleButton("bar", size);
    state.mark("timeline/bar");
    if (ImGui::IsItemActive()) {
        playback.isPlaying = false;
        playback.scrub(double((ImGui::GetIO().MousePos.x - low.x) / size.x) * playback.end);
    }
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(24, 27, 33, 255));
    for (int i = 0; i <= 10; ++i) {
        const float x = low.x + size.x * float(i) / 10.0f;
        draw->AddLine({x, low.y + size.y * 0.7f}, {x, low.y + size.y}, IM_COL32(255, 255, 255, 60));
        if (i < 10)
            draw->AddText({x + 3, low.y + size.y * 0.45f}, IM_COL32(150, 155, 165, 255),
                          numberText(playback.end * i / 10.0).c_str());
    }
    if (state.session.document.kind() == DocumentKind::Preset)
        marks(state.session.document.json(), state.session.document.schema(), low, size, playback.end);
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
