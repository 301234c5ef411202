#include "fxsdk/presets/effect_cost.h"

#include "foundation/tasks/work_budget.h"
#include "fxsdk/presets/birth_count.h"
#include "simulation/emitters/events/event_board.h"
#include "simulation/particles/particle_program.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace fx::preset {

namespace {

constexpr double kStep = 1.0 / 60.0;        // [s]
constexpr double kMostEvents = 65536.0;     // of one kind, of one emitter in a sub-step: what it has room for
constexpr double kUsualGasShare = 0.1;      // [1] of the work of a gas's first step in those of a prewarm
constexpr uint64_t kBlobBytes = 3 * 100;    // in the three snapshots that there are
constexpr uint64_t kParticleBytes = 3 * 40; // likewise

/// What one solver adds, and which of its members decides.
struct Share
{
    double work = 0; ///< [unit] of a step
    uint64_t bytes = 0;
    std::string list;                     ///< member of the preset that it is in
    size_t place = 0;                     ///< in that list
    std::string workMember, memoryMember; ///< with a slash where it is in an object
};

using Loads = std::vector<sim::StepLoad>;

/// Events of the emitter's particles in a sub-step that `rule` answers.
double eventsOf(const sim::EventRule& rule, const sim::EmitterDef& emitter, const sim::StepLoad& load)
{
    double events = load.births;
    if (rule.on == sim::EventKind::Host)
        events = 1.0;
    if (rule.on == sim::EventKind::Age)
        events = std::min(events * timesOf(rule, emitter.lifetime),
                          rule.every > 0 ? load.alive * (load.seconds / base::toSeconds(rule.every) + 1.0)
                                         : load.alive + load.births);
    return std::min(events, kMostEvents);
}

/// Causes come before what they cause in `order`.
Loads loadsOf(const std::vector<const sim::EmitterDef*>& emitters, const std::vector<uint32_t>& order,
              double seconds)
{
    Loads loads(emitters.size(), sim::StepLoad{seconds});
    std::vector<double> asked(emitters.size()); // births, by events
    for (size_t k = 0; k < emitters.size() || k < order.size(); ++k) {
        const size_t i = order.empty() ? k : order[k];
        if (i >= emitters.size())
            continue; // not an emitter
        const sim::EmitterDef& emitter = *emitters[i];
        sim::StepLoad& load = loads[i];
        const double capacity = double(emitter.maxParticles);
        const double fed = std::min(asked[i], std::max(capacity, double(sim::kFewestFed)));
        const double life = double(emitter.lifetime.max);
        const double turnover = capacity * (seconds / std::max(double(emitter.lifetime.min), 1e-4) + 1.0);
        load.births = std::min(ownBirths(emitter.emission, seconds) + fed, turnover);
        load.alive = std::min(
            ownBirths(emitter.emission, std::max(life, seconds)) + fed * (life / seconds + 1.0), capacity);
        for (const sim::EventRule& rule : emitter.events) {
            const double events = eventsOf(rule, emitter, load);
            load.events += events * double(emitter.events.size());
            if (rule.target < asked.size())
                asked[rule.target] += events * double(rule.probability) * double(rule.most);
        }
    }
    return loads;
}

/// [unit] of a particle, once a step.
double shownWork(const sim::EmitterDef& emitter)
{
    double work = sim::shownWork(emitter.look.kind);
    if (emitter.trail.lifetime > 0.0f)
        work += sim::emitter_work::kPoint * double(emitter.trail.maxPoints);
    return work + (emitter.light.given ? sim::emitter_work::kLight : 0.0);
}

Share shareOf(const sim::EmitterDef& emitter, const sim::StepLoad& load, double subSteps)
{
    Share share;
    const sim::StepLoad births{load.seconds, load.births}, events{load.seconds, 0, 0, load.events};
    const double all = emitter.workOf(load);
    share.work = all * subSteps + load.alive * shownWork(emitter);
    share.workMember = "maxParticles";
    if (emitter.workOf(births) > 0.5 * all)
        share.workMember = emitter.fed                 ? "events"
                           : emitter.emission.rate > 0 ? "emission/rate"
                                                       : "emission/bursts";
    if (emitter.workOf(events) > 0.5 * all)
        share.workMember = "events";
    const bool isMedium = emitter.look.kind == sim::Appearance::Medium;
    const uint64_t shown = emitter.look.kind == sim::Appearance::None ? 0
                           : isMedium                                 ? kBlobBytes
                                                                      : kParticleBytes;
    share.bytes = emitter.bytes() + emitter.maxParticles * shown;
    share.memoryMember = "maxParticles";
    return share;
}

Share shareOf(const PresetValue& element, const std::string& list, const sim::SolverDef& def)
{
    Share share;
    share.work = def.workOf({kStep});
    share.bytes = def.bytes() + def.capacity() * kBlobBytes;
    float soundSpeed = 1.0f;
    element.read("soundSpeed", soundSpeed);
    const bool isFragments = list == "fragments";
    share.workMember = isFragments ? "trail/maxBlobs" : soundSpeed > 0.0f ? "particles" : "soundSpeed";
    share.memoryMember = isFragments ? "trail/maxBlobs" : "particles";
    return share;
}

void warn(const PresetValue& root, const Share& share, const std::string& member, const std::string& text)
{
    const PresetValue element = root.element(share.list.c_str(), share.place);
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

/// What an author is told to do about `member`.
std::string remedyOf(const std::string& member)
{
    if (member == "soundSpeed")
        return "give a soundSpeed above 0, or lower particles";
    if (member == "events")
        return "lower the counts of events, or maxParticles";
    return "lower " + member.substr(member.find('/') + 1);
}

void adviseCost(const PresetValue& root, const sim::EffectDef& effect, const std::vector<Share>& shares)
{
    const sim::EffectCost& cost = effect.cost;
    const auto worst = std::max_element(shares.begin(), shares.end(),
                                        [](const Share& a, const Share& b) { return a.work < b.work; });
    if (cost.stepWork > kMuchStepWork && effect.subSteps > 1 &&
        cost.stepWork / double(effect.subSteps) <= kMuchStepWork)
        root.warning("subSteps", "a step of 1/60 s is expected to take about " + milliseconds(cost.stepWork) +
                                     " of a core, so updates will not keep up; lower subSteps");
    else if (cost.stepWork > kMuchStepWork)
        warn(root, *worst, worst->workMember,
             "a step of 1/60 s is expected to take about " + milliseconds(cost.stepWork) + " of a core, " +
                 sharePercent(worst->work, cost.stepWork) + " of it here, so updates will not keep up; " +
                 remedyOf(worst->workMember));
    if (cost.startWork > kMuchStartWork)
        root.warning("prewarm", "is expected to take about " + milliseconds(cost.startWork) +
                                    " of a core before an instance is seen; shorten it");
    const auto largest = std::max_element(shares.begin(), shares.end(),
                                          [](const Share& a, const Share& b) { return a.bytes < b.bytes; });
    if (cost.memory > kMuchMemory)
        warn(root, *largest, largest->memoryMember,
             "an instance can take about " + std::to_string(cost.memory >> 20) + " MiB of memory, " +
                 sharePercent(double(largest->bytes), double(cost.memory)) + " of it here; " +
                 remedyOf(largest->memoryMember));
}

} // namespace

void estimateCost(const PresetValue& root, sim::EffectDef& effect)
{
    std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    emitters.resize(root.size("emitters")); // they are the first solvers
    std::vector<Share> shares;
    const double subSteps = double(effect.subSteps);
    const Loads loads = loadsOf(emitters, effect.order, kStep / subSteps);
    bool isClosed = effect.solvers.size() == emitters.size(); // jumps to any time
    double startWork = 0;
    for (size_t i = 0; i < emitters.size(); ++i) {
        shares.push_back(shareOf(*emitters[i], loads[i], subSteps));
        isClosed = isClosed && emitters[i]->catchUp() == sim::CatchUp::Analytic;
        startWork += shares.back().work;
    }
    size_t solver = emitters.size();
    for (const char* list : {"fragments", "gas"})
        for (size_t i = 0; i < root.size(list) && solver < effect.solvers.size(); ++i, ++solver) {
            shares.push_back(shareOf(root.element(list, i), list, *effect.solvers[solver]));
            shares.back().list = list;
            shares.back().place = i;
            startWork += kUsualGasShare * shares.back().work;
        }
    for (size_t i = 0; i < emitters.size(); ++i) {
        shares[i].list = "emitters";
        shares[i].place = i;
    }
    for (const Share& share : shares) {
        effect.cost.stepWork += share.work;
        effect.cost.memory += share.bytes;
    }
    if (!isClosed)
        effect.cost.startWork = startWork * base::toSeconds(effect.prewarm) / kStep;
    if (!shares.empty())
        adviseCost(root, effect, shares);
}

} // namespace fx::preset
