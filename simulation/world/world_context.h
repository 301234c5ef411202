/// @file world_context.h
/// What solvers of a world are stepped with. For the parts of World that step.
#pragma once

#include "simulation/solver/placed_contact.h"
#include "simulation/world/world.h"

#include <optional>

namespace fx::sim {

/// Calls body(context, run) with everything but the time filled in.
template <class F>
void World::withContext(RunIndex index, StepCounters& counters, F&& body)
{
    Run& run = runs_.at(index);
    StepContext context{};
    context.seed = run.conditions.seed;
    context.gravity = run.conditions.gravity;
    context.wind = run.conditions.wind;
    context.groundHeight = run.conditions.groundHeight;
    std::optional<Collider> collider;
    PlacedContact contact(contact_, run.conditions.placement, contactFaults_);
    if (run.conditions.hasContact && contact_.meet) // a paused run may be at a time when there was none
        context.contactHook = &contact.hook();
    if (run.conditions.field)
        collider.emplace(*run.conditions.field, run.conditions.placement);
    context.collider = collider ? &*collider : nullptr;
    context.parameters = &run.conditions.parameters;
    context.placement = run.conditions.placement;
    context.worldGravity = environment_.gravity;
    context.worldWind = run.conditions.worldWind;
    context.effectWind = run.effect->wind;
    context.tasks = tasks_;
    context.scratch = &scratch_;
    context.counters = &counters;
    context.gpuParticles = gpuParticles_;
    body(context, run);
}

} // namespace fx::sim
