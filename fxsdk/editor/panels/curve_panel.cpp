#include "fxsdk/editor/panels/curve_view.h"
#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <tuple>

namespace fx::editor {

namespace {

constexpr float kKeyRadius = 6.0f;                         // [pixel]
constexpr ImU32 kFirstColor = IM_COL32(255, 196, 92, 255); // of the curve that was clicked
constexpr ImU32 kBackground = IM_COL32(24, 27, 33, 255);

/// Where the canvas is.
struct Canvas
{
    ImVec2 low;
    ImVec2 size;

    ImVec2 at(double t, double share) const
    {
        return {low.x + size.x * float(t), low.y + size.y * (1.0f - float(share))};
    }
    ImVec2 of(const ShownCurve& curve, double t, double value) const
    {
        return at(t, (value - curve.lowest) / (curve.highest - curve.lowest));
    }
    /// Keys of a gradient are at the lower edge.
    ImVec2 ofKey(const ShownCurve& curve, size_t index) const
    {
        const Json& key = curve.keys[index];
        return curve.isColor() ? at(key[0].get<double>(), 0.0)
                               : of(curve, key[0].get<double>(), key[1].get<double>());
    }
};

bool isSelected(const PanelState& state, const SelectedKey& key)
{
    return std::find(state.keys.begin(), state.keys.end(), key) != state.keys.end();
}

/// The key under the mouse.
std::optional<SelectedKey> keyAt(const Canvas& canvas, const std::vector<CurveView>& views, ImVec2 mouse)
{
    for (const CurveView& view : views)
        for (size_t i = 0; i < view.curve.keys.size(); ++i) {
            const ImVec2 at = canvas.ofKey(view.curve, i);
            if (std::hypot(at.x - mouse.x, at.y - mouse.y) <= 1.6f * kKeyRadius)
                return SelectedKey{view.curve.pointer, i};
        }
    return std::nullopt;
}

/// Lines of the scale, with the values of the first curve.
void drawScale(const Canvas& canvas, const ShownCurve& curve)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    for (int i = 0; i <= 4; ++i) {
        char label[24];
        std::snprintf(label, sizeof label, "%.3g", curve.lowest + (curve.highest - curve.lowest) * i / 4.0);
        const ImVec2 left = canvas.at(0.0, i / 4.0);
        draw->AddLine(left, canvas.at(1.0, i / 4.0), IM_COL32(255, 255, 255, 24));
        const float line = ImGui::GetFontSize();
        if (i == 0 || i == 4 ||
            canvas.size.y > 8.0f * line) // labels of a low curve would lie over each other
            draw->AddText({left.x + 4, left.y - (i == 0 ? line + 2.0f : 0.0f)}, IM_COL32(160, 165, 175, 255),
                          label);
        draw->AddLine(canvas.at(i / 4.0, 0.0), canvas.at(i / 4.0, 1.0), IM_COL32(255, 255, 255, 24));
    }
}

void drawCurve(const Canvas& canvas, const CurveView& view)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    constexpr int kSegments = 128;
    for (int i = 0; i < kSegments; ++i) {
        const double t0 = double(i) / kSegments;
        const double t1 = double(i + 1) / kSegments;
        draw->AddLine(canvas.of(view.curve, t0, curveAt(view.curve.keys, t0)),
                      canvas.of(view.curve, t1, curveAt(view.curve.keys, t1)), view.color, 2.0f);
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
        draw->AddRectFilled(canvas.at(double(i) / kSegments, 1.0), canvas.at(double(i + 1) / kSegments, 0.0),
                            displayColor(keys, (i + 0.5) / kSegments));
}

/// @param prefix of the places of the keys
void drawKeys(PanelState& state, const Canvas& canvas, const CurveView& view, const std::string& prefix)
{
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    for (size_t i = 0; i < view.curve.keys.size(); ++i) {
        const ImVec2 at = canvas.ofKey(view.curve, i);
        const ImU32 inner = view.curve.isColor()
                                ? displayColor(view.curve.keys, view.curve.keys[i][0].get<double>())
                                : IM_COL32(40, 44, 52, 255);
        const bool isChosen = isSelected(state, {view.curve.pointer, i});
        draw->AddCircleFilled(at, kKeyRadius, isChosen ? view.color : inner);
        draw->AddCircle(at, kKeyRadius, isChosen ? IM_COL32_WHITE : view.color, 0, 2.0f);
        state.places[prefix + std::to_string(i)] = {{at.x - kKeyRadius, at.y - kKeyRadius},
                                                    {at.x + kKeyRadius, at.y + kKeyRadius}};
    }
}

/// Adds a key to the curve that is nearest to the mouse.
void addAt(PanelState& state, const Canvas& canvas, const std::vector<CurveView>& views, ImVec2 mouse)
{
    const double t = std::clamp(double((mouse.x - canvas.low.x) / canvas.size.x), 0.0, 1.0);
    const auto away = [&](const CurveView& view) {
        return view.curve.isColor()
                   ? 0.0f
                   : std::abs(canvas.of(view.curve, t, curveAt(view.curve.keys, t)).y - mouse.y);
    };
    const auto nearest = std::min_element(views.begin(), views.end(),
                                          [&](const auto& a, const auto& b) { return away(a) < away(b); });
    std::vector<ShownCurve> changed{nearest->curve};
    state.keys = {{nearest->curve.pointer, addKey(changed[0].keys, t)}};
    commitCurves(state, changed, 0);
}

void remove(PanelState& state, const std::vector<CurveView>& views, const std::vector<SelectedKey>& keys)
{
    std::vector<ShownCurve> changed = curvesOf(views);
    removeTogether(changed, keys);
    state.keys.clear();
    commitCurves(state, changed, 0);
}

/// The mouse goes down: on a key, or beside all of them, where a rectangle begins that selects.
void begin(PanelState& state, const std::vector<CurveView>& views, const std::optional<SelectedKey>& hit)
{
    const bool adds = ImGui::GetIO().KeyShift;
    ++state.gesture;
    state.draggedCurves = curvesOf(views);
    state.draggedFrom = ImGui::GetIO().MousePos;
    state.grabbedKey = hit;
    if (hit && adds && isSelected(state, *hit)) {
        std::erase(state.keys, *hit);
        state.grabbedKey.reset();
        state.draggedCurves.clear(); // neither moves nor selects
        return;
    }
    if (!adds && !(hit && isSelected(state, *hit)))
        state.keys.clear();
    if (hit && !isSelected(state, *hit))
        state.keys.push_back(*hit);
    state.keysBefore = state.keys;
}

/// Selects what is in the rectangle from the beginning of the drag to the mouse.
void selectInside(PanelState& state, const Canvas& canvas, const std::vector<CurveView>& views)
{
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const ImVec2 from = state.draggedFrom;
    const ImVec2 low(std::min(from.x, mouse.x), std::min(from.y, mouse.y));
    const ImVec2 high(std::max(from.x, mouse.x), std::max(from.y, mouse.y));
    ImGui::GetWindowDrawList()->AddRectFilled(low, high, IM_COL32(255, 255, 255, 24));
    ImGui::GetWindowDrawList()->AddRect(low, high, IM_COL32(255, 255, 255, 120));
    state.keys = state.keysBefore;
    for (const CurveView& view : views)
        for (size_t i = 0; i < view.curve.keys.size(); ++i) {
            const ImVec2 at = canvas.ofKey(view.curve, i);
            const SelectedKey key{view.curve.pointer, i};
            if (at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y && !isSelected(state, key))
                state.keys.push_back(key);
        }
}

/// Moves the selected keys from where they were when the drag began, so that limits do not add up.
void moveSelected(PanelState& state, const Canvas& canvas)
{
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::vector<ShownCurve> curves = state.draggedCurves;
    double time = double((mouse.x - state.draggedFrom.x) / canvas.size.x);
    double share = -double((mouse.y - state.draggedFrom.y) / canvas.size.y);
    if (ImGui::GetIO().KeyCtrl)
        for (const ShownCurve& curve : curves)
            if (curve.pointer == state.grabbedKey->curve && state.grabbedKey->index < curve.keys.size()) {
                const double range = curve.highest - curve.lowest;
                const KeyMove move =
                    snapped(curve.keys[state.grabbedKey->index], {time, share * range}, range);
                time = move.time;
                share = move.value / range;
            }
    moveTogether(curves, state.keys, time, share);
    commitCurves(state, curves, state.gesture);
}

/// Clicks, drags and keys on the canvas. Call it after its item.
void editCanvas(PanelState& state, const Canvas& canvas, const std::vector<CurveView>& views)
{
    const ImGuiIO& io = ImGui::GetIO();
    const std::optional<SelectedKey> hit = keyAt(canvas, views, io.MousePos);
    if (ImGui::IsItemHovered()) {
        if (ImGui::IsMouseDoubleClicked(0) && !hit)
            return addAt(state, canvas, views, io.MousePos);
        if (ImGui::IsMouseClicked(1) && hit)
            return remove(state, views, {*hit});
    }
    if (ImGui::IsWindowFocused() && isKeyPressed(ImGuiKey_Delete) && !state.keys.empty() && !io.WantTextInput)
        return remove(state, views, state.keys);
    if (ImGui::IsItemActivated())
        return begin(state, views, hit);
    if (!ImGui::IsItemActive() || state.draggedCurves.size() != views.size())
        return;
    for (size_t i = 0; i < views.size(); ++i) // an undo during the drag may have changed them
        if (state.draggedCurves[i].pointer != views[i].curve.pointer ||
            state.draggedCurves[i].keys.size() != views[i].curve.keys.size())
            return;
    if (!state.grabbedKey)
        return selectInside(state, canvas, views);
    if (io.MouseDelta.x != 0.0f || io.MouseDelta.y != 0.0f)
        moveSelected(state, canvas);
}

/// The view of a curve, on a scale from the lowest value, at most 0, to a little above the highest.
CurveView viewOf(PanelState& state, const Member& member, const Json& value, ImU32 color)
{
    CurveView view{member, {member.pointer, keysOf(value)}, color};
    ShownCurve& curve = view.curve;
    curve.least = member.minimum.value_or(curve.least);
    curve.most = member.maximum.value_or(curve.most);
    double highest = 1e-6;
    if (!curve.isColor())
        for (const Json& key : curve.keys) {
            highest = std::max(highest, key[1].get<double>());
            curve.lowest = std::min(curve.lowest, key[1].get<double>());
        }
    curve.highest = curve.isColor() ? 1.0 : 1.1 * highest;
    const auto held = state.curveScales.find(member.pointer);
    if (!ImGui::IsMouseDown(0) || held == state.curveScales.end())
        state.curveScales[member.pointer] = {curve.lowest, curve.highest};
    else // the scale holds during a drag
        std::tie(curve.lowest, curve.highest) = held->second;
    return view;
}

/// Curves of numbers of the object around a member that the document states.
std::vector<Member> curvesAround(const Session& session, const Member& first)
{
    const std::string parent = Json::json_pointer(first.pointer).parent_pointer().to_string();
    std::vector<Member> curves;
    for (const Member& member : membersOf(session.document, parent)) {
        if (member.kind != MemberKind::Curve || !member.isPresent)
            continue;
        const Json value = valueOf(session.document, member);
        if (isCurve(value) && !keysOf(value)[0][1].is_array())
            curves.push_back(member);
    }
    return curves;
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
    std::vector<CurveView> views{viewOf(state, *member, curve, kFirstColor)};
    const bool isColor = views[0].curve.isColor();
    const std::vector<Member> around = isColor ? std::vector<Member>() : curvesAround(session, *member);
    for (size_t i = 0; i < around.size(); ++i)
        if (around[i].pointer != member->pointer && state.shownCurves.contains(around[i].name))
            views.push_back(viewOf(state, around[i], valueOf(session.document, around[i]), curveColor(i)));
    std::erase_if(state.keys, [&](const SelectedKey& key) {
        return std::none_of(views.begin(), views.end(), [&](const CurveView& view) {
            return view.curve.pointer == key.curve && key.index < view.curve.keys.size();
        });
    });
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(kFirstColor), "%s%s%s", member->title.c_str(),
                       member->unit.empty() ? "" : "  ", member->unit.c_str());
    ImGui::SameLine(0.0f, 24.0f);
    curvePresets(state, views);
    curveChoices(state, views, around);
    curveFields(state, views);

    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(room.x, 50.0f), std::max(room.y, 60.0f));
    const Canvas canvas{{low.x + 10, low.y + 8}, {size.x - 20, size.y - 18}};
    ImGui::InvisibleButton("canvas", size);
    state.mark("curve/canvas");
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + size.x, low.y + size.y}, kBackground);
    if (isColor)
        drawGradient(canvas, views[0].curve.keys);
    else
        drawScale(canvas, views[0].curve);
    for (size_t i = views.size(); i-- > 0;) { // the clicked one over the others
        if (!isColor)
            drawCurve(canvas, views[i]);
        drawKeys(state, canvas, views[i], i == 0 ? "curve/key/" : "curve/key/" + views[i].member.name + "/");
    }
    editCanvas(state, canvas, views);
}

} // namespace fx::editor
