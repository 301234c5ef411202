#include "simulation/emitters/pools/emitter_pools.h"

#include <algorithm>
#include <new>

namespace fx::sim {

namespace {

constexpr uint32_t kMin = 4; // emitters that want to join in one step make a pool worth it

} // namespace

uint32_t EmitterPools::members() const
{
    uint32_t sum = 0;
    for (const std::unique_ptr<EmitterPool>& pool : pools_)
        sum += pool->members();
    return sum;
}

size_t EmitterPools::indexOf(const EmitterPool& pool) const
{
    size_t index = 0;
    for (const std::unique_ptr<EmitterPool>& other : pools_) {
        if (other.get() == &pool)
            break;
        index += other->empty() ? 0 : 1;
    }
    return index;
}

void EmitterPools::publish(base::KindId kind, base::TaskRunner& tasks, base::FrameSnapshot& snapshot) const
{
    for (const std::unique_ptr<EmitterPool>& pool : pools_)
        if (!pool->empty()) // the definition of an empty one may be gone
            pool->publish(kind, tasks, snapshot);
}

EmitterPool* EmitterPools::offer(const std::shared_ptr<const ParticleProgram>& program, const glm::vec3& pull,
                                 uint64_t step)
{
    for (const std::unique_ptr<EmitterPool>& pool : pools_)
        if (pool->fits(*program, pull)) {
            const bool isWorth = pool->offer(step) >= kMin || !pool->empty();
            return isWorth ? pool.get() : nullptr;
        }
    try {
        forgetEmpty(step);
        pools_.push_back(std::make_unique<EmitterPool>(program, pull, revision_, memory_));
        pools_.back()->offer(step);
    } catch (const std::bad_alloc&) {
        // they go on by themselves
    }
    return nullptr;
}

void EmitterPools::forgetEmpty(uint64_t step)
{
    const auto isOld = [step](const auto& pool) { return pool->empty() && pool->offered() + 1 < step; };
    if (std::erase_if(pools_, isOld) > 0)
        ++revision_; // others have their places
}

void EmitterPools::step(base::Ticks to, StepCounters& counters, std::vector<uint32_t>& outLeft)
{
    for (const std::unique_ptr<EmitterPool>& pool : pools_)
        if (!pool->empty())
            pool->step(to, counters, outLeft);
    now_ = to;
}

} // namespace fx::sim
