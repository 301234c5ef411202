// Instances whose particles stay behind when the host moves them: a move is spread over the steps of an
// update.
#include "fxsdk/scene/scene.h"

#include "simulation/emitters/births/moved_space.h"

namespace fx::scene {

namespace {
constexpr uint32_t kWholeWay = 2; ///< steps
}

/// Before step number `step` of `steps`, from 1 on.
void Scene::moveOn(uint32_t step, uint32_t steps)
{
    if (steps < 2) // they are at the end of their way already
        return;
    for (const LocalId id : moved_) {
        const Instance* instance = instances_.find(id);
        if (!instance || !instance->setup.cameFrom || instance->state == InstanceState::Dormant ||
            instance->state == InstanceState::Finished)
            continue;
        const base::Placement& to = instance->setup.placement;
        world_.setPlacement(
            instance->slot,
            step == steps ? to : sim::between(*instance->setup.cameFrom, to, float(step) / float(steps)));
    }
}

/// @param isComplete all steps of the update have been taken; otherwise the rest of the way is gone in the
///                   next one
void Scene::endMoves(bool isComplete)
{
    if (!isComplete)
        moveOn(kWholeWay, kWholeWay);
    for (const LocalId id : moved_)
        if (Instance* instance = instances_.find(id))
            instance->setup.cameFrom.reset();
    moved_.clear();
}

} // namespace fx::scene
