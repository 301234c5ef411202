#include "fxsdk/editor/document/emitter_starters.h"
#include "fxsdk/editor/inspector/member.h"
#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <cstdio>

namespace fx::editor {

namespace {

void toggle(PanelState& state, const char* label, const std::string& name, bool isOn, ImU32 color,
            void (Session::*set)(const std::string&, bool), const std::string& element)
{
    ImGui::PushStyleColor(ImGuiCol_Button, isOn ? color : ImGui::GetColorU32(ImGuiCol_FrameBg));
    if (button(state, (std::string(label) + "##" + element).c_str(), name + element))
        (state.session.*set)(element, !isOn);
    ImGui::PopStyleColor();
}

/// What has been measured of an element or a technique, if it is of the present document; otherwise null.
const PartCost* costOf(const PanelState& state, const std::vector<PartCost>& costs,
                       const std::string& pointer)
{
    const auto found = std::find_if(costs.begin(), costs.end(),
                                    [&](const PartCost& part) { return part.pointer == pointer; });
    return found == costs.end() || state.budget.isOld ? nullptr : &*found;
}

std::string millisecondsOf(const PartCost& cost)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g ms", cost.total());
    return text;
}

/// The stages of a cost, for a tooltip.
std::string stagesOf(const PartCost* cost)
{
    if (!cost)
        return "\"Budget\" measures its milliseconds";
    char text[160];
    std::snprintf(text, sizeof text, "simulation %.3g ms, lights %.3g ms, effects %.3g ms, \xC2\xB1 %.2g ms",
                  cost->times.simulation, cost->times.lights, cost->times.effects, cost->noise);
    return text;
}

/// Particles of the element in the picture, and what it has cost.
std::string costText(const PanelState& state, const std::string& pointer, const PartCost* cost)
{
    std::string text;
    if (const auto found = state.picture.elements.find(pointer); found != state.picture.elements.end())
        text = std::to_string(found->second);
    return cost ? text + "  " + millisecondsOf(*cost) : text;
}

/// The technique of the rows below it, where there are several or its cost is known.
void techniqueRow(PanelState& state, const std::string& technique, bool isOnly)
{
    const PartCost* const cost = costOf(state, state.budget.report.techniques, technique);
    if (isOnly && !cost)
        return;
    ImGui::TextDisabled("%s%s%s", elementTitle(state.session.document, technique).c_str(), cost ? "  " : "",
                        cost ? millisecondsOf(*cost).c_str() : "");
    state.mark("technique" + technique);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("All of this technique: %s", stagesOf(cost).c_str());
}

void row(PanelState& state, const std::string& pointer)
{
    Session& session = state.session;
    const SoloMute& choice = session.soloMute();
    toggle(state, "S", "solo", choice.isSolo(pointer), IM_COL32(190, 150, 40, 255), &Session::setSolo,
           pointer);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Solo: only what is solo is shown");
    ImGui::SameLine(0.0f, 2.0f);
    toggle(state, "M", "mute", choice.isMuted(pointer), IM_COL32(170, 70, 60, 255), &Session::setMuted,
           pointer);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Mute: it is not shown");
    ImGui::SameLine();
    if (!choice.isShown(pointer))
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    const bool wasShown = choice.isShown(pointer);
    const PartCost* const measured = costOf(state, state.budget.report.elements, pointer);
    const std::string cost = costText(state, pointer, measured);
    const float room = ImGui::GetContentRegionAvail().x;
    const float costWidth = ImGui::CalcTextSize(cost.c_str()).x;
    ImGui::AlignTextToFramePadding();
    if (ImGui::Selectable((elementTitle(session.document, pointer) + "##" + pointer).c_str(),
                          session.selection == pointer, 0, {room - costWidth - 6.0f, 0.0f}))
        session.selection = pointer;
    state.mark("select" + pointer);
    ImGui::SameLine(0.0f, 6.0f);
    ImGui::TextDisabled("%s", cost.c_str());
    state.mark("cost" + pointer);
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Particles in the picture; %s", stagesOf(measured).c_str());
    if (!wasShown)
        ImGui::PopStyleColor();
}

/// The elements of a preset by their techniques.
void elementRows(PanelState& state)
{
    const Session& session = state.session;
    const std::vector<std::string> elements =
        soloElements(session.document.json(), session.document.schema());
    const auto techniqueOf = [](const std::string& pointer) {
        return Json::json_pointer(pointer).parent_pointer().to_string();
    };
    const bool isOnly = elements.empty() || techniqueOf(elements.front()) == techniqueOf(elements.back());
    std::string technique;
    for (const std::string& pointer : elements) {
        if (std::string present = techniqueOf(pointer); present != technique) {
            technique = std::move(present);
            techniqueRow(state, technique, isOnly);
        }
        row(state, pointer);
    }
}

/// The instances of a scene.
void instanceRows(PanelState& state)
{
    Session& session = state.session;
    for (const Member& instance : elementsOf(session.document, "/instances")) {
        const std::string& pointer = instance.pointer;
        const bool isSelected = (session.selection + "/").starts_with(pointer + "/");
        if (ImGui::Selectable((elementTitle(session.document, pointer) + "##" + pointer).c_str(), isSelected))
            session.selection = pointer;
        state.mark("select" + pointer);
    }
}

/// Duplicate, move and remove the selected element.
void elementButtons(PanelState& state)
{
    Session& session = state.session;
    const Json::json_pointer at(session.selection);
    const std::string array = at.empty() ? std::string() : at.parent_pointer().to_string();
    const Json& document = session.document.json();
    const bool isElement = !array.empty() && document.contains(Json::json_pointer(array)) &&
                           document.at(Json::json_pointer(array)).is_array();
    if (!isElement)
        return;
    const size_t index = std::stoul(at.back());
    const size_t count = document.at(Json::json_pointer(array)).size();
    const auto go = [&](size_t to) { session.selection = array + "/" + std::to_string(to); };
    if (button(state, "duplicate", "outliner/duplicate")) {
        session.run(session.document.duplicate(array, index));
        go(index + 1);
    }
    sameLineIfItFits("up");
    if (button(state, "up", "outliner/up") && index > 0) {
        session.run(session.document.move(array, index, index - 1));
        go(index - 1);
    }
    sameLineIfItFits("down");
    if (button(state, "down", "outliner/down") && index + 1 < count) {
        session.run(session.document.move(array, index, index + 1));
        go(index + 1);
    }
    sameLineIfItFits("remove");
    if (button(state, "remove", "outliner/remove"))
        session.run(session.document.erase(session.selection));
    sameLineIfItFits("copy");
    if (button(state, "copy", "outliner/copy") && document.contains(at))
        ImGui::SetClipboardText(document.at(at).dump(2).c_str());
    sameLineIfItFits("paste");
    if (button(state, "paste", "outliner/paste")) {
        const char* const text = ImGui::GetClipboardText();
        Json pasted = Json::parse(text ? text : "", nullptr, false);
        session.run(pasted.is_object()
                        ? session.document.insert(array, index + 1, std::move(pasted))
                        : base::Status(base::Code::Parse, "The clipboard holds no JSON object"));
    }
}

/// Emitters that are seen at once.
void starterItems(PanelState& state)
{
    Session& session = state.session;
    if (session.document.kind() != DocumentKind::Preset)
        return;
    for (const EmitterStarter& starter : emitterStarters()) {
        const bool isChosen =
            ImGui::Selectable((std::string(starter.name) + ": " + starter.description).c_str());
        state.mark(std::string("add/starter/") + starter.name);
        if (!isChosen)
            continue;
        const Json& preset = session.document.json();
        const size_t count = preset.contains("emitters") ? preset["emitters"].size() : 0;
        session.run(session.document.insert("/emitters", count, starterEmitter(starter, preset)));
        session.selection = "/emitters/" + std::to_string(count);
    }
    ImGui::Separator();
}

void addMenu(PanelState& state)
{
    if (button(state, "add ...", "outliner/add"))
        ImGui::OpenPopup("add element");
    if (!ImGui::BeginPopup("add element"))
        return;
    Session& session = state.session;
    starterItems(state);
    for (const Member& member : membersOf(session.document, "")) {
        if (member.kind != MemberKind::Array)
            continue;
        const Json& items = (*member.schema)["items"];
        const bool isChosen = ImGui::Selectable(items.value("title", member.title).c_str());
        state.mark("add" + member.pointer);
        if (!isChosen)
            continue;
        const Json::json_pointer at(member.pointer);
        const size_t count = session.document.json().contains(at) ? session.document.json().at(at).size() : 0;
        Json element = startValue(items);
        if (items["properties"].contains("emission")) // an emitter needs births
            element["emission"] = {{"rate", 20}};
        session.run(session.document.insert(member.pointer, count, std::move(element)));
        session.selection = member.pointer + "/" + std::to_string(count);
    }
    ImGui::EndPopup();
}

} // namespace

std::string elementTitle(const Document& document, const std::string& pointer)
{
    if (pointer.empty())
        return document.kind() == DocumentKind::Preset ? "Effect" : "Scene";
    if (pointer.find('/', 1) == std::string::npos && document.json().contains(Json::json_pointer(pointer)) &&
        document.json().at(Json::json_pointer(pointer)).is_array())
        return "all " + pointer.substr(1);
    const Json::json_pointer at(pointer);
    const auto member = memberAt(document, pointer);
    std::string title = member ? member->title : at.back();
    if (document.json().contains(at)) {
        const Json& value = document.json().at(at);
        for (const char* name : {"name", "preset", "shape"})
            if (value.is_object() && value.contains(name) && value[name].is_string())
                return title + ": " + value[name].get<std::string>();
    }
    const bool isElement =
        document.json().contains(at.parent_pointer()) && document.json().at(at.parent_pointer()).is_array();
    return isElement ? title + " " + at.back() : title;
}

void outlinerPanel(PanelState& state)
{
    Session& session = state.session;
    if (ImGui::Selectable(elementTitle(session.document, "").c_str(), session.selection.empty()))
        session.selection.clear();
    state.mark("select");
    ImGui::Separator();
    if (session.document.kind() == DocumentKind::Preset)
        elementRows(state);
    else
        instanceRows(state);
    ImGui::Separator();
    addMenu(state);
    elementButtons(state);
}

} // namespace fx::editor
