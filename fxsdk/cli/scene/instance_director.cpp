#include "fxsdk/cli/scene/instance_director.h"

#include "fxsdk/cli/scene/api_status.h"

namespace fx::cli {
namespace {

/// Counts on over what is due; true when there was any of it.
template <class Timed>
bool takeDue(const std::vector<Timed>& list, base::Ticks due, size_t& next)
{
    const size_t before = next;
    while (next < list.size() && base::toTicks(list[next].time) < due)
        ++next;
    return next > before;
}

} // namespace

void InstanceDirector::add(const scene_file::SceneInstance& instance, FxInstanceId id)
{
    if (!instance.play.isEmpty())
        roles_.push_back({instance, id, 0, 0, 0, 0, instance.placementAt(instance.start)});
}

base::Status InstanceDirector::beforeStep(FxScene* scene, base::Ticks from, base::Ticks to)
{
    for (Role& role : roles_)
        if (base::Status status = play(scene, role, from + (to - from) / 2, to); !status)
            return status;
    return {};
}

/// A jump is taken under the emission and at the place before it, what is said comes after it.
base::Status InstanceDirector::play(FxScene* scene, Role& role, base::Ticks due, base::Ticks to)
{
    FxInstanceState state = FX_INSTANCE_DORMANT;
    if (base::Status status = toStatus(fxScene_GetInstanceState(scene, role.id, &state, nullptr)); !status)
        return status;
    if (state == FX_INSTANCE_FINISHED)
        return {};
    const bool hasStarted = state != FX_INSTANCE_DORMANT;
    base::Status status = hasStarted ? jump(scene, role, due) : base::Status();
    if (status.ok())
        status = change(scene, role, due, hasStarted);
    if (status.ok() && to > base::toTicks(role.instance.start))
        status = move(scene, role, to);
    if (status.ok() && hasStarted)
        status = tell(scene, role, due);
    return status;
}

base::Status InstanceDirector::jump(FxScene* scene, Role& role, base::Ticks due)
{
    const auto& jumps = role.instance.play.jumps;
    return takeDue(jumps, due, role.jumps)
               ? toStatus(fxScene_SeekInstance(scene, role.id, jumps[role.jumps - 1].to))
               : base::Status();
}

base::Status InstanceDirector::change(FxScene* scene, Role& role, base::Ticks due, bool hasStarted)
{
    const scene_file::InstancePlay& play = role.instance.play;
    if (takeDue(play.speed, due, role.speeds)) {
        const float speed = float(play.speed[role.speeds - 1].value);
        if (base::Status status = toStatus(fxScene_SetInstanceSpeed(scene, role.id, speed)); !status)
            return status;
    }
    if (!hasStarted || !takeDue(play.emitting, due, role.switches))
        return {};
    FxInstanceParameters parameters = fxDefaultInstanceParameters();
    parameters.intensity = role.instance.parameters.intensity;
    for (int i = 0; i < 3; ++i) {
        parameters.wind[i] = role.instance.parameters.wind[i];
        parameters.tint[i] = role.instance.parameters.tint[i];
    }
    parameters.emitting = play.emitting[role.switches - 1].value > 0.0 ? 1 : 0;
    return toStatus(fxScene_SetParameters(scene, role.id, &parameters));
}

base::Status InstanceDirector::move(FxScene* scene, Role& role, base::Ticks to)
{
    const base::Placement place = role.instance.placementAt(base::toSeconds(to));
    if (place.position == role.place.position && place.rotation == role.place.rotation)
        return {};
    role.place = place;
    const double position[3] = {place.position.x, place.position.y, place.position.z};
    const float rotation[4] = {place.rotation.x, place.rotation.y, place.rotation.z, place.rotation.w};
    return toStatus(fxScene_SetTransform(scene, role.id, position, rotation, place.scale));
}

base::Status InstanceDirector::tell(FxScene* scene, Role& role, base::Ticks due)
{
    const auto& triggers = role.instance.play.triggers;
    size_t next = role.triggers;
    takeDue(triggers, due, role.triggers);
    for (; next < role.triggers; ++next) {
        const scene_file::Trigger& said = triggers[next];
        const FxResult result = fxScene_TriggerEvent(scene, role.id, said.name.c_str(), said.count);
        if (result != FX_OK)
            return toStatus(result);
    }
    return {};
}

} // namespace fx::cli
