/// @file emitter_motion.h
/// How emitted particles are made and moved, range by range, so that threads can share the work.
#pragma once

#include "simulation/emitters/emitter_def.h"
#include "simulation/emitters/emitter_store.h"
#include "simulation/motion/curl_noise.h"

#include <span>

namespace fx::sim {

/// What all particles of a step have in common.
struct EmitterStep
{
    EmitterStep(const EmitterDef& definition, const StepContext& context);

    const EmitterDef& def;
    const StepContext& step;
    base::Ticks end; ///< local time at which the step ends
    glm::vec3 wind;  ///< [m/s] effect's, host's and emitter's
    CurlNoise noise;
};

/// Room for intermediate values of a step, one element a particle.
struct EmitterScratch
{
    std::span<glm::vec3> air; ///< [m/s] velocity of the air at the particle
    std::span<float> weight;  ///< [1] multiple of gravity that acts on it
};

/// Draws the attributes of the rows [begin, end), whose index and birth tick are set.
void createParticles(const EmitterStep& step, EmitterStore& store, uint32_t begin, uint32_t end);

/// Moves the rows [begin, end) to the end of the step: a row older than the step through all of it, a row
/// born within the step through what is left after its birth.
void moveParticles(const EmitterStep& step, EmitterStore& store, const EmitterScratch& scratch,
                   uint32_t begin, uint32_t end);

/// Where in its life row `i` is at local time `tick`, 0 at birth, 1 at death.
float lifeFraction(const EmitterStore& store, uint32_t i, base::Ticks tick);

} // namespace fx::sim
