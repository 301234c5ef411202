#include "fxsdk/scene/motion_history.h"

#include "simulation/world/instance_clock.h"

#include <glm/common.hpp>

#include <algorithm>

namespace fx::scene {

void BoundsInputs::add(const BoundsInputs& more)
{
    low = glm::min(low, more.low);
    high = glm::max(high, more.high);
    smallest = std::min(smallest, more.smallest);
    largest = std::max(largest, more.largest);
    wind = std::max(wind, more.wind);
    localWind = std::max(localWind, more.localWind);
    speed = std::max(speed, more.speed);
    slowest = std::min(slowest, more.slowest);
}

void MotionHistory::note(base::Ticks now, const BoundsInputs& is, float seconds)
{
    const double passed = base::toSeconds(std::max<base::Ticks>(now - begun_, 0)) *
                          (double(newer_.slowest) / double(sim::kNormalRate));
    if (newer_.largest > 0.0f && passed > double(seconds)) {
        older_ = newer_;
        newer_ = last_; // it was so until now
        begun_ = now;
        unknown_ = std::max(unknown_ - 1, 0);
    } else if (!(newer_.largest > 0.0f)) {
        begun_ = now;
    }
    newer_.add(is);
    last_ = is;
}

bool MotionHistory::isSettled() const
{
    return isKnown() && newer_ == last_ && (!(older_.largest > 0.0f) || older_ == last_);
}

BoundsInputs MotionHistory::all() const
{
    BoundsInputs all = older_;
    all.add(newer_);
    return all;
}

} // namespace fx::scene
