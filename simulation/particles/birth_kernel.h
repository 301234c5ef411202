/// @file birth_kernel.h
/// Makes particles: draws their attributes and puts them into their rows.
#pragma once

#include "simulation/emitters/birth_schedule.h"
#include "simulation/particles/particle_store.h"

#include <span>

namespace fx::sim {

/// Whose random numbers are drawn.
struct BirthKey
{
    uint64_t seed;
    uint32_t solver;
};

/// Draws and stores `births`, at most as many as the store has rows, with ascending indices without gaps.
/// Those whose row is taken at the moment of birth are left out.
/// @return how many live
uint32_t storeBirths(const ParticleProgram& program, const BirthKey& key, std::span<const Birth> births,
                     ParticleStore& store);

} // namespace fx::sim
