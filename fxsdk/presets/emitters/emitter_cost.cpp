// What the solvers of emitters cost: births, those that events cause included, and what is shown of
// particles.
#include "fxsdk/presets/emitters/birth_count.h"
#include "fxsdk/presets/emitters/emitter_technique.h"
#include "simulation/emitters/events/event_board.h"
#include "simulation/particles/particle_program.h"

#include <algorithm>
#include <vector>

namespace fx::preset {

namespace {

constexpr double kMaxEvents = 65536.0; // of one kind, of one emitter in a sub-step: what it has room for
constexpr uint64_t kParticleSnapshotBytes = 3 * 40; // in the three snapshots that there are

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
    return std::min(events, kMaxEvents);
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
        const double fed = std::min(asked[i], std::max(capacity, double(sim::kMinEventBirths)));
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
    double work = sim::shownWork(emitter.appearance.kind);
    if (emitter.trail.lifetime > 0.0f)
        work += sim::emitter_work::kPoint * double(emitter.trail.maxPoints);
    return work + (emitter.light.given ? sim::emitter_work::kLight : 0.0);
}

void estimate(const sim::EmitterDef& emitter, const sim::StepLoad& load, double subSteps, SolverCost& out)
{
    const sim::StepLoad births{load.seconds, load.births}, events{load.seconds, 0, 0, load.events};
    const double all = emitter.workOf(load);
    out.stepWork = all * subSteps + load.alive * shownWork(emitter);
    out.workMember = "maxParticles";
    if (emitter.workOf(births) > 0.5 * all)
        out.workMember = emitter.fed                 ? "events"
                         : emitter.emission.rate > 0 ? "emission/rate"
                                                     : "emission/bursts";
    if (emitter.workOf(events) > 0.5 * all)
        out.workMember = "events";
    if (out.workMember == "events")
        out.workRemedy = "lower the counts of events, or maxParticles";
    const bool isMedium = emitter.appearance.kind == sim::AppearanceKind::Medium;
    const uint64_t shown = emitter.appearance.kind == sim::AppearanceKind::None ? 0
                           : isMedium                                           ? kBlobSnapshotBytes
                                                                                : kParticleSnapshotBytes;
    out.bytes = emitter.bytes() + emitter.maxParticles * shown;
    out.memoryMember = "maxParticles";
}

} // namespace

void estimateEmitters(const PresetValue&, const sim::EffectDef& effect, std::span<SolverCost> ioCosts)
{
    std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    emitters.resize(ioCosts.size()); // they are the first solvers
    const double subSteps = double(effect.subSteps);
    const Loads loads = loadsOf(emitters, effect.order, kCostStep / subSteps);
    for (size_t i = 0; i < emitters.size(); ++i)
        estimate(*emitters[i], loads[i], subSteps, ioCosts[i]);
}

} // namespace fx::preset
