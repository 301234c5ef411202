/// @file birth_kernel.h
/// Makes particles: draws their attributes and puts them into their rows.
#pragma once

#include "simulation/particles/birth.h"
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

/// A birth in one of many emitters of one definition.
struct ScatteredBirth
{
    ParticleStore* store;
    uint64_t seed;
    Birth birth;
    uint32_t row;  ///< its row by ParticleStore::rowOf()
    bool isStored; ///< out: false when its row was taken
};

/// The same for births in different emitters, with the same bits as for separate emitters. Births of one
/// emitter are in order and have different rows.
void storeScattered(const ParticleProgram& program, uint32_t solver, std::span<ScatteredBirth> births);

/// A birth in one emitter of many that share the rows of one store.
struct PooledBirth
{
    Birth row;      ///< index and tick as the store counts
    uint64_t index; ///< of the particle in its own emitter
    uint64_t seed;
};

/// The same for emitters that share a store. Indices ascend without gaps, and their rows are free.
void storePooled(const ParticleProgram& program, uint32_t solver, std::span<const PooledBirth> births,
                 ParticleStore& store);

} // namespace fx::sim
