// What the host does to one instance of a running scene besides moving it.
#include "fxsdk/scene/scene.h"

#include <algorithm>

namespace fx::scene {

base::Status Scene::tell(LocalId id, std::string_view name, uint32_t count)
{
    Instance& instance = *instances_.find(id);
    const std::vector<std::string>& known = instance.setup.effect->hostEvents;
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end())
        return {base::Code::NotFound,
                "the preset has no event that the host calls \"" + std::string(name.substr(0, 128)) + "\""};
    if (instance.state == InstanceState::Dormant)
        return {base::Code::InvalidArgument, "the instance has not started yet"};
    if (instance.state == InstanceState::Finished || count == 0)
        return {};
    world_.tell(instance.slot, {uint32_t(found - known.begin()), count});
    if (instance.state == InstanceState::Resting)
        comeBack(indexOf(id));
    return {};
}

void Scene::setRate(LocalId id, uint32_t rate)
{
    Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Finished)
        return;
    if (instance.state == InstanceState::Dormant) {
        instance.setup.rate = rate;
        return;
    }
    world_.setRate(instance.slot, rate); // may throw
    instance.setup.clock = world_.clockOf(instance.slot);
    measure(instance);
    if (instance.state == InstanceState::Resting || instance.state == InstanceState::Hidden)
        comeBack(indexOf(id));
}

base::Status Scene::seek(LocalId id, base::Ticks local)
{
    Instance& instance = *instances_.find(id);
    if (instance.state == InstanceState::Dormant)
        return {base::Code::InvalidArgument, "the instance has not started yet"};
    if (instance.state == InstanceState::Finished)
        return {base::Code::InvalidArgument, "the instance has ended"};
    world_.seekTo(instance.slot, local, clock_.stepTicks(), counters_.work);
    instance.setup.clock = world_.clockOf(instance.slot);
    instance.setup.cameFrom.reset(); // it has been where it is now from its first step on
    if (instance.state == InstanceState::Resting || instance.state == InstanceState::Hidden)
        comeBack(indexOf(id));
    return {};
}

} // namespace fx::scene
