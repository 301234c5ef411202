/// @file emitter_pools.h
/// All emitter pools of a world.
#pragma once

#include "simulation/emitters/pools/emitter_pool.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <vector>

namespace fx::sim {

/// Request of an emitter to join a pool. The emitter has been stepped to `now`.
struct PoolRequest
{
    uint32_t user;      ///< see PoolEntry
    uint64_t step;      ///< number of the last step of the emitter
    base::Ticks now;    ///< time of the pool to which the emitter has been stepped
    base::Ticks offset; ///< local time of the emitter minus the time of the pool
};

/// [tick] Longest step of pools. In longer steps, emitters are stepped separately, because ages must fit into
/// 32 bits.
constexpr base::Ticks kLongestPoolStep = base::kTicksPerSecond / 16;

/// The pools of all emitters of a world. Threads: one at a time.
class EmitterPools
{
public:
    explicit EmitterPools(std::pmr::memory_resource* memory) : memory_(memory) {}

    /// Revision, which is incremented when a member is added or removed.
    uint64_t revision() const { return revision_; }
    bool empty() const { return pools_.empty() || members() == 0; }
    uint32_t members() const;
    base::Ticks now() const { return now_; } ///< time at which the last step ended
    /// Publishes all pools that have members.
    void publish(base::KindId kind, base::TaskRunner& tasks, base::FrameSnapshot& snapshot) const;
    size_t indexOf(const EmitterPool& pool) const; ///< index among the pools with members

    /// Returns the pool that an emitter may join now: a pool that already has members, or a new pool if
    /// enough emitters request a pool in this step. Null if there is no such pool, or if memory is exhausted.
    EmitterPool* offer(const std::shared_ptr<const ParticleProgram>& program, const glm::vec3& pull,
                       uint64_t step);
    /// @param outLeft see EmitterPool::step()
    void step(base::Ticks to, StepCounters& counters, std::vector<uint32_t>& outLeft);
    /// Calls f(emitter, user) for all members; f may remove members.
    template <class F>
    void forEach(F&& f)
    {
        for (const std::unique_ptr<EmitterPool>& pool : pools_)
            pool->forEach(f);
    }

private:
    void forgetEmpty(uint64_t step);

    std::pmr::memory_resource* memory_;
    uint64_t revision_ = 1;
    base::Ticks now_ = 0;
    std::vector<std::unique_ptr<EmitterPool>> pools_;
};

} // namespace fx::sim
