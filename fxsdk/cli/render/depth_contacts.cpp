#include "fxsdk/cli/render/depth_contacts.h"

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"

#include <algorithm>
#include <vector>

namespace fx::cli {
namespace {

bool meetsDepth(const sim::EffectDef& effect)
{
    const std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    return std::any_of(emitters.begin(), emitters.end(), [](const sim::EmitterDef* emitter) {
        return emitter && emitter->meetsDepth && sim::gpuObstacle(*emitter).empty();
    });
}

} // namespace

bool showsDepthContacts(const scene_file::SceneFile& file)
{
    bool isWanted = false;
    for (const scene_file::SceneInstance& instance : file.instances) {
        const sim::EffectDef& effect = *file.presets[instance.preset].effect;
        if (effect.publishes(base::kBlobKind) || effect.publishes(base::kLightKind))
            return false;
        isWanted = isWanted || meetsDepth(effect);
    }
    return isWanted;
}

} // namespace fx::cli
