#include "fxsdk/editor/panels/curve_view.h"
#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace fx::editor {

namespace {

/// The selected color, as three numbers, as one for all three, and as it is displayed.
void colorFields(PanelState& state, const CurveView& view, size_t index)
{
    std::vector<ShownCurve> changed{view.curve};
    Json& key = changed[0].keys[index];
    float color[3];
    for (size_t c = 0; c < 3; ++c)
        color[c] = key[1][c].get<float>();
    Member part = view.member;
    part.kind = MemberKind::Number;
    const float width = ImGui::GetFontSize() * 4.2f;
    std::optional<NumberEdit> edit;
    const auto field = [&](const std::string& name, double value, size_t from, size_t to) {
        if (const auto typed = numberField(state, name, value, part, width)) {
            edit = typed;
            for (size_t c = from; c < to; ++c)
                color[c] = float(limited(part, typed->value).get<double>());
        }
        ImGui::SameLine(0.0f, 2.0f);
    };
    for (size_t c = 0; c < 3; ++c)
        field("curve/color/" + std::to_string(c), double(color[c]), c, c + 1);
    ImGui::TextUnformatted("linear");
    sameLineIfItFits("all 000000000");
    ImGui::TextUnformatted("all");
    ImGui::SameLine(0.0f, 2.0f);
    const bool isGray = color[0] == color[1] && color[1] == color[2];
    field("curve/color/all", isGray ? double(color[0]) : std::numeric_limits<double>::quiet_NaN(), 0, 3);
    ImGui::NewLine();
    sameLineIfItFits("000000000000000000000 display");
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 13.0f);
    float shown[3] = {toDisplay(color[0]), toDisplay(color[1]), toDisplay(color[2])};
    if (ImGui::ColorEdit3("display", shown, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR)) {
        for (size_t c = 0; c < 3; ++c)
            if (shown[c] != toDisplay(color[c])) // the others would change by their rounding
                color[c] = fromDisplay(shown[c]);
        edit = NumberEdit{0.0, state.dragOf()};
    } else
        (void)state.dragOf();
    state.mark("curve/display color");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("The same color as values of sRGB");
    if (!edit)
        return;
    for (size_t c = 0; c < 3; ++c)
        key[1][c] = std::strtod(numberText(double(color[c])).c_str(), nullptr);
    commitCurves(state, changed, edit->gesture);
}

/// Time and value of one key.
void oneKey(PanelState& state, const CurveView& view, size_t index)
{
    std::vector<ShownCurve> changed{view.curve};
    Json& key = changed[0].keys[index];
    Member time;
    time.minimum = 0.0;
    time.maximum = 1.0;
    time.kind = MemberKind::Number;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("t");
    ImGui::SameLine();
    const float width = ImGui::GetFontSize() * 7.0f;
    if (const auto edit = numberField(state, "curve/t", key[0].get<double>(), time, width)) {
        moveKeys(changed[0].keys, {index}, edit->value - key[0].get<double>(), 0.0, -1e30, 1e30);
        return commitCurves(state, changed, edit->gesture);
    }
    ImGui::SameLine();
    if (view.curve.isColor())
        return colorFields(state, view, index);
    ImGui::TextUnformatted("value");
    ImGui::SameLine();
    Member value = view.member;
    value.kind = MemberKind::Number;
    if (const auto edit = numberField(state, "curve/value", key[1].get<double>(), value, width)) {
        key[1] = limited(value, edit->value);
        commitCurves(state, changed, edit->gesture);
    }
}

/// A way in time and a factor for all selected keys.
void severalKeys(PanelState& state, const std::vector<CurveView>& views)
{
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%zu keys: t +", state.keys.size());
    const float width = ImGui::GetFontSize() * 6.0f;
    Member number;
    number.kind = MemberKind::Number;
    std::vector<ShownCurve> changed = curvesOf(views);
    ImGui::SameLine(0.0f, 2.0f);
    if (const auto edit = numberField(state, "curve/shift", 0.0, number, width)) {
        moveTogether(changed, state.keys, edit->value, 0.0);
        return commitCurves(state, changed, edit->gesture);
    }
    ImGui::SameLine();
    ImGui::TextUnformatted("value x");
    ImGui::SameLine(0.0f, 2.0f);
    if (const auto edit = numberField(state, "curve/scale", 1.0, number, width)) {
        scaleTogether(changed, state.keys, edit->value);
        commitCurves(state, changed, edit->gesture);
    }
}

} // namespace

ImU32 curveColor(size_t place)
{
    constexpr std::array<ImU32, 6> kColors{IM_COL32(120, 190, 255, 255), IM_COL32(140, 230, 140, 255),
                                           IM_COL32(240, 130, 200, 255), IM_COL32(190, 165, 255, 255),
                                           IM_COL32(110, 220, 215, 255), IM_COL32(235, 235, 130, 255)};
    return kColors[place % kColors.size()];
}

std::vector<ShownCurve> curvesOf(const std::vector<CurveView>& views)
{
    std::vector<ShownCurve> curves;
    for (const CurveView& view : views)
        curves.push_back(view.curve);
    return curves;
}

void commitCurves(PanelState& state, const std::vector<ShownCurve>& curves, uint64_t gesture)
{
    state.session.run(setCurves(state.session.document, curves, gesture));
}

void curvePresets(PanelState& state, const std::vector<CurveView>& views)
{
    const Member& member = views[0].member;
    std::vector<ShownCurve> changed{views[0].curve};
    Json& keys = changed[0].keys;
    const auto take = [&](Json preset) {
        keys = std::move(preset);
        state.keys.clear();
        commitCurves(state, changed, 0);
    };
    if (views[0].curve.isColor()) {
        if (button(state, "temperature ramp", "curve/ramp"))
            take(temperatureRamp(1000.0, 3000.0, 5));
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Colors of a black body from 1000 K to 3000 K");
        return;
    }
    double high = 0.0;
    for (const Json& key : views[0].curve.keys)
        high = std::max(high, key[1].get<double>());
    bool isFirst = true;
    for (const std::string& name : curvePresetNames()) {
        if (!isFirst)
            sameLineIfItFits(name.c_str());
        isFirst = false;
        if (button(state, name.c_str(), "curve/" + name))
            take(curvePreset(name, member.minimum.value_or(0.0), high > 0.0 ? high : 1.0));
    }
}

void curveChoices(PanelState& state, const std::vector<CurveView>& views, const std::vector<Member>& all)
{
    if (all.size() < 2)
        return;
    bool isFirst = true;
    for (size_t i = 0; i < all.size(); ++i) {
        const Member& member = all[i];
        if (member.pointer == views[0].member.pointer)
            continue;
        if (!isFirst)
            sameLineIfItFits(member.title.c_str());
        isFirst = false;
        const bool isShown = state.shownCurves.contains(member.name);
        ImGui::PushStyleColor(ImGuiCol_Text,
                              isShown ? curveColor(i) : ImGui::GetColorU32(ImGuiCol_TextDisabled));
        if (button(state, (member.title + "##shown").c_str(), "curve/show/" + member.name)) {
            if (isShown)
                state.shownCurves.erase(member.name);
            else
                state.shownCurves.insert(member.name);
        }
        ImGui::PopStyleColor();
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip(
                "Shows and hides this curve, on a scale of its own; what is hidden is not edited");
    }
}

void curveFields(PanelState& state, const std::vector<CurveView>& views)
{
    if (state.keys.size() > 1)
        return severalKeys(state, views);
    for (const CurveView& view : views)
        if (!state.keys.empty() && state.keys[0].curve == view.curve.pointer)
            return oneKey(state, view, state.keys[0].index);
    ImGui::TextDisabled("drag: move or select  ctrl: snap  double click: add  right click: remove");
}

} // namespace fx::editor
