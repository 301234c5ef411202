/// @file cost_model.h
/// Converts relative costs of techniques to milliseconds in the present scene, by a fit to measured frames.
#pragma once

#include "fxsdk/quality/scalability_levels.h"

#include <array>

namespace fx::quality {

/// Estimates a scale for each technique: milliseconds = scale * level.cost. The scale is a moving average of
/// measured values. A single frame that is much slower is clamped; the third slow frame in a row is used
/// fully. While a technique is off, its scale cannot be measured. It then decays slowly, so that the
/// technique will be tried again.
class CostModel
{
public:
    /// Updates the scale of a technique from a measured frame.
    /// @param cost cost of the level that was measured; 0: the technique was switched off
    /// @param milliseconds [ms] measured time; ignored when negative or not finite
    void observe(size_t technique, double cost, double milliseconds);
    void reset() { estimates_ = {}; }

    /// [ms] scale of a technique; 0 before the first observation
    double scale(size_t technique) const { return estimates_[technique].scale; }
    bool isKnown(size_t technique) const { return estimates_[technique].known; }

    static constexpr double kJump = 1.3;   ///< multiple of the mean above which a frame counts as slow
    static constexpr double kFollow = 0.1; ///< weight of a new value in the moving average
    /// relative decay of the scale per frame while the technique is off: one half in 12 s
    static constexpr double kForget = 0.001;

private:
    struct Estimate
    {
        double scale = 0;
        std::array<double, 2> before{}; ///< [ms] times of the last two frames if they were slow, otherwise 0
        bool known = false;
    };
    std::array<Estimate, kMaxTechniques> estimates_{};
};

} // namespace fx::quality
