/// @file scripted_load.h
/// Frames whose times are written down beforehand: a load that jumps, noise, spikes, results that come late.
/// No clock is asked, so that every run is the same.
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

/// Six techniques alike, each with six settings of 0 to 2.2 ms at normal load.
std::vector<ScalabilityLevels> sixTechniques();
/// Frames in which the load differs from the frame before.
std::vector<int> loadChanges();

/// What one run came to.
struct Outcome
{
    int over = 0;          ///< frames above the budget
    int switches = 0;      ///< frames that changed a choice
    int worstRecovery = 0; ///< frames from a jump of the load to the first that its load fits for good
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
/// The same frames with the quality of the start.
Outcome playFixed(const Script& script);
/// The same frames with one step up or down for all, by the time of the frame.
Outcome playNaive(const Script& script);

} // namespace fx::quality::test
