/// @file catch_up.h
/// Policies for hidden instances, and how they reach the present when they are visible again.
#pragma once

#include <cstdint>

namespace fx::sim {

enum class CatchUp : uint8_t
{
    Analytic,      ///< not simulated; jumps to the present. The same bits as without a pause
    Replay,        ///< not simulated; takes the missing steps later, some each frame. The same bits
    Coarse,        ///< steps of four times the length, on the schedule of ticks. Deterministic, other bits
    Skip,          ///< not simulated; the missing time is left out: particles grow older where they are
    Authoritative, ///< always simulated
};

/// True when a pause leaves no trace in the state.
constexpr bool isExact(CatchUp policy)
{
    return policy == CatchUp::Analytic || policy == CatchUp::Replay || policy == CatchUp::Authoritative;
}

constexpr int64_t kCoarseSteps = 4; ///< steps of the scene in one step of CatchUp::Coarse

} // namespace fx::sim
