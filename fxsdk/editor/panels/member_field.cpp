#include "fxsdk/editor/panels/member_field.h"

#include "fxsdk/editor/panels/curve_keys.h"
#include "fxsdk/editor/panels/number_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace fx::editor {

namespace {

void set(PanelState& state, const Member& member, Json value, uint64_t gesture = 0)
{
    state.session.run(setMember(state.session.document, member.pointer, std::move(value), gesture));
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN(); // of a number that nothing states

double numberOf(const Json& value)
{
    return value.is_number() ? value.get<double>() : 0.0;
}

void booleanField(PanelState& state, const Member& member, const Json& value)
{
    bool isOn = value.is_boolean() && value.get<bool>();
    if (ImGui::Checkbox(("##" + member.pointer).c_str(), &isOn))
        set(state, member, isOn);
    state.mark(member.pointer);
}

std::string textOf(const Json& value)
{
    return value.is_string() ? value.get<std::string>() : value.dump();
}

void choiceField(PanelState& state, const Member& member, const Json& value)
{
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    const bool isOpen = ImGui::BeginCombo(("##" + member.pointer).c_str(), textOf(value).c_str());
    state.mark(member.pointer);
    if (!isOpen)
        return;
    for (const Json& choice : member.choices) {
        if (ImGui::Selectable(textOf(choice).c_str(), choice == value))
            set(state, member, choice);
        state.mark(member.pointer + "=" + textOf(choice));
    }
    ImGui::EndCombo();
}

/// Lets a text grow while it is typed.
int growText(ImGuiInputTextCallbackData* data)
{
    if (data->EventFlag == ImGuiInputTextFlags_CallbackResize) {
        auto& text = *static_cast<std::string*>(data->UserData);
        text.resize(size_t(data->BufTextLen));
        data->Buf = text.data();
    }
    return 0;
}

/// A field for text of any length. @return what was typed, when it is left
std::optional<std::string> typedText(PanelState& state, const Member& member, std::string text)
{
    const std::string label = "##" + member.pointer;
    const ImGuiID id = ImGui::GetID(label.c_str());
    if (state.typedField == id)
        text = state.typed;
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x);
    ImGui::InputText(label.c_str(), text.data(), text.capacity() + 1, ImGuiInputTextFlags_CallbackResize,
                     growText, &text);
    state.mark(member.pointer);
    if (ImGui::IsItemActive()) {
        state.typedField = id;
        state.typed = text.c_str(); // up to its end, which typing has moved
        return std::nullopt;
    }
    if (state.typedField != id)
        return std::nullopt;
    state.typedField = 0;
    return ImGui::IsItemDeactivatedAfterEdit() ? std::optional<std::string>(text.c_str()) : std::nullopt;
}

void textField(PanelState& state, const Member& member, const Json& value)
{
    const bool hasText = member.isPresent && value.is_string();
    if (auto typed = typedText(state, member, hasText ? value.get<std::string>() : std::string()))
        set(state, member, std::move(*typed));
}

/// Numbers side by side. @return the index of the one that has changed, or -1
int numbersField(PanelState& state, const Member& member, std::span<double> io, uint64_t& outGesture)
{
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (ImGui::GetContentRegionAvail().x - gap * float(io.size() - 1)) / float(io.size());
    int changed = -1;
    if (io.size() > 2) // narrow fields
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2.0f, ImGui::GetStyle().FramePadding.y});
    for (size_t i = 0; i < io.size(); ++i) {
        if (i > 0)
            ImGui::SameLine(0.0f, gap);
        const std::string name = io.size() == 1 ? member.pointer : member.pointer + "/" + std::to_string(i);
        if (const auto edit = numberField(state, name, io[i], member, width)) {
            io[i] = edit->value;
            outGesture = edit->gesture;
            changed = int(i);
        }
    }
    if (io.size() > 2)
        ImGui::PopStyleVar();
    return changed;
}

void plainNumberField(PanelState& state, const Member& member, const Json& value)
{
    std::array<double, 1> numbers{hasValue(state.session.document, member) ? numberOf(value) : kNone};
    uint64_t gesture = 0;
    if (numbersField(state, member, numbers, gesture) >= 0)
        set(state, member, limited(member, numbers[0]), gesture);
}

void rangeField(PanelState& state, const Member& member, const Json& value)
{
    const bool isRange = value.is_object();
    std::array<double, 2> ends{isRange ? numberOf(value.value("min", Json(0))) : numberOf(value),
                               isRange ? numberOf(value.value("max", Json(0))) : numberOf(value)};
    if (!hasValue(state.session.document, member))
        ends = {kNone, kNone};
    uint64_t gesture = 0;
    const int changed = numbersField(state, member, ends, gesture);
    if (changed < 0)
        return;
    if (!(ends[0] <= ends[1])) // also where the other one is none
        ends[size_t(1 - changed)] = ends[size_t(changed)];
    const Json low = limited(member, ends[0]);
    const Json high = limited(member, ends[1]);
    set(state, member, low == high ? low : Json{{"min", low}, {"max", high}}, gesture);
}

void vectorField(PanelState& state, const Member& member, const Json& value)
{
    std::array<double, 3> axes{};
    for (size_t i = 0; i < 3; ++i)
        axes[i] = value.is_array() && i < value.size() ? numberOf(value[i]) : numberOf(value);
    const std::array<double, 3> start = axes;
    if (!hasValue(state.session.document, member))
        axes = {kNone, kNone, kNone};
    uint64_t gesture = 0;
    if (numbersField(state, member, axes, gesture) < 0)
        return;
    for (size_t i = 0; i < 3; ++i)
        axes[i] = std::isnan(axes[i]) ? start[i] : axes[i];
    Json array = Json::array();
    for (const double axis : axes)
        array.push_back(limited(member, axis));
    const bool isOneNumber =
        member.kind == MemberKind::Extent && !value.is_array() && axes[0] == axes[1] && axes[1] == axes[2];
    set(state, member, isOneNumber ? array[0] : array, gesture);
}

/// A small picture of the curve, which opens the curve editor.
void curveField(PanelState& state, const Member& member, const Json& value)
{
    const Json keys = keysOf(value);
    const bool isColor = keys[0][1].is_array();
    constexpr int kSamples = 32;
    std::array<float, kSamples> samples{};
    for (int i = 0; i < kSamples; ++i)
        samples[size_t(i)] = float(curveAt(keys, double(i) / (kSamples - 1)));
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 size(width, ImGui::GetFrameHeight());
    const ImVec2 low = ImGui::GetCursorScreenPos();
    if (ImGui::Button(("##" + member.pointer).c_str(), size)) {
        if (!member.isPresent)
            set(state, member, value);
        state.session.curve = member.pointer;
        state.keys.clear();
    }
    state.mark(member.pointer);
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    const float most = std::max(*std::max_element(samples.begin(), samples.end()), 1e-6f);
    for (int i = 0; i + 1 < kSamples; ++i) {
        const float x0 = low.x + size.x * float(i) / (kSamples - 1);
        const float x1 = low.x + size.x * float(i + 1) / (kSamples - 1);
        if (isColor) {
            float color[3];
            for (size_t c = 0; c < 3; ++c)
                color[c] = std::clamp(float(curveAt(keys, double(i) / (kSamples - 1), c)), 0.0f, 1.0f);
            draw->AddRectFilled({x0, low.y + 2}, {x1 + 1, low.y + size.y - 2},
                                ImGui::GetColorU32({color[0], color[1], color[2], 1.0f}));
            continue;
        }
        const auto y = [&](int k) {
            return low.y + size.y - 3 - (size.y - 6) * std::max(samples[size_t(k)], 0.0f) / most;
        };
        draw->AddLine({x0, y(i)}, {x1, y(i + 1)}, IM_COL32(255, 196, 92, 255), 1.5f);
    }
}

/// What has no widget of its own is typed as JSON.
void jsonField(PanelState& state, const Member& member, const Json& value)
{
    const auto text = typedText(state, member, value.dump());
    if (!text)
        return;
    Json typed = Json::parse(*text, nullptr, false);
    const base::Status status = typed.is_discarded()
                                    ? base::Status(base::Code::Parse, member.pointer + ": this is not JSON")
                                    : check(member, typed);
    if (status.ok())
        set(state, member, std::move(typed));
    else
        state.session.run(status);
}

} // namespace

void memberField(PanelState& state, const Member& member)
{
    const Json value = valueOf(state.session.document, member);
    switch (member.kind) {
    case MemberKind::Boolean:
        return booleanField(state, member, value);
    case MemberKind::Choice:
        return choiceField(state, member, value);
    case MemberKind::Text:
        return textField(state, member, value);
    case MemberKind::Number:
    case MemberKind::Integer:
        return plainNumberField(state, member, value);
    case MemberKind::Range:
        return rangeField(state, member, value);
    case MemberKind::Vector:
    case MemberKind::Extent:
    case MemberKind::Color:
        return vectorField(state, member, value);
    case MemberKind::Curve:
    case MemberKind::ColorCurve:
        return isCurve(value) ? curveField(state, member, value) : jsonField(state, member, value);
    default:
        return jsonField(state, member, value);
    }
}

} // namespace fx::editor
