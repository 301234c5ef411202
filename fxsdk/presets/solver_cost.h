/// @file solver_cost.h
/// Share of one solver in the cost of an instance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace fx::preset {

constexpr double kCostStep = 1.0 / 60.0; ///< [s] length of the step for which costs are stated

/// [byte] size of a blob in all three snapshots.
constexpr uint64_t kBlobSnapshotBytes = 3 * 100;

/// Cost of a solver. A name with a slash denotes a member of an object inside the element.
struct SolverCost
{
    double stepWork = 0;       ///< [unit of base::WorkBudget] work of a step of length kCostStep
    double prewarmShare = 1.0; ///< [1] share of stepWork that a step of the prewarm takes
    uint64_t bytes = 0;        ///< [byte] memory of the solver and of its published data

    std::string member; ///< name of the preset's array that contains the element
    size_t place = 0;   ///< index of the element in that array

    std::string workMember; ///< member of the element that determines the work; empty: the element itself
    /// advice against high work, for warnings; empty: "lower" and the name of the member
    std::string workRemedy;
    std::string memoryMember; ///< member of the element that determines the memory
};

} // namespace fx::preset
