/// @file scripted_load.h
/// Frames with predefined times. The load has jumps, noise and spikes, and results arrive late. No clock is
/// read, so that all runs are equal.
#pragma once

#include "foundation/random/philox.h"
#include "fxsdk/quality/budget_controller.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace fx::quality::test {

constexpr size_t kTechniques = 6;
constexpr double kBudget = 4.0;         ///< [ms]
constexpr double kFrameTime = 1.0 / 60; ///< [s]
constexpr int kFrames = 6000;

/// Creates six equal techniques, each with six levels that take 0 to 2.2 ms at normal load.
std::vector<ScalabilityLevels> sixTechniques();
/// Indices of the frames whose load differs from the load of the previous frame.
std::vector<int> loadChanges();

/// Result of one run.
struct Outcome
{
    int over = 0;     ///< number of frames above the budget
    int switches = 0; ///< number of frames that changed a choice
    /// largest number of frames from a jump of the load until frames stay within the budget
    int worstRecovery = 0;
    /// Number of times that a technique returned to an earlier level within a second, without a jump of the
    /// load.
    int returns = 0;
    /// Number of times that a technique had the levels A, B, A, B within a second, with or without jumps of
    /// the load.
    int flickers = 0;
    double meanError = 0; ///< [1] mean error of a frame, summed over techniques
};

/// Function that makes the next choice from the choice of a frame and the budget.
using Policy = std::function<Choice(const Choice& shown, double budget)>;

struct Script
{
    int delay = 3; ///< [frame] delay until the time of a frame is known
    uint64_t seed = 1;
    std::function<bool(int frame)> isCatchUp; ///< may be empty
};

Outcome playController(const Script& script);
/// Plays the frames of the script with the initial quality in all frames.
Outcome playFixed(const Script& script);
/// Plays the frames of the script. After each frame, the levels of all techniques increase or decrease by
/// one, depending on the time of the frame.
Outcome playNaive(const Script& script);

} // namespace fx::quality::test
