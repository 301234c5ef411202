// The functions of fx_events.h.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_events.h"

#include <algorithm>

namespace {

using fx::base::Status;
using fx::scene::SceneEvent;
using fx::scene::SceneEventKind;

static_assert(int(FX_EVENT_FINISHED) == int(SceneEventKind::Finished));
static_assert(int(FX_EVENT_BORN) == int(SceneEventKind::Born));
static_assert(int(FX_EVENT_AGED) == int(SceneEventKind::Aged));
static_assert(int(FX_EVENT_COLLIDED) == int(SceneEventKind::Collided));
static_assert(int(FX_EVENT_DIED) == int(SceneEventKind::Died));
static_assert(int(FX_EVENT_TRIGGERED) == int(SceneEventKind::Triggered));
static_assert(FX_NO_CUE == fx::sim::kNoCue);

FxEvent toEvent(const FxScene& scene, const SceneEvent& event)
{
    FxEvent out{};
    out.kind = uint32_t(event.kind);
    out.instance.bits = scene.ids.encode(event.instance, fx::api::kInstanceIdType);
    out.userData = event.userData;
    out.tick = event.tick;
    out.seconds = fx::base::toSeconds(event.tick);
    const fx::api::HostWorld& world = scene.context->world;
    world.writePosition(event.position, out.position);
    world.writeVector(event.velocity, out.velocity);
    out.speed = world.fromMeters(event.speed);
    world.writeDirection(event.normal, out.normal);
    out.cue = event.cue;
    out.solver = event.solver;
    out.particle = event.particle;
    return out;
}

} // namespace

FxResult fxScene_GetEvents(FxScene* scene, FxEvent* ioEvents, uint32_t capacity, uint32_t* outCount,
                           uint64_t* outLost)
{
    return fx::api::insideScene("fxScene_GetEvents", scene, [&]() -> Status {
        if (!outCount)
            return fx::api::invalid("outCount is null");
        uint32_t count = scene->scene.eventCount();
        if (ioEvents && capacity > 0) {
            const uint32_t size = ioEvents->structSize;
            if (Status status = fx::api::checkStructSize<FxEvent>(size, "ioEvents"); !status)
                return status;
            count = std::min(count, capacity);
            auto* bytes = reinterpret_cast<unsigned char*>(ioEvents);
            scene->scene.takeEvents(count, [&](const SceneEvent& event) {
                auto* next = reinterpret_cast<FxEvent*>(bytes);
                next->structSize = size;
                static_cast<void>(fx::api::writeStruct(toEvent(*scene, event), next, "ioEvents")); // checked
                bytes += size;
            });
        } else if (ioEvents) {
            count = 0;
        }
        *outCount = count;
        if (outLost)
            *outLost = scene->scene.lostEvents();
        return {};
    });
}

FxResult fxScene_SetUserData(FxScene* scene, FxInstanceId instance, uint64_t userData)
{
    return fx::api::withInstance("fxScene_SetUserData", scene, instance,
                                 [&](fx::scene::LocalId id) -> Status {
                                     scene->scene.setUserData(id, userData);
                                     return {};
                                 });
}

FxResult fxScene_GetUserData(FxScene* scene, FxInstanceId instance, uint64_t* outUserData)
{
    return fx::api::withInstance("fxScene_GetUserData", scene, instance,
                                 [&](fx::scene::LocalId id) -> Status {
                                     if (!outUserData)
                                         return fx::api::invalid("outUserData is null");
                                     *outUserData = scene->scene.userData(id);
                                     return {};
                                 });
}
