#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"
#include "fxsdk/scene_file/stages.h"

#include <algorithm>
#include <cstdio>

namespace fx::editor {

namespace {

constexpr double kBrightest = 1e6; // [lx], [cd/m2]

void closeByEscape()
{
    if (isKeyPressed(ImGuiKey_Escape))
        ImGui::CloseCurrentPopup();
}

void stageNames(PanelState& state, StageChoice& io)
{
    const auto choose = [&](const std::string& name, const char* label, const char* place) {
        if (ImGui::Selectable(label, io.name == name, kKeepsPopup))
            io.name = name;
        state.mark(place);
    };
    choose("", "as in the document", "stage/document");
    for (const scene_file::Stage& stage : scene_file::stages()) {
        const std::string name(stage.name);
        choose(name, (name + ": " + std::string(stage.description)).c_str(), ("stage/" + name).c_str());
    }
}

void meshField(PanelState& state, StageChoice& io)
{
    char text[512];
    std::snprintf(text, sizeof text, "%s", io.meshFile.c_str());
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14.0f);
    if (ImGui::InputTextWithHint("OBJ file beside the document", "own-stage.obj", text, sizeof text,
                                 ImGuiInputTextFlags_EnterReturnsTrue))
        io.meshFile = text;
    state.mark("stage/mesh");
}

void lightFields(PanelState& state, StageChoice& io)
{
    const Session& session = state.session;
    const StageLightValues light =
        lightOf(onStage(session.document.json(), session.document.kind(), io), session.document.kind());
    const auto field = [&](const char* label, const char* name, double value, double low, double high) {
        Member member;
        member.kind = MemberKind::Number;
        member.minimum = low;
        member.maximum = high;
        auto edit = numberField(state, name, value, member, ImGui::GetFontSize() * 6.0f);
        ImGui::SameLine();
        ImGui::TextUnformatted(label);
        if (edit)
            edit->value = limited(member, edit->value).get<double>();
        return edit;
    };
    const double heading = headingOf(light.sunDirection), elevation = elevationOf(light.sunDirection);
    if (const auto edit =
            field("sun heading [degree], 0: +Z, 90: +X", "stage/sun/heading", heading, -360.0, 360.0))
        io.sunDirection = directionOf(edit->value, elevation);
    if (const auto edit = field("sun elevation [degree]", "stage/sun/elevation", elevation, -90.0, 90.0))
        io.sunDirection = directionOf(heading, edit->value);
    if (const auto edit = field("sun [lx]", "stage/sun/illuminance", light.sunIlluminance, 0.0, kBrightest))
        io.sunIlluminance = edit->value;
    if (const auto edit = field("sky [cd/m2]", "stage/sky", light.skyLuminance, 0.0, kBrightest))
        io.skyLuminance = edit->value;
    skyFields(state, "stage/sky", io);
}

void stagePopup(PanelState& state)
{
    if (!ImGui::BeginPopup("stage popup"))
        return;
    closeByEscape();
    Session& session = state.session;
    StageChoice choice = session.stage();
    stageNames(state, choice);
    ImGui::Separator();
    meshField(state, choice);
    if (session.document.kind() == DocumentKind::Preset) {
        bool isOn = choice.hasFigure.value_or(hasFigure(session.document.json()));
        if (ImGui::Checkbox("person of 1.8 m", &isOn))
            choice.hasFigure = isOn;
        state.mark("stage/figure");
    }
    lightFields(state, choice);
    session.setStage(std::move(choice));
    if (button(state, "keep in the document", "stage/keep"))
        session.keepStage();
    ImGui::SameLine();
    if (button(state, "as in the document", "stage/reset"))
        session.setStage({});
    ImGui::EndPopup();
}

void overlayPopup(PanelState& state)
{
    if (!ImGui::BeginPopup("overlay popup"))
        return;
    closeByEscape();
    OverlayChoice& overlays = state.session.overlays;
    const auto toggle = [&](const char* label, const char* name, bool& io) {
        ImGui::Checkbox(label, &io);
        state.mark(name);
    };
    toggle("shapes and fields of the selected element, sun", "overlay/shapes", overlays.shapes);
    toggle("bounds", "overlay/bounds", overlays.bounds);
    toggle("velocities", "overlay/velocities", overlays.velocities);
    toggle("overdraw", "overlay/overdraw", overlays.overdraw);
    toggle("slice through media at the target of the camera", "overlay/slice", overlays.slice);
    toggle("volume of the sun's light slices", "overlay/slices", overlays.lightSlices);
    ImGui::EndPopup();
}

void motionPopup(PanelState& state)
{
    if (!ImGui::BeginPopup("motion popup"))
        return;
    closeByEscape();
    MotionChoice motion = state.session.motion();
    const auto choose = [&](const char* label, const char* name, MotionKind kind) {
        if (ImGui::RadioButton(label, motion.kind == kind))
            motion.kind = kind;
        state.mark(name);
    };
    choose("still", "motion/still", MotionKind::Still);
    choose("as in the document: keys, speed, triggers, jumps", "motion/document", MotionKind::Document);
    choose("circle", "motion/circle", MotionKind::Circle);
    choose("throw, 45 degrees upwards along +X", "motion/throw", MotionKind::Throw);
    const auto field = [&](const char* label, const char* name, double& io, double high) {
        Member member;
        member.kind = MemberKind::Number;
        member.minimum = 0.01;
        member.maximum = high;
        if (const auto edit = numberField(state, name, io, member, ImGui::GetFontSize() * 6.0f))
            io = limited(member, edit->value).get<double>();
        ImGui::SameLine();
        ImGui::TextUnformatted(label);
    };
    if (motion.kind == MotionKind::Circle)
        field("radius [m]", "motion/radius", motion.radius, 1000.0);
    if (motion.kind == MotionKind::Circle || motion.kind == MotionKind::Throw)
        field("speed [m/s]", "motion/speed", motion.speed, 1000.0);
    state.session.setMotion(motion);
    ImGui::EndPopup();
}

void cameraPopup(PanelState& state)
{
    if (!ImGui::BeginPopup("camera popup"))
        return;
    closeByEscape();
    const char* const of = state.session.document.kind() == DocumentKind::Scene ? "scene" : "preview";
    const auto choose = [&](const std::string& label, const char* name) {
        const bool isChosen = ImGui::Selectable(label.c_str());
        state.mark(name);
        return isChosen;
    };
    if (choose(std::string("look through the camera of the ") + of, "camera/look"))
        state.asksCamera = true;
    if (choose(std::string("take this view as the camera of the ") + of +
                   (state.session.hasCameraKeys() ? ", instead of its keys" : ""),
               "camera/take"))
        state.session.keepCamera();
    ImGui::EndPopup();
}

void errorButtons(PanelState& state)
{
    ErrorState& error = state.error;
    if (error.isRunning) {
        ImGui::ProgressBar(float(error.progress), {ImGui::GetFontSize() * 4.0f, 0.0f});
        ImGui::SameLine();
        if (button(state, "cancel", "error/cancel"))
            error.isStopped = true;
    } else if (button(state, "Error", "error")) {
        error.isAsked = true;
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "Computes this moment with the reference renderer, small, and shows the difference");
    if (error.texture != 0 && !error.isRunning) {
        ImGui::SameLine();
        ImGui::Checkbox("shown##error", &error.isShown);
        state.mark("error/shown");
    }
}

} // namespace

void viewportBar(PanelState& state)
{
    Session& session = state.session;
    const std::string& name = session.stage().name;
    if (button(state, ("Stage" + (name.empty() ? name : ": " + name) + "###stage").c_str(), "stage"))
        ImGui::OpenPopup("stage popup");
    stagePopup(state);
    ImGui::SameLine();
    if (button(state, "Overlays", "overlays"))
        ImGui::OpenPopup("overlay popup");
    overlayPopup(state);
    ImGui::SameLine();
    if (button(state, "Camera", "camera"))
        ImGui::OpenPopup("camera popup");
    cameraPopup(state);
    ImGui::SameLine();
    if (button(state, session.comparison.isShown ? "One picture###compare" : "Before | now###compare",
               "compare"))
        session.comparison.isShown = !session.comparison.isShown;
    sameLineIfItFits("Motion");
    if (button(state, "Motion", "motion"))
        ImGui::OpenPopup("motion popup");
    motionPopup(state);
    sameLineIfItFits(ImGui::GetFontSize() *
                     9.0f); // room for progress and "cancel": the picture keeps its size
    errorButtons(state);
}

} // namespace fx::editor
