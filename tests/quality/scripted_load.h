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

/// Six equal techniques, each with six levels of 0 to 2.2 ms at normal load.
std::vector<ScalabilityLevels> sixTechniques();
/// Frames in which the load differs from the frame before.
std::vector<int> loadChanges();

/// Result of one run.
struct Outcome
{
    int over = 0;          ///< frames above the budget
    int switches = 0;      ///< frames that changed a choice
    int worstRecovery = 0; ///< frames from a jump of the load until frames stay within the budget
    int returns = 0;  ///< a technique went back within a second to where it was, without a jump of the load
    int flickers = 0; ///< A, B, A, B within a second, jumps or not
    double meanError = 0; ///< [1] summed over techniques
};

/// Decides the next choice from what is known of a frame.
using Policy = std::function<Choice(const Choice& shown, double budget)>;

struct Script
{
    int delay = 3; ///< [frame] until a result is known
    uint64_t seed = 1;
    std::function<bool(int frame)> isCatchUp; ///< may be empty
};

Outcome playController(const Script& script);
/// Plays the same frames with the initial quality.
Outcome playFixed(const Script& script);
/// Plays the same frames; all techniques go one level up or down by the time of the frame.
Outcome playNaive(const Script& script);

} // namespace fx::quality::test
