#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <cstdio>
#include <filesystem>

namespace fx::editor {

bool button(PanelState& state, const char* label, const std::string& name)
{
    const bool isClicked = ImGui::Button(label);
    state.mark(name);
    return isClicked;
}

void textField(PanelState& state, const char* label, const std::string& name, float width, std::string& io)
{
    char text[1024];
    std::snprintf(text, sizeof text, "%s", io.c_str());
    ImGui::SetNextItemWidth(width);
    if (ImGui::InputText(label, text, sizeof text))
        io = text;
    state.mark(name);
}

void sameLineIfItFits(float width)
{
    if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width <= rightEnd())
        ImGui::SameLine();
}

void sameLineIfItFits(const char* label)
{
    sameLineIfItFits(ImGui::CalcTextSize(label).x + 2.0f * ImGui::GetStyle().FramePadding.x);
}

namespace {

void saveAsDialog(PanelState& state)
{
    if (!ImGui::BeginPopup("save as"))
        return;
    textField(state, "##file", "save as/file", ImGui::GetFontSize() * 28.0f, state.saveAs);
    ImGui::SameLine();
    if (button(state, "save", "save as/save") && !state.saveAs.empty()) {
        state.session.saveAs(state.saveAs);
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

} // namespace

void topBar(PanelState& state)
{
    Session& session = state.session;
    const bool isSave = button(state, "Save", "save");
    const bool hasFile = !session.document.path().empty();
    if (isSave && hasFile)
        session.save();
    ImGui::SameLine();
    if (button(state, "Save as ...", "save as") || (isSave && !hasFile)) {
        state.saveAs = hasFile ? session.document.path() : std::string("my-effect.fx.json");
        ImGui::OpenPopup("save as");
    }
    saveAsDialog(state);
    ImGui::SameLine(0.0f, 16.0f);
    if (button(state, "Undo", "undo"))
        session.undo();
    ImGui::SameLine();
    if (button(state, "Redo", "redo"))
        session.redo();
    ImGui::SameLine(0.0f, 16.0f);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("exposure EV");
    ImGui::SameLine();
    Member exposure;
    exposure.kind = MemberKind::Number;
    exposure.minimum = -10.0;
    exposure.maximum = 24.0;
    const double present = session.exposureEv100.value_or(state.picture.exposureEv100);
    if (const auto edit = numberField(state, "exposure", present, exposure, ImGui::GetFontSize() * 5.5f))
        session.exposureEv100 = float(limited(exposure, edit->value).get<double>());
    ImGui::SameLine(0.0f, 16.0f);
    renderMenu(state);
    ImGui::SameLine(0.0f, 16.0f);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(session.document.isDirty() ? ImVec4(1.0f, 0.80f, 0.42f, 1.0f)
                                                  : ImVec4(0.62f, 0.65f, 0.70f, 1.0f),
                       "%s%s", std::filesystem::path(session.name()).filename().string().c_str(),
                       session.document.isDirty() ? " (not saved)" : "");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", session.name().c_str());
    ImGui::SameLine(0.0f, 16.0f);
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(session.message.c_str());
}

void questionPanel(PanelState& state)
{
    Session& session = state.session;
    if (session.recovery()) {
        ImGui::TextUnformatted("The editor ended without saving this file. Recover what was edited?");
        if (button(state, "Recover", "recover"))
            session.recover();
        ImGui::SameLine();
        if (button(state, "Discard", "discard"))
            session.discardRecovery();
    } else if (session.conflict()) {
        ImGui::TextUnformatted("The file has changed outside of the editor, and you have edited it here.");
        if (button(state, "Take the file (can be undone)", "conflict/theirs"))
            session.takeTheirs();
        ImGui::SameLine();
        if (button(state, "Keep mine", "conflict/mine"))
            session.keepMine();
    }
}

} // namespace fx::editor
