/// @file support_search.h
/// Finds the support that encloses a fixed mass, by a bounded Newton iteration for equations (2) and (3) of
/// formula gas-density.
#pragma once

#include "foundation/math/elementary.h"

#include <cmath>
#include <cstdint>

namespace fx::sim {

/// The search of one particle's support. Until isDone(), the caller evaluates the sums S and D at support()
/// and passes them to tell().
template <class T>
class SupportSearch
{
public:
    /// Maximum number of evaluations in the search. The caller adds one evaluation at the result.
    static constexpr uint32_t kMaxEvaluations = 19;

    /// Starts a search in [bottom, top].
    /// @param want [kg] target value 3 N m / (4 pi) of S
    /// @param bottom, top [m] bounds of the support, 0 < bottom <= top
    /// @param guess [m] initial support, > 0
    SupportSearch(T want, T bottom, T top, T guess, T tolerance)
        : want_(want), bottom_(bottom), top_(top), low_(bottom), high_(top), tolerance_(tolerance),
          support_(guess < bottom ? bottom
                   : guess > top  ? top
                                  : guess)
    {}

    T support() const { return support_; }
    bool isDone() const { return done_; }
    bool isAtTop() const { return atTop_; }       ///< true: the solution exceeds `top`
    bool isAtBottom() const { return atBottom_; } ///< true: the solution is below `bottom`

    /// Passes the sums at support() and computes the next support.
    /// @param mass [kg] S at support()
    /// @param growth [kg] D at support()
    void tell(T mass, T growth)
    {
        const bool grows = mass < want_;
        (grows ? low_ : high_) = support_;
        atTop_ = grows && support_ >= top_;
        atBottom_ = !grows && support_ <= bottom_;
        ++evaluations_;
        if (atTop_ || atBottom_) {
            done_ = true;
            return;
        }
        const T next = proposal(mass, growth);
        if (isNewton(mass, growth) && isWithin(next, T(0.25) * tolerance_))
        { // its error is squared by the step
            support_ = next < bottom_ ? bottom_ : next > top_ ? top_ : next;
            done_ = true;
            return;
        }
        const T safe = inside(next, grows);
        done_ = isWithin(safe, tolerance_ * tolerance_) || evaluations_ >= kMaxEvaluations;
        support_ = safe;
    }

private:
    /// number of Newton steps after which the bracket is halved in every step
    static constexpr uint32_t kMaxProposals = 8;

    bool isNewton(T mass, T growth) const
    {
        return growth > T(0) && mass < T(2) * want_ && want_ < T(2) * mass;
    }
    /// True if the square of the relative change from support() to `next` is at most `square`.
    bool isWithin(T next, T square) const
    {
        const T change = next - support_;
        return change * change <= square * support_ * support_;
    }
    T proposal(T mass, T growth) const
    {
        if (isNewton(mass, growth))
            return support_ * (T(1) + (want_ - mass) / growth); // (3)
        if (!(growth > T(0)))                                   // no neighbor between here and the center
            return mass < want_ ? top_ : bottom_;
        return support_ * static_cast<T>(base::cubeRoot(static_cast<double>(want_ / mass))); // S grows as H^3
    }
    /// Returns `next` if it is inside of the bracket. If it is outside, returns a bound that has not been
    /// evaluated, or the middle of the bracket.
    T inside(T next, bool grows) const
    {
        if (evaluations_ < kMaxProposals) {
            if (next > low_ && next < high_)
                return next;
            if (grows && next >= top_ && high_ == top_)
                return top_;
            if (!grows && next <= bottom_ && low_ == bottom_)
                return bottom_;
        }
        return std::sqrt(low_) * std::sqrt(high_); // scales are unknown: the geometric mean
    }

    T want_;
    T bottom_, top_;
    T low_, high_; ///< [m] bounds of the bracket: S(low) < want <= S(high), if evaluated
    T tolerance_;
    T support_;
    uint32_t evaluations_ = 0;
    bool done_ = false;
    bool atTop_ = false;
    bool atBottom_ = false;
};

} // namespace fx::sim
