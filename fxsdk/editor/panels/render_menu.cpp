#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace fx::editor {

namespace {

struct Kind
{
    RenderKind kind;
    const char* label;
    const char* name; ///< of its place
    const char* file; ///< proposed
};
constexpr std::array<Kind, 4> kKinds{
    {{RenderKind::Picture, "picture", "render/kind/picture", "picture.png"},
     {RenderKind::Sequence, "sequence", "render/kind/sequence", "frames.%04d.png"},
     {RenderKind::Turntable, "turntable", "render/kind/turntable", "turntable.mp4"},
     {RenderKind::Video, "video", "render/kind/video", "video.mp4"}}};

/// @return a new number that is typed or dragged, limited
template <class Number>
void field(PanelState& state, const char* label, const char* name, Number& io, double low, double high)
{
    Member member;
    member.kind = std::is_integral_v<Number> ? MemberKind::Integer : MemberKind::Number;
    member.minimum = low;
    member.maximum = high;
    if (const auto edit = numberField(state, name, double(io), member, ImGui::GetFontSize() * 6.0f))
        io = Number(limited(member, edit->value).get<double>());
    ImGui::SameLine();
    ImGui::TextUnformatted(label);
}

void popup(PanelState& state)
{
    RenderRequest& request = state.render.request;
    for (const Kind& kind : kKinds) {
        if (ImGui::RadioButton(kind.label, request.kind == kind.kind)) {
            request.kind = kind.kind;
            request.file = kind.file;
        }
        state.mark(kind.name);
        if (&kind != &kKinds.back())
            ImGui::SameLine();
    }
    textField(state, "file", "render/file", ImGui::GetFontSize() * 18.0f, request.file);
    field(state, "pixels wide", "render/width", request.width, 16.0, 4096.0);
    field(state, "pixels high", "render/height", request.height, 16.0, 4096.0);
    if (request.kind != RenderKind::Picture)
        field(state, "frames a second", "render/rate", request.framesPerSecond, 1.0, 240.0);
    if (request.kind == RenderKind::Turntable)
        field(state, "frames of one turn, at the present time", "render/turns", request.turnFrames, 2.0,
              3600.0);
    else if (request.kind != RenderKind::Picture)
        ImGui::TextDisabled("from 0 to the end of the timeline, %.3g s", state.session.playback.end);
    if (button(state, "Render", "render/start") && !request.file.empty()) {
        state.render.isAsked = true;
        ImGui::CloseCurrentPopup();
    }
}

} // namespace

void renderMenu(PanelState& state)
{
    RenderState& render = state.render;
    if (render.isRunning) {
        ImGui::ProgressBar(float(render.progress), {ImGui::GetFontSize() * 5.0f, 0.0f});
        ImGui::SameLine();
        if (button(state, "cancel", "render/cancel"))
            render.isStopped = true;
        return;
    }
    if (button(state, "Render ...", "render")) {
        render.request.width = int(state.pictureSize.x);
        render.request.height = int(state.pictureSize.y);
        ImGui::OpenPopup("render popup");
    }
    if (!ImGui::BeginPopup("render popup"))
        return;
    popup(state);
    ImGui::EndPopup();
}

} // namespace fx::editor
