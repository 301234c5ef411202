// What an emitter's capacity has to hold.
#include "fxsdk/presets/emitters/emitter_parts_preset.h"

#include "fxsdk/presets/emitters/birth_count.h"

#include <cmath>
#include <string>
#include <vector>

namespace fx::preset {

namespace {

constexpr double kRoundedDown = 1.0 - 1e-6; // by more than floats are rounded up

} // namespace

void lintCapacity(const PresetValue& root, const sim::EffectDef& effect)
{
    std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    emitters.resize(root.size("emitters")); // they are the first solvers
    BirthCount count(emitters);
    for (size_t i = 0; i < emitters.size(); ++i) {
        const PresetValue element = root.element("emitters", i);
        const double alive = std::ceil(count.alive(i) * kRoundedDown);
        if (alive > double(emitters[i]->maxParticles))
            element.warning("maxParticles", (emitters[i]->fed ? "about " : "up to ") +
                                                std::to_string(uint64_t(alive)) + " particles can be alive" +
                                                (emitters[i]->fed ? ", those of events counted," : ",") +
                                                " but " + std::to_string(emitters[i]->maxParticles) +
                                                " is the capacity: births beyond it are dropped");
    }
}

} // namespace fx::preset
