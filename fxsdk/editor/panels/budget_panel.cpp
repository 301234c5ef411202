#include "fxsdk/editor/panels/panels.h"

#include <algorithm>
#include <cstdio>

namespace fx::editor {

namespace {

std::string textOf(const char* format, double value)
{
    char text[48];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string milliseconds(double value)
{
    return textOf(value < 100.0 ? "%.3g ms" : "%.0f ms", value);
}

bool beginTable(const char* name, std::initializer_list<const char*> titles)
{
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg |
                                       ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_NoHostExtendX;
    if (!ImGui::BeginTable(name, int(titles.size()), kFlags))
        return false;
    for (const char* title : titles)
        ImGui::TableSetupColumn(title);
    ImGui::TableHeadersRow();
    return true;
}

void cell(const std::string& text)
{
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
}

void stageCells(const StageTimes& times)
{
    for (const double value : {times.simulation, times.lights, times.stage, times.effects})
        cell(milliseconds(value));
}

void stagesAndQualities(const BudgetReport& report)
{
    if (report.qualities.empty())
        return;
    if (!beginTable("qualities", {"quality", "particles", "simulation", "lights", "stage", "effects"}))
        return;
    for (const QualityCost& quality : report.qualities) {
        cell(quality.name);
        cell(std::to_string(quality.particles));
        stageCells(quality.times);
    }
    ImGui::EndTable();
}

/// Techniques or elements, with what their times are uncertain by.
void parts(PanelState& state, const char* title, const std::vector<PartCost>& costs)
{
    if (costs.empty() || !beginTable(title, {title, "simulation", "lights", "effects", "sum", "noise"}))
        return;
    for (const PartCost& part : costs) {
        cell(elementTitle(state.session.document, part.pointer));
        for (const double value :
             {part.times.simulation, part.times.lights, part.times.effects, part.total()})
            cell(milliseconds(value));
        cell("\xC2\xB1 " + milliseconds(part.noise));
    }
    ImGui::EndTable();
    state.mark(std::string("budget/") + title);
}

void pictures(PanelState& state, const BudgetReport& report)
{
    const float width = ImGui::GetFontSize() * 11.0f;
    const float height = width * float(report.height) / float(std::max(report.width, 1));
    for (const QualityCost& quality : report.qualities) {
        ImGui::BeginGroup();
        ImGui::TextUnformatted(quality.name.c_str());
        ImGui::Image(imageOf(quality.texture), {width, height}, {0, 1}, {1, 0});
        ImGui::EndGroup();
        state.mark("budget/" + quality.name);
        if (&quality != &report.qualities.back())
            ImGui::SameLine();
    }
}

/// Bars of the particles, and a line of the time of a step, against time.
void moments(PanelState& state, const BudgetReport& report)
{
    if (report.moments.size() < 2)
        return;
    double particles = 1.0, simulation = 1e-3;
    for (const MomentCost& moment : report.moments) {
        particles = std::max(particles, double(moment.particles));
        simulation = std::max(simulation, moment.simulation);
    }
    const double end = std::max(state.session.playback.end, 1e-3);
    ImGui::TextColored({0.47f, 0.67f, 1.0f, 1.0f}, "particles, up to %.0f", particles);
    ImGui::SameLine(0.0f, 20.0f);
    ImGui::TextColored({1.0f, 0.77f, 0.36f, 1.0f}, "time of a step, up to %s",
                       milliseconds(simulation).c_str());
    ImGui::SameLine(0.0f, 20.0f);
    ImGui::TextDisabled("0 to %s", textOf("%.3g s", end).c_str());
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(ImGui::GetContentRegionAvail().x - 8.0f, 60.0f), ImGui::GetFontSize() * 5.0f);
    ImGui::InvisibleButton("moments", size);
    state.mark("budget/moments");
    ImDrawList* const draw = ImGui::GetWindowDrawList();
    draw->AddRectFilled(low, {low.x + size.x, low.y + size.y}, IM_COL32(24, 27, 33, 255));
    const float wide = size.x / float(report.moments.size());
    ImVec2 last;
    for (const MomentCost& moment : report.moments) {
        const float x = low.x + (size.x - wide) * float(std::min(moment.time / end, 1.0));
        const float bar = (size.y - 4.0f) * float(moment.particles / particles);
        draw->AddRectFilled({x + 1, low.y + size.y - bar}, {x + wide - 1, low.y + size.y},
                            IM_COL32(90, 140, 220, 255));
        const ImVec2 at(x + 0.5f * wide,
                        low.y + size.y - 2.0f - (size.y - 4.0f) * float(moment.simulation / simulation));
        if (&moment != &report.moments.front())
            draw->AddLine(last, at, IM_COL32(255, 196, 92, 255), 2.0f);
        last = at;
    }
    const float now = low.x + size.x * float(state.session.playback.time() / end);
    draw->AddLine({now, low.y}, {now, low.y + size.y}, IM_COL32_WHITE);
}

} // namespace

void budgetPanel(PanelState& state)
{
    BudgetState& budget = state.budget;
    if (budget.isRunning) {
        ImGui::ProgressBar(float(budget.progress), {ImGui::GetFontSize() * 8.0f, 0.0f});
        ImGui::SameLine();
        if (button(state, "stop", "budget/stop"))
            budget.isStopped = true;
    } else if (button(state, "Measure", "budget/measure")) {
        budget.isAsked = true;
    }
    const BudgetReport& report = budget.report;
    ImGui::SameLine();
    if (!budget.failure.empty())
        ImGui::TextColored({1.0f, 0.45f, 0.40f, 1.0f}, "%s", budget.failure.c_str());
    else if (report.width == 0)
        ImGui::TextDisabled(
            "what techniques, elements, stages of a frame and qualities cost on this machine");
    else
        ImGui::TextDisabled("at %.2f s, %d x %d%s", report.time, report.width, report.height,
                            budget.isOld ? ", before the last change" : "");
    ImGui::BeginChild("budget");
    if (report.width > 0) {
        moments(state, report);
        stagesAndQualities(report);
        parts(state, "technique", report.techniques);
        parts(state, "element", report.elements);
        if (report.unmeasured > 0)
            ImGui::TextDisabled("%zu more elements are not measured", report.unmeasured);
        pictures(state, report);
    }
    ImGui::EndChild();
}

} // namespace fx::editor
