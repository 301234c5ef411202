/// @file world_context.h
/// Step contexts of the solvers of a world.
#pragma once

#include "simulation/solver/placed_contact.h"
#include "simulation/world/world.h"

#include <optional>

namespace fx::sim {

/// Creates the step context of a simulation and calls body(context, simulation). All members of the context
/// except the time are set.
template <class F>
void World::withContext(SimulationIndex index, StepCounters& counters, F&& body)
{
    SharedSimulation& simulation = simulations_.at(index);
    StepContext context{};
    context.seed = simulation.conditions.seed;
    context.gravity = simulation.conditions.gravity;
    context.wind = simulation.conditions.wind;
    context.groundHeight = simulation.conditions.groundHeight;
    std::optional<Collider> collider;
    PlacedContact contact(contact_, simulation.conditions.placement, contactFaults_);
    if (simulation.conditions.hasContact &&
        contact_.meet) // a paused simulation may be at a time before the callback was set
        context.contactHook = &contact.hook();
    if (simulation.conditions.field)
        collider.emplace(*simulation.conditions.field, simulation.conditions.placement);
    context.collider = collider ? &*collider : nullptr;
    context.parameters = &simulation.conditions.parameters;
    context.placement = simulation.conditions.placement;
    context.worldGravity = environment_.gravity;
    context.worldWind = simulation.conditions.worldWind;
    context.effectWind = simulation.effect->wind;
    context.tasks = tasks_;
    context.scratch = &scratch_;
    context.counters = &counters;
    context.gpuParticles = gpuParticles_ && !simulation.conditions.parameters.isTinted();
    body(context, simulation);
}

} // namespace fx::sim
