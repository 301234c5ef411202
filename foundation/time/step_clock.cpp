#include "foundation/time/step_clock.h"

#include "foundation/math/bits.h"

#include <algorithm>

namespace fx::base {

StepPlan StepClock::advance(double dt)
{
    StepPlan plan;
    plan.firstStep = simulated();
    if (!isFinite(dt) || dt < 0) {
        plan.refused = true;
        return plan;
    }
    const double longest = double(maxFrameTicks_);
    const double exact = std::min(dt * double(kTicksPerSecond), 1e18) + remainder_;
    const double kept = std::min(exact, longest);
    plan.droppedTicks = Ticks(std::min(exact - kept, 9e18));

    // dt = 1/60 is a whole number of ticks up to rounding; kept >= -0.5, so that cutting off is rounding down
    const Ticks whole = Ticks(kept + 0.5);
    remainder_ = kept - double(whole);
    now_ += whole;
    const int64_t most = maxFrameTicks_ / stepTicks_ + 1;
    plan.steps = uint32_t(std::min(now_ / stepTicks_ - steps_, most));
    steps_ += plan.steps;
    return plan;
}

Ticks StepClock::dropDebt(Ticks most)
{
    const Ticks excess = std::max<Ticks>(debt() - most, 0) / stepTicks_ * stepTicks_;
    now_ -= excess;
    return excess;
}

} // namespace fx::base
