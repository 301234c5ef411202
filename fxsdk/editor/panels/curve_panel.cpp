#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/panels/curve_keys.h"
#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>

namespace fx::editor {

namespace {

constexpr float kKeyRadius = 6.0f; // [pixel]

/// Where the canvas is and what it shows.
struct Canvas
{
    ImVec2 low;
    ImVec2 size;
    double lowest;  ///< value at the lower edge
    double highest; ///< value at the upper edge

    ImVec2 at(double t, double value) const
    {
        return {low.x + size.x * float(t),
                low.y + size.y * (1.0f - float((value - lowest) / (highest - lowest)))};
    }
};

void commit(PanelState& state, const Member& member, Json keys, uint64_t gesture = 0)
{
    state.session.run(state.session.document.set(
        member.pointer, curveOf(valueOf(state.session.document, member), std::move(keys)), gesture));
}

bool isSelected(const PanelState& state, size_t key)
{
    return std::find(state.keys.begin(), state.keys.end(), key) != state.keys.end();
}

/// Index of the key under the mouse; the number of keys if there is none.
size_t keyAt(const Canvas& canvas, const Json& keys, bool isColor, ImVec2 mouse)
{
    for (size_t i = 0; i < keys.size(); ++i) {
        const double value = isColor ? 0.0 : keys[i][1].get<double>();
        const ImVec2 at = canvas.at(keys[i][0].get<double>(), isColor ? canvas.lowest : value);
        if (std::hypot(at.x - mouse.x, at.y - mouse.y) <= 1.6f * kKeyRadius)
            return i;
    }
    return keys.size();
}

void drawCurve(const Canvas& canvas, const Json& keys)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    for (int i = 0; i <= 4; ++i) {
        const double value = canvas.lowest + (canvas.highest - canvas.lowest) * i / 4.0;
        char label[24];
        std::snprintf(label, sizeof label, "%.3g", value);
        const ImVec2 left = canvas.at(0.0, value);
        draw->AddLine(left, canvas.at(1.0, value), IM_COL32(255, 255, 255, 24));
        const float line = ImGui::GetFontSize();
        if (i == 0 || i == 4 ||
            canvas.size.y > 8.0f * line) // labels of a low curve would lie over each other
            draw->AddText({left.x + 4, left.y - (i == 0 ? line + 2.0f : 0.0f)}, IM_COL32(160, 165, 175, 255),
                          label);
        draw->AddLine(canvas.at(i / 4.0, canvas.lowest), canvas.at(i / 4.0, canvas.highest),
                      IM_COL32(255, 255, 255, 24));
    }
    constexpr int kSegments = 128;
    for (int i = 0; i < kSegments; ++i) {
        const double t0 = double(i) / kSegments;
        const double t1 = double(i + 1) / kSegments;
        draw->AddLine(canvas.at(t0, curveAt(keys, t0)), canvas.at(t1, curveAt(keys, t1)),
                      IM_COL32(255, 196, 92, 255), 2.0f);
    }
}

/// Display color of a linear one, scaled so that no channel exceeds 1.
ImU32 displayColor(const Json& keys, double t)
{
    float color[3];
    float most = 1.0f;
    for (size_t c = 0; c < 3; ++c) {
        color[c] = std::max(float(curveAt(keys, t, c)), 0.0f);
        most = std::max(most, color[c]);
    }
    for (float& channel : color)
        channel = std::pow(channel / most, 1.0f / 2.2f);
    return ImGui::GetColorU32({color[0], color[1], color[2], 1.0f});
}

void drawGradient(const Canvas& canvas, const Json& keys)
{
    constexpr int kSegments = 96;
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    for (int i = 0; i < kSegments; ++i)
        draw->AddRectFilled(canvas.at(double(i) / kSegments, canvas.highest),
                            canvas.at(double(i + 1) / kSegments, canvas.lowest),
                            displayColor(keys, (i + 0.5) / kSegments));
}

void drawKeys(PanelState& state, const Canvas& canvas, const Json& keys, bool isColor)
{
    for (size_t i = 0; i < keys.size(); ++i) {
        const double t = keys[i][0].get<double>();
        const ImVec2 at = canvas.at(t, isColor ? canvas.lowest : keys[i][1].get<double>());
        ImDrawList* const draw = ImGui::GetWindowDrawList();
        draw->AddCircleFilled(at, kKeyRadius, isColor ? displayColor(keys, t) : IM_COL32(40, 44, 52, 255));
        draw->AddCircle(at, kKeyRadius,
                        isSelected(state, i) ? IM_COL32(255, 255, 255, 255) : IM_COL32(255, 196, 92, 255), 0,
                        2.0f);
        state.places["curve/key/" + std::to_string(i)] = {{at.x - kKeyRadius, at.y - kKeyRadius},
                                                          {at.x + kKeyRadius, at.y + kKeyRadius}};
    }
}

/// Clicks and drags on the canvas.
void editCanvas(PanelState& state, const Canvas& canvas, const Member& member, Json keys, bool isColor)
{
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const size_t hit = keyAt(canvas, keys, isColor, mouse);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0) && hit == keys.size()) {
        state.keys = {addKey(keys, (mouse.x - canvas.low.x) / canvas.size.x)};
        return commit(state, member, std::move(keys));
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(1) && hit < keys.size()) {
        removeKeys(keys, {hit});
        state.keys.clear();
        return commit(state, member, std::move(keys));
    }
    if (ImGui::IsItemActivated()) {
        ++state.gesture;
        state.draggedKeys = keys;
        state.draggedFrom = mouse;
        if (hit == keys.size())
            state.keys.clear();
        else if (!isSelected(state, hit)) {
            if (!ImGui::GetIO().KeyShift)
                state.keys.clear();
            state.keys.push_back(hit);
        }
        state.grabbedKey = hit;
        return; // a click that moves nothing is no edit
    }
    const ImVec2 moved = ImGui::GetIO().MouseDelta;
    if (!ImGui::IsItemActive() || state.keys.empty() || (moved.x == 0.0f && moved.y == 0.0f) ||
        state.draggedKeys.size() != keys.size())
        return;
    KeyMove move;
    move.time = double((mouse.x - state.draggedFrom.x) / canvas.size.x);
    move.value = -double((mouse.y - state.draggedFrom.y) / canvas.size.y) * (canvas.highest - canvas.lowest);
    if (ImGui::GetIO().KeyCtrl)
        move = snapped(state.draggedKeys[std::min(state.grabbedKey, state.draggedKeys.size() - 1)], move,
                       canvas.highest - canvas.lowest);
    keys = state.draggedKeys; // the way from the beginning of the drag, so that limits do not add up
    moveKeys(keys, state.keys, move.time, move.value, member.minimum.value_or(-1e9),
             member.maximum.value_or(1e9));
    commit(state, member, std::move(keys), state.gesture);
}

/// The selected color, as three numbers, as one for all three, and as it is displayed.
void colorFields(PanelState& state, const Member& member, Json keys)
{
    Json& key = keys[state.keys[0]];
    float color[3];
    for (size_t c = 0; c < 3; ++c)
        color[c] = key[1][c].get<float>();
    Member part = member;
    part.kind = MemberKind::Number;
    const float width = ImGui::GetFontSize() * 4.2f;
    std::optional<NumberEdit> edit;
    const auto field = [&](const std::string& name, double value, size_t from, size_t to) {
        if (const auto changed = numberField(state, name, value, part, width)) {
            edit = changed;
            for (size_t c = from; c < to; ++c)
                color[c] = float(limited(part, changed->value).get<double>());
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
    commit(state, member, std::move(keys), edit->gesture);
}

/// Time and value of the selected key as numbers.
void keyFields(PanelState& state, const Member& member, Json keys, bool isColor)
{
    if (state.keys.size() != 1 || state.keys[0] >= keys.size()) {
        ImGui::TextDisabled(
            "click: select  shift: several  drag: move  ctrl: snap  double click: add  right click: remove");
        return;
    }
    Json& key = keys[state.keys[0]];
    Member time;
    time.minimum = 0.0;
    time.maximum = 1.0;
    time.kind = MemberKind::Number;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("t");
    ImGui::SameLine();
    const float width = ImGui::GetFontSize() * 7.0f;
    if (const auto edit = numberField(state, "curve/t", key[0].get<double>(), time, width)) {
        Json moved = keys;
        moveKeys(moved, state.keys, edit->value - key[0].get<double>(), 0.0, -1e30, 1e30);
        return commit(state, member, std::move(moved), edit->gesture);
    }
    ImGui::SameLine();
    if (!isColor) {
        ImGui::TextUnformatted("value");
        ImGui::SameLine();
        Member value = member;
        value.kind = MemberKind::Number;
        if (const auto edit = numberField(state, "curve/value", key[1].get<double>(), value, width)) {
            key[1] = limited(value, edit->value);
            commit(state, member, std::move(keys), edit->gesture);
        }
        return;
    }
    colorFields(state, member, std::move(keys));
}

void presetButtons(PanelState& state, const Member& member, const Json& keys, bool isColor)
{
    if (isColor) {
        if (button(state, "temperature ramp", "curve/ramp"))
            commit(state, member, temperatureRamp(1000.0, 3000.0, 5));
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Colors of a black body from 1000 K to 3000 K");
        return;
    }
    double high = 0.0;
    for (const Json& key : keys)
        high = std::max(high, key[1].get<double>());
    bool isFirst = true;
    for (const std::string& name : curvePresetNames()) {
        if (!isFirst)
            sameLineIfItFits(name.c_str());
        isFirst = false;
        if (button(state, name.c_str(), "curve/" + name)) {
            state.keys.clear();
            commit(state, member, curvePreset(name, member.minimum.value_or(0.0), high > 0.0 ? high : 1.0));
        }
    }
}

} // namespace

void curvePanel(PanelState& state)
{
    Session& session = state.session;
    const auto member = session.curve.empty() ? std::nullopt : memberAt(session.document, session.curve);
    if (!member || (member->kind != MemberKind::Curve && member->kind != MemberKind::ColorCurve)) {
        ImGui::TextDisabled("Click the picture of a curve or gradient in the inspector.");
        return;
    }
    const Json curve = valueOf(session.document, *member);
    if (!isCurve(curve)) {
        ImGui::TextDisabled("These are no keys [time, value]; mend them in the inspector.");
        return;
    }
    const Json keys = keysOf(curve);
    const bool isColor = member->kind == MemberKind::ColorCurve;
    std::erase_if(state.keys, [&](size_t key) { return key >= keys.size(); });
    ImGui::Text("%s%s%s", member->title.c_str(), member->unit.empty() ? "" : "  ", member->unit.c_str());
    ImGui::SameLine(0.0f, 24.0f);
    presetButtons(state, *member, keys, isColor);
    keyFields(state, *member, keys, isColor);

    double highest = 1e-6;
    double lowest = 0.0;
    if (!isColor)
        for (const Json& key : keys) {
            highest = std::max(highest, key[1].get<double>());
            lowest = std::min(lowest, key[1].get<double>());
        }
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(room.x, 50.0f), std::max(room.y, 40.0f));
    Canvas canvas{{low.x + 10, low.y + 8}, {size.x - 20, size.y - 18}, lowest, isColor ? 1.0 : highest * 1.1};
    if (!ImGui::IsMouseDown(0))
        state.curveHighest = canvas.highest;
    else if (state.curveHighest > canvas.lowest)
        canvas.highest = state.curveHighest; // the scale holds during a drag
    ImGui::InvisibleButton("canvas", size);
    state.mark("curve/canvas");
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y},
                                              IM_COL32(24, 27, 33, 255));
    if (isColor)
        drawGradient(canvas, keys);
    else
        drawCurve(canvas, keys);
    drawKeys(state, canvas, keys, isColor);
    editCanvas(state, canvas, *member, keys, isColor);
}

} // namespace fx::editor
