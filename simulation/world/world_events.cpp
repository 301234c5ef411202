// Events between the solvers of an effect, and of the host.
#include "simulation/emitters/events/event_board.h"
#include "simulation/solver/air_mover.h"
#include "simulation/world/world.h"

#include <algorithm>
#include <array>
#include <optional>

namespace fx::sim {

namespace {

/// The air that the gases of the simulation move now.
/// @return as many of `room` as there are
std::span<const ThermalFlow> thermalsOf(const SharedSimulation& simulation, const StepContext& context,
                                        std::span<ThermalFlow> room)
{
    size_t count = 0;
    for (const std::unique_ptr<Solver>& solver : simulation.solvers) {
        const AirMover* const mover = solver->airMover();
        if (!mover || count == room.size())
            continue;
        const ThermalFlow flow = mover->thermal(context.gravity, context.wind);
        if (flow.active())
            room[count++] = flow;
    }
    return room.first(count);
}

} // namespace

/// The solvers that are not through yet. Those that tell each other of events share the scratch memory of the
/// sub-step, causes before effects.
/// @param ioBoard their events, which stay with the scratch memory while the sub-step waits
/// @return whether all are through
bool World::stepSolvers(SharedSimulation& simulation, StepContext& context,
                        std::optional<EventBoard>& ioBoard, base::WorkBudget& work)
{
    const std::span<const uint32_t> order = simulation.effect->order;
    const bool isLinked = !order.empty();
    if (isLinked && !ioBoard)
        ioBoard.emplace(*context.scratch, ++boards_, simulation.solvers.size(), [&simulation](size_t solver) {
            return simulation.effect->solvers[solver]->capacity();
        });
    context.board = ioBoard ? &*ioBoard : nullptr;
    while (simulation.stepped < simulation.solvers.size()) {
        if (simulation.stepped > 0 && work.isSpent())
            return false;
        context.solverIndex = isLinked ? order[simulation.stepped] : simulation.stepped;
        std::array<ThermalFlow, kMaxThermals> room;
        context.thermals = {};
        if (simulation.effect->solvers[context.solverIndex]->followsThermals())
            context.thermals = thermalsOf(simulation, context, room);
        if (!stepWithin(*simulation.solvers[context.solverIndex], context, work))
            return false;
        ++simulation.stepped; // whatever fails from here on
        if (!isLinked)
            context.scratch->reset();
    }
    context.board = nullptr;
    context.thermals = {};
    ioBoard.reset();
    context.scratch->reset();
    return true;
}

/// Where solvers of a simulation that is not stepped with the others tell each other of events; null where
/// they do not.
LinkedPart* World::linkedPartOf(SharedSimulation& simulation)
{
    if (!simulation.effect->order.empty() && !simulation.linked)
        simulation.linked = std::make_unique<LinkedPart>(memory_);
    return simulation.linked.get();
}

void World::postEvent(Slot slot, const HostEvent& event)
{
    if (isStepping())
        return waiting_.push_back({slot, event});
    isolate(slot);
    const SimulationIndex index = instances_[slot].simulation;
    simulations_.at(index).pendingEvents.push_back({now_, event});
    simulations_.touch(index); // no instance may join it any more
}

/// Takes the pending events of the simulation up to scene time `tick`.
std::span<const HostEvent> World::takeEvents(SimulationIndex index, base::Ticks tick, base::Arena& scratch)
{
    SharedSimulation& simulation = simulations_.at(index);
    if (simulation.pendingEvents.empty())
        return {};
    const base::Ticks until = std::max(tick, simulation.conditions.clock.scene);
    const auto end =
        std::find_if(simulation.pendingEvents.begin(), simulation.pendingEvents.end(),
                     [until](const SharedSimulation::PendingEvent& pending) { return pending.tick > until; });
    const std::span<HostEvent> hostEvents =
        scratch.allocate<HostEvent>(size_t(end - simulation.pendingEvents.begin()));
    std::transform(simulation.pendingEvents.begin(), end, hostEvents.begin(),
                   [](const SharedSimulation::PendingEvent& pending) { return pending.event; });
    simulation.pendingEvents.erase(simulation.pendingEvents.begin(), end);
    return hostEvents;
}

/// Makes a simulation that is stepped with the others the source of the events that follow.
void World::selectCues(SharedSimulation& simulation)
{
    if (simulation.cuesIn != stepNumber_) {
        simulation.cuesIn = stepNumber_;
        simulation.cues = 0;
        simulation.cueOrder = cueOrders_++;
    }
    cues_->select(simulation.cueOrder, simulation.conditions.clock, simulation.cues);
}

CueEvent World::inWorld(const CueEvent& event, const base::Placement& placement)
{
    CueEvent out = event;
    const float scale = placement.scale;
    out.position = placement.position + glm::dvec3(placement.rotation * (scale * event.event.position));
    out.event.velocity = placement.rotation * (scale * event.event.velocity);
    out.event.normal = placement.rotation * event.event.normal;
    out.event.speed = scale * event.event.speed;
    out.isInWorld = true;
    return out;
}

void World::restorePending(SharedSimulation& simulation, StateReader& reader)
{
    const size_t known = simulation.effect->hostEvents.size();
    if (known == 0)
        return;
    const uint32_t count = reader.value<uint32_t>(0, 1u << 20, "too many events wait");
    for (uint32_t i = 0; i < count && reader.ok(); ++i) {
        SharedSimulation::PendingEvent pending{};
        pending.tick = reader.value<base::Ticks>();
        pending.event.event = reader.value<uint32_t>(0, uint32_t(known - 1), "an event is unknown");
        pending.event.count = reader.value<uint32_t>();
        simulation.pendingEvents.push_back(pending);
    }
}

} // namespace fx::sim
