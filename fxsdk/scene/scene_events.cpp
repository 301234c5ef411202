// Events of the steps of a scene, for the host.
#include "fxsdk/scene/scene.h"

namespace fx::scene {

namespace {

SceneEventKind kindOf(sim::EventKind kind)
{
    switch (kind) {
    case sim::EventKind::Birth:
        return SceneEventKind::Born;
    case sim::EventKind::Age:
        return SceneEventKind::Aged;
    case sim::EventKind::Collision:
        return SceneEventKind::Collided;
    case sim::EventKind::Death:
        return SceneEventKind::Died;
    case sim::EventKind::Host:
        break;
    }
    return SceneEventKind::Triggered;
}

} // namespace

/// Events of particles in the step that is complete, before instances leave the list of active ones.
void Scene::recordEvents()
{
    uint64_t kept = 0;
    const uint64_t all = world_.readCues(active_.slots(), [&](uint32_t place, const sim::CueEvent& cue) {
        const Instance& instance = instances_.at(active_.keys()[place]);
        SceneEvent event;
        event.kind = kindOf(cue.event.kind);
        event.cue = cue.cue;
        event.instance = instances_.idAt(active_.keys()[place]);
        event.userData = instance.setup.userData;
        event.tick = cue.tick;
        event.position = cue.position;
        event.velocity = cue.event.velocity;
        event.normal = cue.event.normal;
        event.speed = cue.event.speed;
        event.solver = cue.event.emitter;
        event.particle = cue.event.index;
        events_->add(event, instance.serial);
        ++kept;
    });
    events_->lose(all - kept);
}

uint32_t Scene::eventCount()
{
    if (!events_)
        return 0;
    if (!world_.isStepping() || world_.isPublishing())
        events_->closeStep(); // ends that no step has noticed
    return events_->count();
}

} // namespace fx::scene
