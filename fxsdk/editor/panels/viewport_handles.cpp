#include "fxsdk/editor/panels/curve_keys.h"
#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/editor/session/shape_handles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace fx::editor {

namespace {

constexpr float kGrab = 9.0f;  // [pixel]
constexpr float kDial = 34.0f; // [pixel] radius of the dial of the sun
constexpr ImU32 kWire = IM_COL32(255, 170, 80, 210);
constexpr ImU32 kField = IM_COL32(200, 140, 255, 210);

/// A place on the screen that can be dragged.
struct ScreenHandle
{
    std::string name;
    ImVec2 place;
};

ImVec2 toScreen(const glm::dvec2& p)
{
    return {float(p.x), float(p.y)};
}

/// Middle of the dial: the upper right corner of the picture.
ImVec2 dialOf(ImVec2 low, ImVec2 high)
{
    return {high.x - kDial - 12.0f, low.y + kDial + 12.0f};
}

/// The dial shows the sky from above: the zenith in the middle, the horizon at the rim, the way of view
/// upwards.
ImVec2 sunOnDial(const glm::dvec3& sun, const ViewProjection& view, ImVec2 middle)
{
    const double turn = std::atan2(view.forward().x, view.forward().z) - std::atan2(sun.x, sun.z);
    const double away = double(kDial) * std::min(std::acos(std::clamp(sun.y, -1.0, 1.0)) / 1.5707963, 1.25);
    return {middle.x + float(away * std::sin(turn)), middle.y - float(away * std::cos(turn))};
}

glm::dvec3 sunFromDial(ImVec2 place, const ViewProjection& view, ImVec2 middle)
{
    const double x = double(place.x - middle.x), y = double(middle.y - place.y);
    const double away = std::min(std::sqrt(x * x + y * y) / double(kDial), 1.25);
    const double heading = std::atan2(view.forward().x, view.forward().z) - std::atan2(x, y);
    return directionOf(glm::degrees(heading), 90.0 - 90.0 * away);
}

/// A bar under the dial, on which the strength of a light is dragged: a decade on each equal part of its
/// height, and nothing at its lower end.
struct LightBar
{
    static constexpr double kFirst = -2.0, kLast = 5.0;     // decades
    static constexpr float kLength = 110.0f, kWidth = 8.0f; // [pixel]
    static constexpr float kShortest = 40.0f;               // [pixel] below, no bar is shown

    ImVec2 top;
    float length = 0.0f;

    LightBar(ImVec2 low, ImVec2 high, float side)
    {
        const ImVec2 dial = dialOf(low, high);
        top = {dial.x + side * 0.5f * kDial, dial.y + kDial + 14.0f};
        length = std::min(kLength, high.y - 12.0f - top.y);
    }
    bool isShown() const { return length >= kShortest; }
    ImVec2 at(double value) const
    {
        const double decade = value > 0.0 ? std::log10(value) : kFirst;
        const double share = std::clamp((decade - kFirst) / (kLast - kFirst), 0.0, 1.0);
        return {top.x, top.y + length * float(1.0 - share)};
    }
    /// Three digits are enough for a drag.
    double valueAt(float y) const
    {
        const double share = std::clamp(1.0 - double((y - top.y) / length), 0.0, 1.0);
        if (share <= 0.0)
            return 0.0;
        const double decade = kFirst + share * (kLast - kFirst);
        const double unit = std::pow(10.0, 2.0 - std::floor(decade));
        return std::round(std::pow(10.0, decade) * unit) / unit;
    }
};

/// Color of a light on the display, without its strength.
ImU32 colorOf(const glm::dvec3& light)
{
    const double most = std::max({light.x, light.y, light.z, 1e-9});
    const auto channel = [&](double value) { return toDisplay(float(value / most)); };
    return ImGui::GetColorU32({channel(light.x), channel(light.y), channel(light.z), 1.0f});
}

StageLightValues shownLight(const Session& session)
{
    return lightOf(onStage(session.document.json(), session.document.kind(), session.stage()),
                   session.document.kind());
}

class Handles
{
public:
    Handles(PanelState& state, const ViewProjection& view, ImVec2 low, ImVec2 high)
        : state_(state), session_(state.session), view_(view), low_(low), high_(high),
          sun_(shownLight(state.session)), skyBar_(low, high, -1.0f), sunBar_(low, high, 1.0f)
    {
        if (session_.document.kind() == DocumentKind::Preset)
            placement_ = state.picture.placement;
        if (!session_.overlays.shapes)
            return;
        wires_ = shapeWires(session_.document, elementOf(session_.document, session_.selection));
        for (size_t i = 0; i < wires_.handles.size(); ++i)
            if (const auto place = view_.project(placement_.toWorld(wires_.handles[i].place)))
                add(nameOf(wires_.handles[i]), toScreen(*place));
        add("handle/sun", sunOnDial(sun_.sunDirection, view_, dialOf(low_, high_)));
        if (!skyBar_.isShown())
            return;
        add("handle/sky", skyBar_.at(sun_.skyLuminance));
        add("handle/sunlight", sunBar_.at(sun_.sunIlluminance));
    }

    void take()
    {
        if (session_.comparison.isShown)
            add("handle/split", {splitX(), 0.5f * (low_.y + high_.y)});
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (ImGui::IsItemActivated() && ImGui::IsMouseDown(0) && !ImGui::GetIO().KeyShift)
            grab(mouse);
        constexpr float kStill = 4.0f; // [pixel2]
        if (ImGui::IsItemDeactivated() && state_.heldHandle == "handle/sky" &&
            ImGui::GetIO().MouseDragMaxDistanceSqr[0] < kStill)
            ImGui::OpenPopup("sky popup");
        if (!ImGui::IsItemActive())
            state_.heldHandle.clear();
        else if (!state_.heldHandle.empty())
            move({mouse.x + state_.heldOffset.x, mouse.y + state_.heldOffset.y});
    }

    void draw()
    {
        ImDrawList* const draw = ImGui::GetWindowDrawList();
        for (const auto& [from, to] : wires_.lines)
            if (const auto ends = view_.project(placement_.toWorld(from), placement_.toWorld(to)))
                draw->AddLine(toScreen(ends->first), toScreen(ends->second), kWire, 1.5f);
        for (const ScreenHandle& handle : screen_) {
            const bool isHeld = handle.name == state_.heldHandle;
            const bool isField = handle.name.find("/forces/") != std::string::npos;
            if (handle.name == "handle/sun")
                dial(draw, handle.place, isHeld);
            else if (handle.name == "handle/sky")
                bar(draw, skyBar_, handle.place, colorOf(sun_.sky), "sky", isHeld,
                    numberText(sun_.skyLuminance) + " cd/m2");
            else if (handle.name == "handle/sunlight")
                bar(draw, sunBar_, handle.place, IM_COL32(255, 226, 120, 255), "sun", isHeld,
                    numberText(sun_.sunIlluminance) + " lx");
            else if (handle.name == "handle/split")
                split(draw, isHeld);
            else {
                draw->AddCircleFilled(handle.place, isHeld ? 7.0f : 5.0f, isField ? kField : kWire);
                draw->AddCircle(handle.place, isHeld ? 7.0f : 5.0f, IM_COL32(20, 20, 20, 255), 0, 1.5f);
            }
        }
    }

private:
    static std::string nameOf(const ShapeHandle& handle)
    {
        const char* const axes[] = {"/x", "/y", "/z"};
        return "handle" + handle.pointer + (handle.kind == HandleKind::Extent ? axes[handle.component] : "");
    }

    float splitX() const { return low_.x + float(session_.comparison.split) * (high_.x - low_.x); }

    void add(std::string name, ImVec2 place)
    {
        Place& mark = state_.places[name];
        mark = {{place.x - 4.0f, place.y - 4.0f}, {place.x + 4.0f, place.y + 4.0f}, true};
        mark.isVisible = place.x > low_.x && place.x < high_.x && place.y > low_.y && place.y < high_.y;
        screen_.push_back({std::move(name), place});
    }

    /// Takes the nearest handle; of those at one place the last, which is the most special one.
    void grab(ImVec2 mouse)
    {
        float nearest = kGrab * kGrab;
        for (const ScreenHandle& handle : screen_) {
            const ImVec2 way(handle.place.x - mouse.x, handle.place.y - mouse.y);
            const float away = handle.name == "handle/split" ? way.x * way.x : way.x * way.x + way.y * way.y;
            if (away > nearest)
                continue;
            nearest = away;
            state_.heldHandle = handle.name;
            state_.heldOffset = way;
        }
        if (!state_.heldHandle.empty())
            ++state_.gesture;
        movesFrom_ = true;
    }

    void move(ImVec2 to)
    {
        const ImVec2 delta = ImGui::GetIO().MouseDelta;
        if (movesFrom_ || (delta.x == 0.0f && delta.y == 0.0f))
            return; // a click alone edits nothing
        if (state_.heldHandle == "handle/split") {
            session_.comparison.split = std::clamp(double((to.x - low_.x) / (high_.x - low_.x)), 0.02, 0.98);
        } else if (state_.heldHandle == "handle/sun") {
            StageChoice choice = session_.stage();
            choice.sunDirection = sunFromDial(to, view_, dialOf(low_, high_));
            session_.setStage(std::move(choice));
        } else if (state_.heldHandle == "handle/sky" || state_.heldHandle == "handle/sunlight") {
            StageChoice choice = session_.stage();
            const bool isSky = state_.heldHandle == "handle/sky";
            (isSky ? choice.skyLuminance : choice.sunIlluminance) = (isSky ? skyBar_ : sunBar_).valueAt(to.y);
            session_.setStage(std::move(choice));
        } else {
            for (const ShapeHandle& handle : wires_.handles)
                if (nameOf(handle) == state_.heldHandle)
                    return edit(handle, {double(to.x), double(to.y)});
        }
    }

    void edit(const ShapeHandle& handle, const glm::dvec2& to)
    {
        const glm::dvec3 center = placement_.toWorld(handle.center);
        glm::dvec3 place = view_.inPlaneOf(placement_.toWorld(handle.place), to);
        if (handle.kind == HandleKind::Length || handle.kind == HandleKind::Extent) {
            const glm::dvec3 along = placement_.rotation * handle.along;
            const auto way = view_.alongLine(center, along, to);
            if (!way)
                return; // the line is seen end on
            place = center + *way * along;
        }
        const Json value = valueAt(session_.document, handle, placement_.toEffect(place));
        session_.run(session_.document.set(handle.pointer, value, state_.gesture));
    }

    void dial(ImDrawList* draw, ImVec2 sun, bool isHeld) const
    {
        const ImVec2 middle = dialOf(low_, high_);
        draw->AddCircleFilled(middle, kDial, IM_COL32(20, 26, 38, 150), 40);
        draw->AddCircle(middle, kDial, IM_COL32(255, 255, 255, 140), 40, 1.2f);
        draw->AddCircle(middle, 0.5f * kDial, IM_COL32(255, 255, 255, 50), 32);
        draw->AddLine({middle.x, middle.y - kDial - 4.0f}, {middle.x, middle.y - kDial + 4.0f},
                      IM_COL32(255, 255, 255, 200), 2.0f);
        draw->AddCircleFilled(sun, isHeld ? 7.0f : 5.5f, IM_COL32(255, 226, 120, 255));
        draw->AddCircle(sun, isHeld ? 7.0f : 5.5f, IM_COL32(60, 40, 0, 255), 0, 1.2f);
    }

    /// @param text the strength, which is shown while it is dragged
    void bar(ImDrawList* draw, const LightBar& of, ImVec2 handle, ImU32 color, const char* label, bool isHeld,
             const std::string& text) const
    {
        const float half = 0.5f * LightBar::kWidth;
        const ImVec2 low(of.top.x - half, of.top.y), high(of.top.x + half, of.top.y + of.length);
        draw->AddRectFilled(low, high, IM_COL32(20, 26, 38, 150), half);
        draw->AddRectFilled({low.x, handle.y}, high, (color & 0x00FFFFFFu) | 0x90000000u, half);
        draw->AddRect(low, high, IM_COL32(255, 255, 255, 110), half);
        draw->AddCircleFilled(handle, isHeld ? 7.0f : 5.5f, color);
        draw->AddCircle(handle, isHeld ? 7.0f : 5.5f, IM_COL32(30, 30, 30, 255), 0, 1.2f);
        const std::string& shown = isHeld ? text : std::string(label);
        const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
        const float x = isHeld ? low.x - size.x - 10.0f : of.top.x - 0.5f * size.x;
        draw->AddText({x, isHeld ? handle.y - 0.5f * size.y : high.y + 2.0f}, IM_COL32(255, 255, 255, 220),
                      shown.c_str());
    }

    void split(ImDrawList* draw, bool isHeld) const
    {
        const float x = splitX();
        draw->AddLine({x, low_.y}, {x, high_.y}, IM_COL32(255, 255, 255, isHeld ? 255 : 190), 2.0f);
        const float y = 0.5f * (low_.y + high_.y);
        draw->AddTriangleFilled({x - 11, y}, {x - 4, y - 6}, {x - 4, y + 6}, IM_COL32_WHITE);
        draw->AddTriangleFilled({x + 11, y}, {x + 4, y + 6}, {x + 4, y - 6}, IM_COL32_WHITE);
        draw->AddText({x - ImGui::CalcTextSize("before").x - 10, high_.y - 24}, IM_COL32_WHITE, "before");
        draw->AddText({x + 10, high_.y - 24}, IM_COL32_WHITE, "now");
    }

    PanelState& state_;
    Session& session_;
    const ViewProjection& view_;
    ImVec2 low_, high_;
    StageLightValues sun_;
    LightBar skyBar_, sunBar_;
    EffectPlacement placement_;
    ShapeWires wires_;
    std::vector<ScreenHandle> screen_;
    bool movesFrom_ = false;
};

/// Numbers and color of the sky, which a click on its handle opens.
void skyPopup(PanelState& state)
{
    if (!ImGui::BeginPopup("sky popup"))
        return;
    if (isKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
    Session& session = state.session;
    StageChoice choice = session.stage();
    skyFields(state, "sky", choice);
    session.setStage(std::move(choice));
    if (button(state, "keep in the document", "sky/keep"))
        session.keepStage();
    ImGui::EndPopup();
}

} // namespace

bool viewportHandles(PanelState& state, const ViewProjection& view, ImVec2 low, ImVec2 high)
{
    Handles handles(state, view, low, high);
    handles.take();
    ImGui::GetWindowDrawList()->PushClipRect(low, high, true);
    handles.draw();
    ImGui::GetWindowDrawList()->PopClipRect();
    skyPopup(state);
    return !state.heldHandle.empty();
}

} // namespace fx::editor
