#include "fxsdk/cli/scene/instance_definition.h"

namespace fx::cli {

FxInstanceDef instanceDefinition(const scene_file::SceneInstance& instance, FxPresetId preset, double time)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    const base::Placement place = instance.placementAt(time);
    def.preset = preset;
    def.scale = instance.scale;
    for (int i = 0; i < 3; ++i) {
        def.position[i] = place.position[i];
        def.wind[i] = instance.parameters.wind[i];
        def.tint[i] = instance.parameters.tint[i];
    }
    def.rotation[0] = place.rotation.x;
    def.rotation[1] = place.rotation.y;
    def.rotation[2] = place.rotation.z;
    def.rotation[3] = place.rotation.w;
    def.seed = instance.seed;
    def.layer = instance.layer;
    def.sortKey = instance.sortKey;
    def.intensity = instance.parameters.intensity;
    def.emitting = scene_file::valueAt(instance.play.emitting, instance.start, 1.0) > 0.0 ? 1 : 0;
    return def;
}

} // namespace fx::cli
