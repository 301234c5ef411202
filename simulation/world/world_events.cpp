// Events between the solvers of an effect, and of the host.
#include "simulation/emitters/events/event_board.h"
#include "simulation/world/world.h"

#include <algorithm>
#include <optional>

namespace fx::sim {

/// The solvers that are not through yet. Those that tell each other of events share the scratch memory of the
/// sub-step, causes before effects.
/// @param ioBoard their events, which stay with the scratch memory while the sub-step waits
/// @return whether all are through
bool World::stepSolvers(Run& run, StepContext& context, std::optional<EventBoard>& ioBoard,
                        base::WorkBudget& work)
{
    const std::span<const uint32_t> order = run.effect->order;
    const bool isLinked = !order.empty();
    if (isLinked && !ioBoard)
        ioBoard.emplace(*context.scratch, ++boards_, run.solvers.size(),
                        [&run](size_t solver) { return run.effect->solvers[solver]->capacity(); });
    context.board = ioBoard ? &*ioBoard : nullptr;
    while (run.stepped < run.solvers.size()) {
        if (run.stepped > 0 && work.isSpent())
            return false;
        context.solverIndex = isLinked ? order[run.stepped] : run.stepped;
        if (!stepWithin(*run.solvers[context.solverIndex], context, work))
            return false;
        ++run.stepped; // whatever fails from here on
        if (!isLinked)
            context.scratch->reset();
    }
    context.board = nullptr;
    ioBoard.reset();
    context.scratch->reset();
    return true;
}

/// Where solvers of a run that is not stepped with the others tell each other of events; null where they do
/// not.
LinkedPart* World::linkedPartOf(Run& run)
{
    if (!run.effect->order.empty() && !run.linked)
        run.linked = std::make_unique<LinkedPart>(memory_);
    return run.linked.get();
}

void World::tell(Slot slot, const HostEvent& event)
{
    if (isStepping())
        return waiting_.push_back({slot, event});
    isolate(slot);
    const RunIndex index = instances_[slot].run;
    runs_.at(index).told.push_back({now_, event});
    runs_.touch(index); // no instance may join it any more
}

/// Takes the pending events of the run up to scene time `tick`.
std::span<const HostEvent> World::hear(RunIndex index, base::Ticks tick, base::Arena& scratch)
{
    Run& run = runs_.at(index);
    if (run.told.empty())
        return {};
    const base::Ticks until = std::max(tick, run.conditions.clock.scene);
    const auto end = std::find_if(run.told.begin(), run.told.end(),
                                  [until](const Run::Told& told) { return told.tick > until; });
    const std::span<HostEvent> heard = scratch.allocate<HostEvent>(size_t(end - run.told.begin()));
    std::transform(run.told.begin(), end, heard.begin(), [](const Run::Told& told) { return told.event; });
    run.told.erase(run.told.begin(), end);
    return heard;
}

void World::restoreTold(Run& run, StateReader& reader)
{
    const size_t known = run.effect->hostEvents.size();
    if (known == 0)
        return;
    const uint32_t count = reader.value<uint32_t>(0, 1u << 20, "too many events wait");
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        Run::Told told{};
        told.tick = reader.value<base::Ticks>();
        told.event.event = reader.value<uint32_t>(0, uint32_t(known - 1), "an event is unknown");
        told.event.count = reader.value<uint32_t>();
        run.told.push_back(told);
    }
}

} // namespace fx::sim
