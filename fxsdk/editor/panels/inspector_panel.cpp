#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/inspector/new_element.h"
#include "fxsdk/editor/panels/member_field.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace fx::editor {

namespace {

const ImVec4 kChanged(1.0f, 0.80f, 0.42f, 1.0f);
const ImVec4 kDim(0.62f, 0.65f, 0.70f, 1.0f);
const ImVec4 kError(1.0f, 0.45f, 0.40f, 1.0f);
constexpr float kUnused = 0.45f; // opacity of a member that would have no effect

bool contains(std::string text, std::string part)
{
    const auto lower = [](std::string& io) {
        std::transform(io.begin(), io.end(), io.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
    };
    lower(text);
    lower(part);
    return text.find(part) != std::string::npos;
}

std::string boundsText(const Member& member)
{
    std::string text;
    if (member.minimum && member.maximum)
        text = Json(*member.minimum).dump() + " to " + Json(*member.maximum).dump();
    if (!member.unit.empty())
        text += (text.empty() ? "" : " ") + member.unit;
    return text;
}

/// @param unused why the member would have no effect; empty: it has one
void helpOf(const Member& member, const std::string& unused = {})
{
    if (!ImGui::IsItemHovered() || !beginTooltip())
        return;
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
    ImGui::TextUnformatted((member.title + " (" + member.name + ")").c_str());
    ImGui::TextUnformatted(member.help.c_str());
    if (!unused.empty())
        ImGui::TextColored(kChanged, "%s", unused.c_str());
    if (const std::string bounds = boundsText(member); !bounds.empty())
        ImGui::TextColored(kDim, "%s", bounds.c_str());
    if (member.defaultValue)
        ImGui::TextColored(kDim, "default %s", member.defaultValue->dump().c_str());
    if (!member.cost.empty())
        ImGui::TextColored(kDim, "cost: %s", member.cost.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// The first finding at a member or inside of it.
const DocumentFinding* findingAt(Session& session, const std::string& pointer)
{
    for (const DocumentFinding& finding : session.findings())
        if (finding.diagnostic.pointer == pointer || finding.diagnostic.pointer.starts_with(pointer + "/"))
            return &finding;
    return nullptr;
}

void warnAt(PanelState& state, const Member& member)
{
    const bool isLeaf = member.kind != MemberKind::Object && member.kind != MemberKind::Array;
    const DocumentFinding* const finding = isLeaf ? findingAt(state.session, member.pointer) : nullptr;
    if (!finding)
        return;
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextColored(finding->diagnostic.warning ? kChanged : kError, "%s",
                       finding->diagnostic.message.c_str());
    ImGui::PopTextWrapPos();
    if (finding->remedy &&
        button(state, (finding->remedy->label + "##" + member.pointer).c_str(), "remedy" + member.pointer))
        state.session.run(applyRemedy(state.session.document, *finding->remedy));
}

/// Whether a title is the name of the member in words.
bool isNamed(const Member& member)
{
    std::string title;
    for (const char c : member.title)
        if (c != ' ' && c != '-')
            title += c;
    return contains(title, member.name) && title.size() == member.name.size();
}

/// The name in the file beside a title that says something else, where there is room.
void nameBeside(const Member& member)
{
    constexpr float kGap = 6.0f; // [pixel]
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const float end = ImGui::GetItemRectMax().x + kGap + ImGui::CalcTextSize(member.name.c_str()).x;
    if (isNamed(member) || end > right)
        return;
    ImGui::SameLine(0.0f, kGap);
    ImGui::TextDisabled("%s", member.name.c_str());
}

void leafRow(PanelState& state, const Member& member)
{
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    const bool isChanged = differsFromDefault(state.session.document, member);
    const auto& unused = state.session.unusedMembers();
    const auto reason = unused.find(member.pointer);
    const bool isUnused = reason != unused.end();
    if (isUnused)
        ImGui::PushStyleVar(ImGuiStyleVar_Alpha, kUnused);
    ImGui::TextColored(isChanged ? kChanged : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%s",
                       member.title.c_str());
    helpOf(member, isUnused ? reason->second : std::string());
    nameBeside(member);
    ImGui::TableNextColumn();
    memberField(state, member);
    if (isUnused)
        ImGui::PopStyleVar();
    warnAt(state, member);
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(kDim, "%s", member.unit.c_str());
    ImGui::TableNextColumn();
    if (member.isPresent && !member.isRequired) {
        if (button(state, ("x##" + member.pointer).c_str(), "reset" + member.pointer))
            state.session.run(state.session.document.erase(member.pointer));
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("Remove it from the file: the default holds");
    }
}

void rows(PanelState& state, const std::vector<Member>& members)
{
    bool isOpen = false;
    for (const Member& member : members) {
        const bool isLeaf = member.kind != MemberKind::Object && member.kind != MemberKind::Array;
        const bool isFound = state.search.empty() || contains(member.title, state.search) ||
                             contains(member.name, state.search) || contains(member.help, state.search);
        if (!isLeaf || !isFound)
            continue;
        if (!isOpen && !(isOpen = ImGui::BeginTable("members", 4, ImGuiTableFlags_SizingStretchProp)))
            return;
        if (ImGui::TableGetColumnCount() == 4 && ImGui::TableGetRowIndex() < 0) {
            ImGui::TableSetupColumn("title", ImGuiTableColumnFlags_WidthStretch, 0.455f);
            ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.545f);
            ImGui::TableSetupColumn("unit", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 3.6f);
            ImGui::TableSetupColumn("reset", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 1.6f);
        }
        leafRow(state, member);
    }
    if (isOpen)
        ImGui::EndTable();
}

void object(PanelState& state, const std::string& pointer, int depth);

void markHeader(PanelState& state, const std::string& pointer, bool isOpen)
{
    state.mark(pointer);
    if (!isOpen)
        state.closedHeaders.push_back(pointer);
}

void element(PanelState& state, const Member& member, size_t index, const std::string& array, int depth)
{
    ImGui::PushID(int(index));
    const bool isObject = member.kind == MemberKind::Object;
    state.openIfAsked(member.pointer);
    const bool isOpen =
        !isObject || ImGui::TreeNodeEx(elementTitle(state.session.document, member.pointer).c_str(),
                                       ImGuiTreeNodeFlags_DefaultOpen);
    if (isObject)
        markHeader(state, member.pointer, isOpen);
    if (isOpen) {
        if (button(state, "remove", "remove" + member.pointer))
            state.session.run(state.session.document.erase(array + "/" + std::to_string(index)));
        else if (isObject)
            object(state, member.pointer, depth + 1);
        else
            rows(state, {member});
        if (isObject)
            ImGui::TreePop();
    }
    ImGui::PopID();
}

void group(PanelState& state, const Member& member, int depth)
{
    const bool isTechnique =
        depth == 0 && member.pointer == "/" + member.name && member.kind == MemberKind::Array;
    if (isTechnique && state.session.document.kind() == DocumentKind::Preset)
        return; // in the outliner
    const ImGuiTreeNodeFlags flags =
        member.isPresent ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
    state.openIfAsked(member.pointer);
    const bool isOpen = ImGui::CollapsingHeader((member.title + "##" + member.pointer).c_str(), flags);
    markHeader(state, member.pointer, isOpen);
    helpOf(member);
    if (!isOpen)
        return;
    ImGui::Indent(8.0f);
    if (member.kind == MemberKind::Object)
        object(state, member.pointer, depth + 1);
    else {
        size_t index = 0;
        for (const Member& inner : elementsOf(state.session.document, member.pointer))
            element(state, inner, index++, member.pointer, depth);
        if (button(state, ("add##" + member.pointer).c_str(), "add" + member.pointer))
            state.session.run(addElement(state.session.document, member));
    }
    ImGui::Unindent(8.0f);
}

void object(PanelState& state, const std::string& pointer, int depth)
{
    ImGui::PushID(pointer.c_str());
    const std::vector<Member> members = membersOf(state.session.document, pointer);
    rows(state, members);
    for (const Member& member : members)
        if (member.kind == MemberKind::Object || member.kind == MemberKind::Array)
            group(state, member, depth);
    for (const std::string& name : unknownMembersOf(state.session.document, pointer))
        ImGui::TextColored(kError, "%s: unknown, kept in the file", name.c_str());
    ImGui::PopID();
}

} // namespace

void inspectorPanel(PanelState& state)
{
    Session& session = state.session;
    ImGui::TextUnformatted(elementTitle(session.document, session.selection).c_str());
    char search[128];
    std::snprintf(search, sizeof search, "%s", state.search.c_str());
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::InputTextWithHint("##search", "search members", search, sizeof search))
        state.search = search;
    state.mark("inspector/search");
    ImGui::BeginChild("members");
    object(state, session.selection, session.selection.empty() ? 0 : 1);
    ImGui::EndChild();
}

} // namespace fx::editor
