/// @file solver_cost.h
/// Contribution of one solver to the cost of an instance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace fx::preset {

constexpr double kCostStep = 1.0 / 60.0; ///< [s] length of the step for which costs are stated

/// [byte] size of a blob in all three snapshots.
constexpr uint64_t kBlobSnapshotBytes = 3 * 100;

/// Cost of a solver. The solver is defined by an element of an array of the preset. In names of members, a
/// slash separates an object and its member.
struct SolverCost
{
    double stepWork = 0;       ///< [unit of base::WorkBudget] work of a step of length kCostStep
    double prewarmShare = 1.0; ///< [1] work of a prewarm step divided by stepWork
    uint64_t bytes = 0;        ///< [byte] memory of the solver and of its published data

    std::string member; ///< name of the preset's array that contains the element
    size_t place = 0;   ///< index of the element in the array `member`

    std::string workMember; ///< member of the element that determines the work; empty: the whole element
    /// advice in warnings about high work; empty: the advice is to lower workMember
    std::string workRemedy;
    std::string memoryMember; ///< member of the element that determines the memory
};

} // namespace fx::preset
