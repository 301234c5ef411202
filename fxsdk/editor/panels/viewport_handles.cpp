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
          sun_(shownLight(state.session))
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
    }

    void take()
    {
        if (session_.comparison.isShown)
            add("handle/split", {splitX(), 0.5f * (low_.y + high_.y)});
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (ImGui::IsItemActivated() && ImGui::IsMouseDown(0) && !ImGui::GetIO().KeyShift)
            grab(mouse);
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
    EffectPlacement placement_;
    ShapeWires wires_;
    std::vector<ScreenHandle> screen_;
    bool movesFrom_ = false;
};

} // namespace

bool viewportHandles(PanelState& state, const ViewProjection& view, ImVec2 low, ImVec2 high)
{
    Handles handles(state, view, low, high);
    handles.take();
    ImGui::GetWindowDrawList()->PushClipRect(low, high, true);
    handles.draw();
    ImGui::GetWindowDrawList()->PopClipRect();
    return !state.heldHandle.empty();
}

} // namespace fx::editor
