/// @file pooled_emitter.h
/// Interface of small emitters for pools and spawn batches.
#pragma once

#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/time/ticks.h"

#include <cstdint>

namespace fx::sim {

class SpawnBatch;
class EmitterPool;
class EmitterPools;
class ParticleStore;
struct ParticleProgram;
struct PoolRequest;
struct StepCounters;

/// An emitter whose particles a pool may compute, and whose births and publication a spawnBatch may. See
/// Solver::pooledEmitter().
class PooledEmitter
{
public:
    /// Joins a pool of emitters, which computes it from then on until it leaves: meanwhile it is neither
    /// stepped nor published, and all other questions are answered as ever. @return whether it has joined
    virtual bool joinPool(EmitterPools& pools, const PoolRequest& request) = 0;
    /// Copies its state from the pool and leaves the pool; it is then stepped separately. Does nothing
    /// without a pool.
    virtual void leavePool() = 0;
    virtual const EmitterPool* pool() const = 0; ///< that computes it now, null for none
    virtual uint32_t member() const = 0;         ///< its number in that pool
    /// Solver::publish(), but the columns may be filled later by `spawnBatch`. @return false without any
    /// change when the emitter does not support it
    virtual bool joinPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                 SpawnBatch& spawnBatch) const = 0;

    virtual ParticleStore& store() = 0;
    virtual const ParticleProgram& program() const = 0;
    virtual uint32_t highWater() const = 0; ///< the most rows that were in use after a step
    virtual uint64_t dropped() const = 0;   ///< births that found their row taken
    /// The pool has written the rows of `now`, local time, into the store; the rest of the state follows.
    virtual void takeBack(base::Ticks now, uint32_t highWater, uint64_t dropped) = 0;
    /// Number of births whose row was occupied.
    virtual void refuse(uint64_t births, StepCounters& counters) = 0;
    /// All births of the open step are in their rows.
    virtual void endStep(StepCounters& counters) = 0;

protected:
    ~PooledEmitter() = default;
};

} // namespace fx::sim
