/// @file pooled_emitter.h
/// Interface of small emitters to pools and spawn batches.
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

/// An emitter whose particles may be computed by a pool, and whose births and publication may be computed by
/// a SpawnBatch. See Solver::pooledEmitter().
class PooledEmitter
{
public:
    /// Joins a pool, which then computes the emitter until leavePool(). Until then, the emitter must not be
    /// stepped or published. All other functions of the emitter may be called. @return true if the emitter
    /// has joined a pool
    virtual bool joinPool(EmitterPools& pools, const PoolRequest& request) = 0;
    /// Copies the state from the pool and leaves the pool. The emitter is then stepped separately. Has no
    /// effect without a pool.
    virtual void leavePool() = 0;
    virtual const EmitterPool* pool() const = 0; ///< pool that computes the emitter; null: no pool
    virtual uint32_t member() const = 0;         ///< number of the emitter in the pool
    /// Publishes like Solver::publish(), but `spawnBatch` may fill the columns later. @return false, without
    /// any change, if the emitter does not support spawn batches
    virtual bool joinPublication(const base::GroupInfo& base, base::FrameSnapshot& snapshot,
                                 SpawnBatch& spawnBatch) const = 0;

    virtual ParticleStore& store() = 0;
    virtual const ParticleProgram& program() const = 0;
    virtual uint32_t highWater() const = 0; ///< maximum number of rows in use after a step
    virtual uint64_t dropped() const = 0;   ///< number of births whose row was occupied
    /// Sets the state that is not in the store when the emitter leaves a pool. The pool has already written
    /// the rows at local time `now`.
    virtual void takeBack(base::Ticks now, uint32_t highWater, uint64_t dropped) = 0;
    /// Counts births that were dropped because their row was occupied.
    virtual void refuse(uint64_t births, StepCounters& counters) = 0;
    /// Ends the open step after all its births have been written to their rows.
    virtual void endStep(StepCounters& counters) = 0;

protected:
    ~PooledEmitter() = default;
};

} // namespace fx::sim
