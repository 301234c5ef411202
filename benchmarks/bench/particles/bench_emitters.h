/// @file bench_emitters.h
/// The emitters that fx bench measures.
#pragma once

#include "simulation/solver/effect_def.h"

#include <cstdint>
#include <memory>
#include <string_view>

namespace fx::cli {

/// An effect with one emitter, which has `count` particles after a few seconds. Births then replace dead
/// particles. Variants, each with the features of the variant before:
///   lean     gravity, drag; color, opacity and size over life
///   typical  births in a cone above a disc, random lifetimes and sizes, wind, rotation, flipbook frames
///   heavy    turbulence, ground, appearance over speed
/// @param gpu true: the emitter prefers the GPU
/// @param depth true: the particles collide with a depth texture
std::shared_ptr<const sim::EffectDef> benchEffect(std::string_view variant, uint32_t count, bool gpu = false,
                                                  bool depth = false);

/// [s] Time after which the number of particles is constant.
constexpr double kSteadyAfter = 3.2;

/// [byte] Data that a step reads and writes per particle, see particle_program.h.
double bytesPerParticle(const sim::EffectDef& effect);

} // namespace fx::cli
