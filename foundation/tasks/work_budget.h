/// @file work_budget.h
/// How much work one update may do, counted and not timed: the same calls stop at the same place on every
/// machine, with any number of threads.
///
/// The unit is about 10 ns of one core of 2020: a particle that a force moves costs one or a few of them.
/// What each piece of work counts was fitted with `fx bench work-units`, see
/// docs/howto/bounded-updates.md.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fx::base {

constexpr uint64_t kNoWorkLimit = UINT64_MAX;
constexpr double kSecondsPerUnit = 10e-9; ///< [s] of a unit, about

/// Units that are left of those that were granted. What is begun is brought to the next place where it can
/// rest, so the last piece may cost more than is left.
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
    /// How many of `most` things that count `each` units are begun before nothing is left.
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
