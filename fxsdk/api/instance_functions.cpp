// The functions of fx_scene.h that concern one instance.
#include "fxsdk/api/parameter_limits.h"
#include "fxsdk/api/placement.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

#include <limits>
#include <string>

namespace {

using fx::api::HostWorld;
using fx::base::Code;
using fx::base::Status;

static_assert(int(FX_INSTANCE_DORMANT) == int(fx::scene::InstanceState::Dormant));
static_assert(int(FX_INSTANCE_ACTIVE) == int(fx::scene::InstanceState::Active));
static_assert(int(FX_QUALITY_REFERENCE) - int(FX_QUALITY_LOW) == int(fx::sim::QualityLevel::Reference));
static_assert(int(FX_INSTANCE_FINISHED) == int(fx::scene::InstanceState::Finished));
static_assert(int(FX_INSTANCE_WAKING) == int(fx::scene::InstanceState::Waking));
static_assert(int(FX_INSTANCE_RESTING) == int(fx::scene::InstanceState::Resting));
static_assert(int(FX_INSTANCE_HIDDEN) == int(fx::scene::InstanceState::Hidden));

/// Latest start: far enough from the end of int64_t that no sum of steps overflows.
constexpr int64_t kLatestStart = std::numeric_limits<int64_t>::max() / 4;

void checkParameters(const HostWorld& world, fx::api::Checks& check, float intensity, const float* wind,
                     uint32_t emitting, const float* tint)
{
    check.range(intensity, 0.0f, fx::api::kHighestIntensity, "intensity");
    const float strongest = world.fromMeters(fx::api::kStrongestWind);
    check.range3(wind, -strongest, strongest, "wind");
    check.flag(emitting, "emitting");
    check.range3(tint, 0.0f, fx::api::kHighestTint, "tint");
}

fx::sim::InstanceParameters toParameters(const HostWorld& world, float intensity, const float* wind,
                                         uint32_t emitting, const float* tint)
{
    return {intensity, world.vector(wind), emitting != 0, {tint[0], tint[1], tint[2]}};
}

static_assert(FX_LOWEST_LAYER == fx::scene::kLowestLayer && FX_HIGHEST_LAYER == fx::scene::kHighestLayer);

void checkLayer(fx::api::Checks& check, int32_t layer, const char* name)
{
    check.range(layer, FX_LOWEST_LAYER, FX_HIGHEST_LAYER, name);
}

Status checkDef(const HostWorld& world, const FxInstanceDef& def)
{
    fx::api::Checks check;
    fx::api::checkPlacement(check, world.fromMeters(fx::api::kFarthest), def.position, def.rotation,
                            def.scale);
    checkParameters(world, check, def.intensity, def.wind, def.emitting, def.tint);
    check.range(def.startTick, int64_t(0), kLatestStart, "def.startTick");
    check.flag(def.destroyWhenFinished, "def.destroyWhenFinished");
    fx::api::checkQuality(check, def.quality, "def.quality");
    check.range(def.reserved, 0u, 0u, "def.reserved");
    check.range(def.reserved2, 0u, 0u, "def.reserved2");
    check.range(def.reserved3, 0u, 0u, "def.reserved3");
    checkLayer(check, def.layer, "def.layer");
    return check.status();
}

} // namespace

FxResult fxScene_CreateInstance(FxScene* scene, const FxInstanceDef* def, FxInstanceId* outInstance)
{
    return fx::api::insideScene("fxScene_CreateInstance", scene, [&]() -> Status {
        if (!outInstance)
            return fx::api::invalid("outInstance is null");
        FxInstanceDef known;
        if (Status status = fx::api::readStruct(def, "def", fxDefaultInstanceDef(), known); !status)
            return status;
        const HostWorld& world = scene->context->world;
        if (Status status = checkDef(world, known); !status)
            return status;
        auto effect = scene->context->findPreset(known.preset);
        if (!effect)
            return effect.status();

        fx::scene::InstanceSetup setup;
        setup.effect = std::move(*effect);
        setup.seed = known.seed;
        setup.userData = known.userData;
        setup.startTick = known.startTick;
        setup.placement = fx::api::toPlacement(world, known.position, known.rotation, known.scale);
        setup.parameters = toParameters(world, known.intensity, known.wind, known.emitting, known.tint);
        setup.destroyWhenFinished = known.destroyWhenFinished != 0;
        setup.quality = fx::api::toQuality(known.quality, scene->quality);
        const fx::scene::LocalId id =
            scene->scene.add(std::move(setup), {known.visibilityMask, known.layer, known.sortKey});
        if (id == 0)
            return {Code::Capacity, "the scene has as many instances as its definition allows"};
        outInstance->bits = scene->ids.encode(id, fx::api::kInstanceIdType);
        return {};
    });
}

FxResult fxScene_DestroyInstance(FxScene* scene, FxInstanceId instance)
{
    return fx::api::withInstance("fxScene_DestroyInstance", scene, instance,
                                 [&](fx::scene::LocalId id) -> Status {
                                     scene->scene.remove(id);
                                     return {};
                                 });
}

FxResult fxScene_DestroyAllInstances(FxScene* scene)
{
    return fx::api::insideScene("fxScene_DestroyAllInstances", scene, [&]() -> Status {
        std::pmr::vector<fx::scene::LocalId> all(&scene->context->memory);
        all.reserve(scene->scene.counters().instances); // nothing is removed if memory is missing
        scene->scene.forEach([&](fx::scene::LocalId id) { all.push_back(id); });
        for (const fx::scene::LocalId id : all)
            scene->scene.remove(id);
        return {};
    });
}

uint32_t fxScene_IsValid(FxScene* scene, FxInstanceId instance)
{
    if (!scene || !scene->caller.thread.isCaller() || scene->caller.busy())
        return 0;
    return scene->scene.contains(scene->ids.decode(instance.bits, fx::api::kInstanceIdType)) ? 1 : 0;
}

FxResult fxScene_GetInstances(FxScene* scene, FxInstanceId* outInstances, uint32_t capacity,
                              uint32_t* outCount)
{
    return fx::api::insideScene("fxScene_GetInstances", scene, [&]() -> Status {
        if (!outCount)
            return fx::api::invalid("outCount is null");
        const uint32_t count = scene->scene.counters().instances;
        if (outInstances && capacity < count)
            return {Code::Capacity, "the scene has " + std::to_string(count) + " instances"};
        if (outInstances)
            scene->scene.forEach([&, next = outInstances](fx::scene::LocalId id) mutable {
                (next++)->bits = scene->ids.encode(id, fx::api::kInstanceIdType);
            });
        *outCount = count;
        return {};
    });
}

FxResult fxScene_GetInstanceState(FxScene* scene, FxInstanceId instance, FxInstanceState* outState,
                                  uint32_t* outParticles)
{
    return fx::api::withInstance(
        "fxScene_GetInstanceState", scene, instance, [&](fx::scene::LocalId id) -> Status {
            const fx::scene::InstanceState state = scene->scene.state(id);
            if (outState)
                *outState = FxInstanceState(state);
            if (outParticles)
                *outParticles = scene->scene.contains(id) ? scene->scene.particles(id) : 0;
            return {};
        });
}

FxResult fxScene_SetTransform(FxScene* scene, FxInstanceId instance, const double position[3],
                              const float rotation[4], float scale)
{
    return fx::api::withInstance(
        "fxScene_SetTransform", scene, instance, [&](fx::scene::LocalId id) -> Status {
            fx::api::Checks check;
            check.notNull(position, "position");
            check.notNull(rotation, "rotation");
            if (!check.status())
                return check.status();
            const HostWorld& world = scene->context->world;
            fx::api::checkPlacement(check, world.fromMeters(fx::api::kFarthest), position, rotation, scale);
            if (check.status())
                scene->scene.setPlacement(id, fx::api::toPlacement(world, position, rotation, scale));
            return check.status();
        });
}

FxResult fxScene_SetParameters(FxScene* scene, FxInstanceId instance, const FxInstanceParameters* parameters)
{
    return fx::api::withInstance(
        "fxScene_SetParameters", scene, instance, [&](fx::scene::LocalId id) -> Status {
            FxInstanceParameters known;
            if (Status status =
                    fx::api::readStruct(parameters, "parameters", fxDefaultInstanceParameters(), known);
                !status)
                return status;
            const HostWorld& world = scene->context->world;
            fx::api::Checks check;
            checkParameters(world, check, known.intensity, known.wind, known.emitting, known.tint);
            if (check.status())
                scene->scene.setParameters(
                    id, toParameters(world, known.intensity, known.wind, known.emitting, known.tint));
            return check.status();
        });
}

FxResult fxScene_TriggerEvent(FxScene* scene, FxInstanceId instance, const char* name, uint32_t count)
{
    return fx::api::withInstance(
        "fxScene_TriggerEvent", scene, instance, [&](fx::scene::LocalId id) -> Status {
            fx::api::Checks check;
            check.notNull(name, "name");
            if (count > 65536)
                return fx::api::invalid("count is above 65536");
            return check.status() ? scene->scene.postEvent(id, name, count) : check.status();
        });
}

FxResult fxScene_SetVisibilityMask(FxScene* scene, FxInstanceId instance, uint32_t mask)
{
    return fx::api::withInstance("fxScene_SetVisibilityMask", scene, instance,
                                 [&](fx::scene::LocalId id) -> Status {
                                     scene->scene.setVisibilityMask(id, mask);
                                     return {};
                                 });
}

FxResult fxScene_SetLayer(FxScene* scene, FxInstanceId instance, int32_t layer, int32_t sortKey)
{
    return fx::api::withInstance("fxScene_SetLayer", scene, instance, [&](fx::scene::LocalId id) -> Status {
        fx::api::Checks check;
        checkLayer(check, layer, "layer");
        if (check.status())
            scene->scene.setLayer(id, layer, sortKey);
        return check.status();
    });
}

FxResult fxScene_SetInstanceSpeed(FxScene* scene, FxInstanceId instance, float speed)
{
    return fx::api::withInstance("fxScene_SetInstanceSpeed", scene, instance,
                                 [&](fx::scene::LocalId id) -> Status {
                                     fx::api::Checks check;
                                     check.range(speed, 0.0f, fx::api::kHighestSpeed, "speed");
                                     if (check.status())
                                         scene->scene.setRate(id, fx::api::toRate(speed));
                                     return check.status();
                                 });
}

FxResult fxScene_SeekInstance(FxScene* scene, FxInstanceId instance, double seconds)
{
    return fx::api::withInstance("fxScene_SeekInstance", scene, instance,
                                 [&](fx::scene::LocalId id) -> Status {
                                     if (!(seconds >= 0.0 && seconds <= 86400.0))
                                         return fx::api::invalid("seconds is not within 0 and 86400");
                                     return scene->scene.seek(id, fx::base::toTicks(seconds));
                                 });
}
