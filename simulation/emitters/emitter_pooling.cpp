// How an emitter joins a pool and leaves it.
#include "simulation/emitters/emitter_solver.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr uint32_t kMaxRows = base::PooledRows::kMaxGroupRows; // more fill vectors by themselves
constexpr float kMaxLifetimeRatio = 4.0f; // longest over shortest life: rows of the dead are in the way
constexpr float kSmallestRadius = 1e-6f;  // [m] a row with 0 is empty
constexpr base::Ticks kFirst = 1024;      // see joinPool()

} // namespace

/// Whether its definition lets it share rows with others.
bool EmitterSolver::isPoolable() const
{
    const base::Range& life = def_.lifetime;
    const bool isEven = life.min > 0.0f && std::max(life.min, life.max) <= kMaxLifetimeRatio * life.min;
    const float smallest = std::min(def_.radius.min, def_.radius.max);
    return bornWithMany_ && publishesWithMany_ && isEven && smallest >= kSmallestRadius &&
           store_.capacity() <= kMaxRows && def_.emission.bursts.empty();
}

/// Particles that were there when motion began, or when it began anew, have moved for less than their age or
/// for as long but for rounding: as long as such live it stays by itself.
bool EmitterSolver::joinPool(EmitterPools& pools, const PoolRequest& request)
{
    if (!poolable_ || pool_ || !started_ || key_.solver != 0 || store_.empty() ||
        store_.placed != program_.stores[stored::X] || now_ != request.now + request.offset ||
        store_.next() - store_.front() > 2 * uint64_t(store_.capacity()))
        return false;
    const base::Ticks oldest = store_.born[store_.rowOf(store_.front())];
    if (oldest - motionBegin_ <= kFirst + (program_.longestLife >> 20))
        return false;
    const auto births = schedule_.evenBirths(now_, double(conditions_.intensity), conditions_.emitting);
    if (!births || births->stride < kLongestPoolStep / base::Ticks(store_.capacity()))
        return false;
    EmitterPool* const pool = pools.offer(shared_, conditions_.pull, request.step);
    if (!pool)
        return false;
    const uint32_t member =
        pool->admit({this, request.user, key_.seed, request.offset, *births, schedule_.end()}, request.now);
    if (member == EmitterPool::kNoMember)
        return false;
    pool_ = pool;
    member_ = member;
    return true;
}

void EmitterSolver::leavePool()
{
    if (!pool_)
        return;
    pool_->write(member_);
    pool_->forget(member_);
    pool_ = nullptr;
}

void EmitterSolver::takeBack(base::Ticks now, uint32_t highWater, uint64_t dropped)
{
    const BirthWindow passed{now_, now, double(conditions_.intensity), conditions_.emitting};
    schedule_.passTo(now_);
    if (now > now_)
        static_cast<void>(schedule_.advance(passed, {}));
    now_ = now;
    highWater_ = highWater;
    dropped_ = dropped;
}

} // namespace fx::sim
