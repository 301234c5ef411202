#include "fxsdk/editor/panels/curve_keys.h"
#include "fxsdk/editor/panels/number_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <string>

namespace fx::editor {

void skyFields(PanelState& state, const std::string& prefix, StageChoice& io)
{
    constexpr double kBrightest = 1e6; // [cd/m2]
    const Session& session = state.session;
    const glm::dvec3 sky =
        lightOf(onStage(session.document.json(), session.document.kind(), io), session.document.kind()).sky;
    glm::dvec3 wanted = sky;
    Member member;
    member.kind = MemberKind::Number;
    member.minimum = 0.0;
    member.maximum = kBrightest;
    for (int i = 0; i < 3; ++i) {
        const std::string name = prefix + "/" + std::to_string(i);
        if (const auto edit = numberField(state, name, sky[i], member, ImGui::GetFontSize() * 5.8f))
            wanted[i] = limited(member, edit->value).get<double>();
        ImGui::SameLine(0.0f, 2.0f);
    }
    ImGui::TextUnformatted("sky, red green blue [cd/m2]");
    const double most = std::max({sky.x, sky.y, sky.z, 1e-9});
    float shown[3];
    for (int i = 0; i < 3; ++i)
        shown[i] = toDisplay(float(sky[i] / most));
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 13.0f);
    if (ImGui::ColorEdit3(("color of the sky##" + prefix).c_str(), shown, ImGuiColorEditFlags_Float)) {
        const glm::dvec3 color(double(fromDisplay(shown[0])), double(fromDisplay(shown[1])),
                               double(fromDisplay(shown[2])));
        // The luminance holds, as far as Rec. 709 weighs it.
        const glm::dvec3 weights(0.2126, 0.7152, 0.0722);
        const double before = glm::dot(sky, weights), after = glm::dot(color, weights);
        if (before > 0.0 && after > 0.0)
            wanted = color * (before / after);
    }
    state.mark(prefix + "/color");
    if (wanted != sky)
        setSky(io, wanted);
}

} // namespace fx::editor
