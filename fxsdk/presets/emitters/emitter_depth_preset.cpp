#include "fxsdk/presets/emitters/emitter_parts_preset.h"

#include "simulation/emitters/emitter_def.h"
#include "simulation/gpu_programs/gpu_program.h"

#include <algorithm>

namespace fx::preset {

namespace {

bool isDepth(const PresetValue& collision)
{
    std::string shape;
    collision.read("shape", shape);
    return shape == "depth";
}

} // namespace

void warnOfDepthOnCpu(const PresetValue& root, const sim::EffectDef& effect)
{
    const std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    for (size_t i = 0; i < std::min(root.size("emitters"), emitters.size()); ++i) {
        const sim::EmitterDef* const emitter = emitters[i];
        if (!emitter || !emitter->meetsDepth)
            continue;
        const std::string why(sim::gpuObstacle(*emitter));
        if (why.empty())
            continue;
        const PresetValue element = root.element("emitters", i);
        for (size_t k = 0; k < element.size("collisions"); ++k)
            if (const PresetValue collision = element.element("collisions", k); isDepth(collision))
                collision.warning("shape", "only the GPU meets what a view shows, and the CPU computes this "
                                           "emitter because " +
                                               why + ": its particles move freely");
    }
}

} // namespace fx::preset
