#include "fxsdk/editor/panels/panels.h"

namespace fx::editor {

void findingsPanel(PanelState& state)
{
    Session& session = state.session;
    const std::vector<DocumentFinding> findings = session.findings();
    if (findings.empty())
        ImGui::TextDisabled("No errors and no warnings.");
    size_t number = 0;
    for (const DocumentFinding& finding : findings) {
        ImGui::PushID(int(number));
        const std::string name = "finding/" + std::to_string(number++);
        const ImVec4 color =
            finding.diagnostic.warning ? ImVec4(1.0f, 0.80f, 0.42f, 1.0f) : ImVec4(1.0f, 0.45f, 0.40f, 1.0f);
        if (finding.remedy) {
            if (button(state, finding.remedy->label.c_str(), name + "/remedy"))
                session.run(applyRemedy(session.document, *finding.remedy));
            ImGui::SameLine();
        }
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextColored(color, "%s %s: %s", finding.diagnostic.warning ? "warning" : "error",
                           finding.diagnostic.pointer.c_str(), finding.diagnostic.message.c_str());
        ImGui::PopTextWrapPos();
        ImGui::PopID();
    }
    ImGui::Separator();
    if (button(state, "Why is nothing visible?", "why"))
        state.asksWhy = true;
    if (!state.why.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(state.why.c_str());
        ImGui::PopTextWrapPos();
    }
}

} // namespace fx::editor
