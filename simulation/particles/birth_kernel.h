/// @file birth_kernel.h
/// Creates particles: draws random attributes and writes the particles to their rows.
#pragma once

#include "simulation/particles/birth.h"
#include "simulation/particles/particle_store.h"

#include <span>

namespace fx::sim {

/// Key of the random numbers of one emitter of an instance.
struct BirthKey
{
    uint64_t seed;
    uint32_t solver;
};

/// Draws and stores `births`, at most as many as the store has rows, with consecutive ascending indices. A
/// birth is omitted if its row is occupied at its birth tick.
/// @return number of stored births
uint32_t storeBirths(const ParticleProgram& program, const BirthKey& key, std::span<const Birth> births,
                     ParticleStore& store);

/// A birth in one of many emitters of one definition.
struct ScatteredBirth
{
    ParticleStore* store;
    uint64_t seed;
    Birth birth;
    uint32_t row;  ///< row of the birth by ParticleStore::rowOf()
    bool isStored; ///< result: false if the row was occupied
};

/// Draws and stores births in different emitters, with the same bits as storeBirths() for each emitter. The
/// births of one emitter are in order and have different rows.
void storeScattered(const ParticleProgram& program, uint32_t solver, std::span<ScatteredBirth> births);

/// A birth in one of many emitters that share the rows of one store.
struct PooledBirth
{
    Birth row;      ///< index and tick of the birth in the shared store
    uint64_t index; ///< index of the particle in its own emitter
    uint64_t seed;
};

/// Draws and stores births of emitters that share a store. Indices are consecutive and ascending. The rows
/// must be free.
void storePooled(const ParticleProgram& program, uint32_t solver, std::span<const PooledBirth> births,
                 ParticleStore& store);

} // namespace fx::sim
