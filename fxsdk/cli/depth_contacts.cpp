#include "fxsdk/cli/depth_contacts.h"

#include "simulation/emitters/emitter_def.h"
#include "simulation/emitters/gpu_program.h"

namespace fx::cli {
namespace {

bool shedsLight(const sim::SolverDef& solver)
{
    const auto* const emitter = dynamic_cast<const sim::EmitterDef*>(&solver);
    return !emitter || emitter->look.kind == sim::Appearance::Medium || emitter->light.given;
}

bool meetsDepth(const sim::SolverDef& solver)
{
    const auto* const emitter = dynamic_cast<const sim::EmitterDef*>(&solver);
    return emitter && emitter->meetsDepth && sim::gpuObstacle(*emitter).empty();
}

} // namespace

bool showsDepthContacts(const scene_file::SceneFile& file)
{
    bool isWanted = false;
    for (const scene_file::SceneInstance& instance : file.instances)
        for (const auto& solver : file.presets[instance.preset].effect->solvers) {
            if (shedsLight(*solver))
                return false;
            isWanted = isWanted || meetsDepth(*solver);
        }
    return isWanted;
}

} // namespace fx::cli
