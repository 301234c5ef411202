#include "fxsdk/presets/effect_cost.h"

#include "foundation/tasks/work_budget.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace fx::preset {

namespace {

/// What the definition of a solver says of itself.
SolverCost costOf(const sim::SolverDef& def, const Technique& technique, size_t place)
{
    SolverCost cost;
    cost.stepWork = def.workOf({kCostStep});
    cost.bytes = def.bytes() + def.capacity() * kBlobSnapshotBytes;
    cost.member = technique.presetMember;
    cost.place = place;
    return cost;
}

std::vector<SolverCost> costsOf(const PresetValue& root, const sim::EffectDef& effect, Techniques techniques)
{
    std::vector<SolverCost> costs;
    costs.reserve(effect.solvers.size());
    for (const Technique& technique : techniques) {
        const size_t first = costs.size();
        const size_t elements = root.size(std::string(technique.presetMember).c_str());
        for (size_t i = 0; i < elements && costs.size() < effect.solvers.size(); ++i)
            costs.push_back(costOf(*effect.solvers[costs.size()], technique, i));
        if (technique.estimate)
            technique.estimate(root, effect, std::span(costs).subspan(first));
    }
    return costs;
}

void warn(const PresetValue& root, const SolverCost& cost, const std::string& member, const std::string& text)
{
    const PresetValue element = root.element(cost.member.c_str(), cost.place);
    const size_t slash = member.find('/');
    if (slash == std::string::npos)
        return element.warning(member.c_str(), text);
    element.child(member.substr(0, slash).c_str()).warning(member.substr(slash + 1).c_str(), text);
}

std::string milliseconds(double units)
{
    const double ms = units * base::kSecondsPerUnit * 1e3;
    return std::to_string(uint64_t(std::min(ms + 0.5, 1e15))) + " ms";
}

std::string sharePercent(double part, double all)
{
    return std::to_string(int(100.0 * part / all + 0.5)) + " %";
}

/// The remedy for `member` in a warning.
std::string remedyOf(const std::string& member)
{
    return member.empty() ? "make it smaller" : "lower " + member.substr(member.find('/') + 1);
}

void lintCost(const PresetValue& root, const sim::EffectDef& effect, const std::vector<SolverCost>& solvers)
{
    const sim::EffectCost& cost = effect.cost;
    const auto worst =
        std::max_element(solvers.begin(), solvers.end(),
                         [](const SolverCost& a, const SolverCost& b) { return a.stepWork < b.stepWork; });
    if (cost.stepWork > kMuchStepWork && effect.subSteps > 1 &&
        cost.stepWork / double(effect.subSteps) <= kMuchStepWork)
        root.warning("subSteps", "a step of 1/60 s is expected to take about " + milliseconds(cost.stepWork) +
                                     " of a core, so updates will not keep up; lower subSteps");
    else if (cost.stepWork > kMuchStepWork)
        warn(root, *worst, worst->workMember,
             "a step of 1/60 s is expected to take about " + milliseconds(cost.stepWork) + " of a core, " +
                 sharePercent(worst->stepWork, cost.stepWork) + " of it here, so updates will not keep up; " +
                 (worst->workRemedy.empty() ? remedyOf(worst->workMember) : worst->workRemedy));
    if (cost.startWork > kMuchStartWork)
        root.warning("prewarm", "is expected to take about " + milliseconds(cost.startWork) +
                                    " of a core before an instance is seen; shorten it");
    const auto largest =
        std::max_element(solvers.begin(), solvers.end(),
                         [](const SolverCost& a, const SolverCost& b) { return a.bytes < b.bytes; });
    if (cost.memory > kMuchMemory)
        warn(root, *largest, largest->memoryMember,
             "an instance can take about " + std::to_string(cost.memory >> 20) + " MiB of memory, " +
                 sharePercent(double(largest->bytes), double(cost.memory)) + " of it here; " +
                 remedyOf(largest->memoryMember));
}

/// A prewarm of an effect whose solvers all jump to any time takes no steps.
bool isClosed(const sim::EffectDef& effect)
{
    return std::ranges::all_of(effect.solvers,
                               [](const auto& def) { return def->catchUp() == sim::CatchUp::Analytic; });
}

} // namespace

void estimateCost(const PresetValue& root, sim::EffectDef& effect, Techniques techniques)
{
    const std::vector<SolverCost> solvers = costsOf(root, effect, techniques);
    double startWork = 0;
    for (const SolverCost& solver : solvers) {
        effect.cost.stepWork += solver.stepWork;
        effect.cost.memory += solver.bytes;
        startWork += solver.prewarmShare * solver.stepWork;
    }
    if (!isClosed(effect))
        effect.cost.startWork = startWork * base::toSeconds(effect.prewarm) / kCostStep;
    if (!solvers.empty())
        lintCost(root, effect, solvers);
}

} // namespace fx::preset
