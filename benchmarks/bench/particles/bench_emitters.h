/// @file bench_emitters.h
/// The emitters that fx bench measures.
#pragma once

#include "simulation/solver/effect_def.h"

#include <cstdint>
#include <memory>
#include <string_view>

namespace fx::cli {

/// An effect of one emitter that has `count` particles after a few seconds and replaces dead ones. lean:
/// gravity, drag, color, opacity and size over life. typical: born in a cone from a disc, lives and sizes
/// drawn from ranges, wind, rotation, flip-book frames. heavy: turbulence, ground, appearance over speed.
/// @param gpu they prefer the GPU
/// @param depth and collide with a depth texture
std::shared_ptr<const sim::EffectDef> benchEffect(std::string_view variant, uint32_t count, bool gpu = false,
                                                  bool depth = false);

/// [s] after which the number of particles is steady.
constexpr double kSteadyAfter = 3.2;

/// [byte] that have to be read and written for each particle in a step, see particle_program.h.
double bytesPerParticle(const sim::EffectDef& effect);

} // namespace fx::cli
