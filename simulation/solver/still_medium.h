/// @file still_medium.h
/// What techniques have in common whose medium does not move and is the same at all times.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "simulation/solver/blob_writer.h"
#include "simulation/solver/seekable_solver.h"

#include <string>

namespace fx::sim {

struct StillMediumDef : SolverDef
{
    std::string name;
    glm::vec3 position{0.0f};                         ///< [m] of the file's own origin
    float scale = 1.0f;                               ///< [1] multiplies lengths, > 0
    float density = 1.0f;                             ///< [1] multiplies the extinction, >= 0
    float anisotropy = 0.0f;                          ///< [1] mean cosine of the scattering angle
    float fireShare = 0.0f;                           ///< [1] part accounted to the fire layer
    base::MediaLayer layer = base::MediaLayer::Smoke; ///< of the rest

    Influence influence() const override { return {}; }
    CatchUp catchUp() const override { return CatchUp::Analytic; }

    /// [1] Factor of the cross sections of balls. An optical depth does not depend on `scale`.
    float sectionScale() const { return density * scale * scale; }
};

/// A solver without state, whose steps change nothing.
class StillMediumSolver : public Solver, public SeekableSolver
{
public:
    void step(const StepContext&) final {}
    bool finished(base::Ticks) const final { return false; }
    void save(StateWriter&) const final {}
    void restore(StateReader&) final {}
    SeekableSolver* seekable() final { return this; }

    bool canSeek(const StepContext&, base::Ticks) const final { return true; }
    void seek(const StepContext&, base::Ticks) final {}
    base::Ticks restsUntil(base::Ticks tick) const final;
    base::Ticks quietUntil(base::Ticks tick) const final { return restsUntil(tick); }

    /// Writes the constants of a group of balls, and the columns that are equal for all of them.
    static void writeShared(const StillMediumDef& def, BlobWriter& writer);
};

} // namespace fx::sim
