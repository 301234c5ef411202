/// @file budget_controller.h
/// Keeps frames within a time budget by choosing the quality of each technique. It uses no clock and no GL:
/// frame times and elapsed time are inputs, so equal inputs give equal choices.
///
/// Quality is lowered at once when the predicted time of the next frame exceeds 0.92 of the budget; the
/// target is 0.8. Quality is raised by one step per technique after 45 frames without a change, but not
/// within a second after lowering. If a rise is soon followed by a fall, this interval is doubled. Only
/// drawing is affected, not the simulation.
#pragma once

#include "fxsdk/quality/scalability_choice.h"

#include <cstdint>

namespace fx::quality {

class BudgetController
{
public:
    static constexpr double kTarget = 0.8; ///< [1] target of the predicted time, as a share of the budget
    static constexpr double kLimit = 0.92; ///< share of the budget above which quality is lowered at once
    /// number of frames without a change before quality is raised
    static constexpr uint32_t kCalmFrames = 45;
    static constexpr double kRestSeconds = 1.0; ///< [s] minimum time between a lowering and the next raise
    /// [s] If quality is lowered within this time after a raise, the number of frames before the next raise
    /// doubles.
    static constexpr double kProbation = 3.0;
    static constexpr uint32_t kMaxPatience = 16; ///< maximum factor on kCalmFrames after repeated doubling

    /// Starts with the highest level of each technique; throws std::bad_alloc. The other functions do not
    /// allocate.
    /// @param techniqueLevels 1 to kMaxTechniques, each with increasing costs and decreasing errors
    explicit BudgetController(std::vector<ScalabilityLevels> techniqueLevels);

    /// Updates the cost model from a finished frame. Results may arrive late, so the caller also passes the
    /// choice of that frame.
    /// @param milliseconds [ms] times, one per technique; negative: unknown
    void observe(const Choice& choice, std::span<const double> milliseconds);

    struct Frame
    {
        double budget = 0;    ///< [ms] > 0
        double deltaTime = 0; ///< [s] since the last call, >= 0
        /// true: the frame is not typical, because the host loads or catches up, and quality does not change
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
    /// whether even the lowest levels are expected to exceed the budget
    bool isSaturated() const { return saturated_; }
    uint64_t switches() const { return switches_; } ///< number of frames that changed a choice
    void reset();                                   ///< starts again at the highest levels

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
