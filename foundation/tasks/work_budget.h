/// @file work_budget.h
/// Limit of the work of one update. Work is counted, not timed. Therefore equal calls stop at the same point
/// on every machine and with any number of threads.
///
/// The unit is about 10 ns of one processor core of the year 2020: a particle that a force moves costs one or
/// a few units. The units of each kind of work were fitted with `fx bench work-units`, see
/// docs/howto/bounded-updates.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fx::base {

constexpr uint64_t kNoWorkLimit = UINT64_MAX;
constexpr double kSecondsPerUnit = 10e-9; ///< [s] approximate time of a unit

/// The remaining number of work units. Work that has begun continues to the next point where it can be
/// interrupted. Therefore the last piece of work may cost more than the remaining units.
class WorkBudget
{
public:
    explicit WorkBudget(uint64_t granted = kNoWorkLimit) : left_(granted) {}

    void spend(uint64_t units)
    {
        spent_ += units;
        if (left_ != kNoWorkLimit)
            left_ -= std::min(left_, units);
    }
    bool isSpent() const { return left_ == 0; }
    uint64_t left() const { return left_; }
    /// Number of items, at most `most`, that can be started before the budget is used up, if each item costs
    /// `each` units.
    uint32_t affords(double each, uint32_t most) const
    {
        const double things = std::ceil(double(left_) / each);
        return things < double(most) ? uint32_t(things) : most;
    }
    uint64_t spent() const { return spent_; }

private:
    uint64_t left_;
    uint64_t spent_ = 0;
};

} // namespace fx::base
