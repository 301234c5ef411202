/// @file scripted_load.h
/// Frames with predefined times: a load that jumps, noise, spikes, late results. No clock is read, so that
/// every run is the same.
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
/// Indices of the frames at which the load differs from that of the frame before.
std::vector<int> loadChanges();

/// Result of one run.
struct Outcome
{
    int over = 0;     ///< frames above the budget
    int switches = 0; ///< number of frames that changed a choice
    /// largest number of frames from a jump of the load until frames stay within the budget
    int worstRecovery = 0;
    /// number of times that a technique returned within a second to an earlier level, without a jump of the
    /// load
    int returns = 0;
    /// number of times that a technique took the levels A, B, A, B within a second, with or without jumps of
    /// the load
    int flickers = 0;
    double meanError = 0; ///< [1] summed over techniques
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
/// Plays the frames of the script with the initial quality throughout.
Outcome playFixed(const Script& script);
/// Plays the frames of the script. After each frame, all techniques go one level up or down, depending on the
/// time of the frame.
Outcome playNaive(const Script& script);

} // namespace fx::quality::test
