#include "fxsdk/editor/panels/panels.h"

#include <utility>

namespace fx::editor {

namespace {

void slotButtons(PanelState& state, size_t slot, const char* name)
{
    Session& session = state.session;
    const std::string label(name);
    if (button(state, ("keep as " + label).c_str(), "keep/" + label))
        session.snapshots.take(slot, session.document);
    ImGui::SameLine();
    if (session.snapshots.has(slot) && button(state, ("restore " + label).c_str(), "restore/" + label))
        session.snapshots.restore(slot, session.document);
}

} // namespace

void changesPanel(PanelState& state)
{
    Session& session = state.session;
    slotButtons(state, 0, "A");
    ImGui::SameLine(0.0f, 24.0f);
    slotButtons(state, 1, "B");
    ImGui::Text("%zu edits, difference from the saved file:", session.document.history().done());
    ImGui::BeginChild("difference");
    ShownDifference& shown = state.difference;
    if (std::string text = session.document.text();
        text != shown.after || session.document.savedText() != shown.before)
    {
        shown.before = session.document.savedText();
        shown.after = std::move(text);
        shown.lines = difference(shown.before, shown.after);
    }
    for (const DifferenceLine& line : shown.lines) {
        const ImVec4 color = line.mark == '+'   ? ImVec4(0.55f, 0.85f, 0.50f, 1.0f)
                             : line.mark == '-' ? ImVec4(0.95f, 0.50f, 0.45f, 1.0f)
                                                : ImVec4(0.62f, 0.65f, 0.70f, 1.0f);
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted((std::string(1, line.mark) + " " + line.text).c_str());
        ImGui::PopStyleColor();
    }
    ImGui::EndChild();
}

} // namespace fx::editor
