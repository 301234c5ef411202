// Instances whose particles stay behind when the host moves them: a move is spread over the steps of an
// update.
#include "fxsdk/scene/scene.h"

#include <glm/gtc/quaternion.hpp>

namespace fx::scene {

namespace {

/// The straight way in `share` of it; bits that depend on nothing but the arguments.
base::Placement between(const base::Placement& from, const base::Placement& to, float share)
{
    base::Placement placement;
    placement.position = from.position + double(share) * (to.position - from.position);
    const glm::quat near = glm::dot(from.rotation, to.rotation) < 0.0f ? -to.rotation : to.rotation;
    placement.rotation = glm::normalize(from.rotation * (1.0f - share) + near * share);
    placement.scale = from.scale + share * (to.scale - from.scale);
    return placement;
}

} // namespace

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
            step == steps ? to : between(*instance->setup.cameFrom, to, float(step) / float(steps)));
    }
}

void Scene::endMoves()
{
    for (const LocalId id : moved_)
        if (Instance* instance = instances_.find(id))
            instance->setup.cameFrom.reset();
    moved_.clear();
}

} // namespace fx::scene
