/// @file budget_controller.h
/// Keeps frames within a time budget by choosing the quality of each technique. The code uses neither a
/// clock nor GL. Frame times and elapsed time are inputs, so equal inputs give equal choices.
///
/// If the predicted time of the next frame exceeds 0.92 of the budget, quality is lowered at once; the
/// target is 0.8 of the budget. After 45 frames without a change, quality is raised by one step per
/// technique, but not within a second after lowering. If quality is lowered soon after a raise, the limit of
/// 45 frames is doubled. Quality affects only drawing, not the simulation.
#pragma once

#include "fxsdk/quality/scalability_choice.h"

#include <cstdint>

namespace fx::quality {

class BudgetController
{
public:
    static constexpr double kTarget = 0.8; ///< [1] target of the predicted time divided by the budget
    /// [1] predicted time divided by the budget, above which quality is lowered.
    static constexpr double kLimit = 0.92;
    /// number of frames without a change before quality is raised
    static constexpr uint32_t kCalmFrames = 45;
    static constexpr double kRestSeconds = 1.0; ///< [s] minimum time between a lowering and the next raise
    /// [s] Time after a raise. If quality is lowered within this time, the number of frames before the next
    /// raise doubles.
    static constexpr double kProbation = 3.0;
    static constexpr uint32_t kMaxPatience = 16; ///< largest factor of kCalmFrames after repeated doubling

    /// Starts with the highest level of each technique. Throws std::bad_alloc. All other functions allocate
    /// no memory.
    /// @param techniqueLevels levels of 1 to kMaxTechniques techniques; costs must increase and errors
    ///     decrease from level to level
    explicit BudgetController(std::vector<ScalabilityLevels> techniqueLevels);

    /// Updates the cost model from a finished frame. Times may arrive some frames later, so the caller also
    /// passes the choice of the finished frame.
    /// @param milliseconds [ms] times, one per technique; negative: unknown
    void observe(const Choice& choice, std::span<const double> milliseconds);

    struct Frame
    {
        double budget = 0;    ///< [ms] > 0
        double deltaTime = 0; ///< [s] since the last call, >= 0
        /// true: quality does not change; for untypical frames, such as during loading
        bool hold = false;
        std::span<const double> weights; ///< [1] >= 0, weight of the error of each technique
    };
    /// Chooses the levels of the next frame.
    const Choice& choose(const Frame& frame);

    std::span<const ScalabilityLevels> techniqueLevels() const { return techniqueLevels_; }
    const Choice& choice() const { return choice_; }
    const CostModel& costs() const { return costs_; }
    double predicted() const { return predicted_; } ///< [ms] predicted time of the last choice
    double error() const { return error_; }         ///< [1] estimated error of the last choice
    /// true if even the lowest levels are predicted to exceed the budget
    bool isSaturated() const { return saturated_; }
    uint64_t switches() const { return switches_; } ///< number of frames with a changed choice
    void reset();                                   ///< resets the choice to the highest levels

private:
    struct Memory ///< changes of one technique
    {
        double sinceFall = 1e9; ///< [s]
        double sinceRise = 1e9; ///< [s]
        uint32_t patience = 1;
    };
    void pass(double seconds);
    void fall(const ChoiceInputs& in, double target);
    void rise(const ChoiceInputs& in, double target);
    void take(const Choice& choice);

    std::vector<ScalabilityLevels> techniqueLevels_;
    CostModel costs_;
    Choice choice_{};
    std::array<Memory, kMaxTechniques> memory_{};
    uint32_t calm_ = 0; ///< number of frames since the last change
    double predicted_ = 0;
    double error_ = 0;
    bool saturated_ = false;
    uint64_t switches_ = 0;
};

} // namespace fx::quality
