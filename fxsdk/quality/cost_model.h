/// @file cost_model.h
/// Converts relative costs of techniques to milliseconds in the present scene. The conversion is fitted to
/// measured frames.
#pragma once

#include "fxsdk/quality/scalability_levels.h"

#include <array>

namespace fx::quality {

/// Estimates a scale for each technique: milliseconds = scale * level.cost. The scale is a moving average of
/// measured values. The measured value of a much slower frame is clamped. After three slow frames in a row,
/// the smallest of their values becomes the scale. While a technique is off, its scale cannot be measured,
/// and decays slowly. So the technique is tried again after some time.
class CostModel
{
public:
    /// Updates the scale of a technique from a measured frame.
    /// @param cost cost of the technique's level in the frame; 0: the technique was off
    /// @param milliseconds [ms] measured time; ignored if negative or not finite
    void observe(size_t technique, double cost, double milliseconds);
    void reset() { estimates_ = {}; }

    /// [ms] scale of a technique; 0 before the first observation
    double scale(size_t technique) const { return estimates_[technique].scale; }
    bool isKnown(size_t technique) const { return estimates_[technique].known; }

    static constexpr double kJump = 1.3;   ///< multiple of the scale above which a frame counts as slow
    static constexpr double kFollow = 0.1; ///< weight of a new value in the moving average
    /// [1] relative decay of the scale per frame while the technique is off
    static constexpr double kForget = 0.001;

private:
    struct Estimate
    {
        double scale = 0;
        /// [ms] measured scales of the last two frames; 0 for a frame that was not slow.
        std::array<double, 2> before{};
        bool known = false;
    };
    std::array<Estimate, kMaxTechniques> estimates_{};
};

} // namespace fx::quality
