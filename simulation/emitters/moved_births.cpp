// Births of emitters whose particles stay behind when their instance moves.
#include "simulation/emitters/emitter_solver.h"

#include <algorithm>

namespace fx::sim {

/// What the step is about, in the space of where the emitter began.
void EmitterSolver::toHome(StepContext& context, std::optional<Collider>& collider) const
{
    const base::Placement& home = space_->home();
    if (context.placement.rotation != home.rotation || context.placement.scale != home.scale) {
        // What is of the world is not turned there and back: no rounding. The preset's own wind is air too:
        // like the emitter's it stays as it was where the instance began, and does not turn with it.
        context.gravity = space_->fromWorld(context.worldGravity);
        context.wind =
            context.effectWind + space_->fromWorld(context.worldWind) / std::max(home.scale, 1e-6f);
    }
    if (context.collider) {
        collider.emplace(context.collider->field(), space_->home());
        context.collider = &*collider;
    }
}

void EmitterSolver::carryBirths(const StepContext& context, std::span<const Birth> births)
{
    for (const Birth& birth : births)
        if (const uint32_t row = store_.rowOf(birth.index); store_.index[row] == birth.index)
            carryBirth(context, birth, row, true);
}

/// @param byClock false: an event has put it there already
void EmitterSolver::carryBirth(const StepContext& context, const Birth& birth, uint32_t row, bool byClock)
{
    glm::vec3 position, velocity;
    for (size_t a = 0; a < 3; ++a) {
        position[int(a)] = store_.values[stored::X + a][row];
        velocity[int(a)] = store_.values[stored::VelocityX + a][row];
    }
    if (byClock) {
        const double share = double(birth.tick - context.tick) / double(context.stepTicks);
        space_->carry(float(share), context.seconds(), def_.inheritVelocity, position, velocity);
    } else {
        position = space_->turned(position);
        velocity = space_->turned(velocity);
    }
    for (size_t a = 0; a < 3; ++a) {
        store_.values[stored::X + a][row] = position[int(a)];
        store_.values[stored::VelocityX + a][row] = velocity[int(a)];
    }
}

} // namespace fx::sim
