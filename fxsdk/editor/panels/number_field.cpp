#include "fxsdk/editor/panels/number_field.h"

#include "fxsdk/editor/inspector/expression.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace fx::editor {

namespace {

/// Width [pixel] of the handle of a field: of a narrow one the number needs the room.
float handleWidth(float width)
{
    return std::clamp(0.2f * width, 0.65f * ImGui::GetFontSize(), 1.1f * ImGui::GetFontSize());
}

/// Change [unit of the member] of a drag by one pixel.
double dragSpeed(double value, const Member& member)
{
    if (member.kind == MemberKind::Integer)
        return 0.25;
    return std::max(std::abs(value) * 0.01, 0.005);
}

std::optional<NumberEdit> typedNumber(PanelState& state, const std::string& name, double value,
                                      const Member& member, float width)
{
    const std::string label = "##" + name;
    const ImGuiID id = ImGui::GetID(label.c_str());
    char buffer[256];
    const std::string shown = std::isnan(value) ? std::string() : numberText(value);
    const std::string text = state.typedField == id ? state.typed : shown;
    std::snprintf(buffer, sizeof buffer, "%s", text.c_str());
    ImGui::SetNextItemWidth(width);
    ImGui::InputTextWithHint(label.c_str(), "none", buffer, sizeof buffer, ImGuiInputTextFlags_AutoSelectAll);
    state.mark(name);
    if (ImGui::IsItemActive()) {
        state.typedField = id;
        state.typed = buffer;
        return std::nullopt;
    }
    if (state.typedField != id)
        return std::nullopt;
    state.typedField = 0;
    if (!ImGui::IsItemDeactivatedAfterEdit() || text.empty())
        return std::nullopt;
    const auto number = evaluate(buffer, member.unit);
    if (!number) {
        state.session.message = number.status().message();
        return std::nullopt;
    }
    return NumberEdit{*number, 0};
}

} // namespace

std::string numberText(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.7g", value);
    return text;
}

std::optional<NumberEdit> numberField(PanelState& state, const std::string& name, double value,
                                      const Member& member, float width)
{
    std::optional<NumberEdit> edit =
        typedNumber(state, name, value, member, std::max(width - handleWidth(width), 30.0f));
    ImGui::SameLine(0.0f, 1.0f);
    ImGui::SetNextItemWidth(handleWidth(width));
    double dragged = std::isnan(value) ? std::max(member.minimum.value_or(0.0), 0.0) : value;
    const std::string handle = "##drag " + name;
    if (ImGui::DragScalar(handle.c_str(), ImGuiDataType_Double, &dragged, float(dragSpeed(dragged, member)),
                          nullptr, nullptr, "\xC2\xB7", ImGuiSliderFlags_NoInput))
    {
        const uint64_t gesture = state.dragOf();
        edit = NumberEdit{std::strtod(numberText(dragged).c_str(), nullptr), gesture};
    } else
        (void)state.dragOf();
    state.mark(name + "/drag");
    return edit;
}

} // namespace fx::editor
