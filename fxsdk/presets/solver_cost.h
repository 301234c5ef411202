/// @file solver_cost.h
/// Share of one solver in the cost of an instance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace fx::preset {

constexpr double kCostStep = 1.0 / 60.0; ///< [s] step that costs are stated for

/// [byte] of a blob in all three snapshots.
constexpr uint64_t kBlobSnapshotBytes = 3 * 100;

/// Names of members have a slash where the member is in an object of the element.
struct SolverCost
{
    double stepWork = 0;       ///< [unit] of base::WorkBudget, of a step of kCostStep
    double prewarmShare = 1.0; ///< [1] of that work in a step of a prewarm
    uint64_t bytes = 0;        ///< of the solver and of its published data

    std::string member; ///< of the preset: the list that the element is in
    size_t place = 0;   ///< of the element in that list

    std::string workMember;   ///< member of the element that decides the work; empty: the element itself
    std::string workRemedy;   ///< remedy for high work; empty: "lower" and the member
    std::string memoryMember; ///< member of the element that decides the memory
};

} // namespace fx::preset
