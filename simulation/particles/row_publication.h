/// @file row_publication.h
/// Publishes rows of particles as groups of the kind "particle".
#pragma once

#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/emitter_settings.h"
#include "simulation/solver/budgeted_solver.h"

#include <span>

namespace fx::sim {

/// Writes the constants of a group of the kind "particle".
/// @param arcPerTile [m] RibbonDef::arcPerTile for ribbons; 1 for all other particles
void writeConstants(const EmitterSettings& def, const EmitterAppearance& appearance, float arcPerTile,
                    std::span<float> constants);

/// The columns of a group of the kind "particle", null if absent.
AppearanceColumns columnsOf(base::SnapshotGroup& group);

/// Identity and kind of the group that is published.
struct GroupPlace
{
    base::KindId kind;
    const base::GroupInfo& base;
};

/// Adds a group of `rows` particles. The caller fills the columns afterwards.
base::SnapshotGroup& addRows(const ParticleProgram& program, uint32_t capacity, uint32_t rows,
                             const GroupPlace& place, base::FrameSnapshot& snapshot);

/// Publishes rows as a group of particles; see BudgetedSolver::proceedPublication().
/// @param tasks runner of parallel loops; null: the calling thread publishes all rows
bool publishRows(const AppearanceJob& job, const GroupPlace& group, base::TaskRunner* tasks,
                 base::FrameSnapshot& snapshot, PublicationPlace& place, base::WorkBudget& work);

} // namespace fx::sim
