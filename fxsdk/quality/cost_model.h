/// @file cost_model.h
/// Converts relative costs of techniques to milliseconds of the present scene, fitted to measured frames.
#pragma once

#include "fxsdk/quality/scalability_levels.h"

#include <array>

namespace fx::quality {

/// Scale of each technique: milliseconds = scale * step.cost, a moving average. A single frame that is much
/// too slow is clamped; the third in a row is used fully. While a technique is off, its scale cannot be
/// measured and decays slowly, so that it will be tried again.
class CostModel
{
public:
    /// @param cost of the step that was measured; 0: switched off
    /// @param milliseconds ignored when negative or not finite
    void observe(size_t technique, double cost, double milliseconds);
    void reset() { estimates_ = {}; }

    double scale(size_t technique) const { return estimates_[technique].scale; } ///< [ms] 0 before the first
    bool isKnown(size_t technique) const { return estimates_[technique].known; }

    static constexpr double kJump = 1.3;     ///< times the mean: beyond is a spike, or a jump
    static constexpr double kFollow = 0.1;   ///< share of a new value in the mean
    static constexpr double kForget = 0.001; ///< share of the scale a frame, while switched off: half in 12 s

private:
    struct Estimate
    {
        double scale = 0;
        std::array<double, 2> before{}; ///< [ms] of the last two frames; 0: not slow
        bool known = false;
    };
    std::array<Estimate, kMaxTechniques> estimates_{};
};

} // namespace fx::quality
