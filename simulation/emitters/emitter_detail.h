/// @file emitter_detail.h
/// Coordinates for the detail of the medium of one emitter, formula material-coordinates.
#pragma once

#include "simulation/detail/material_coordinates.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/solver/solver.h"

namespace fx::sim {

/// [m] Mean over life of the radius of an emitter's particles, > 0.
float meanRadiusOf(const EmitterSettings& settings);

/// Material coordinates of the particles of an emitter, in the rows of their particle store. No velocity
/// gradient is measured, because the particles do not interact. Generations begin at fixed local times, at a
/// rate derived from the turbulence.
class EmitterDetail
{
public:
    EmitterDetail(const EmitterDef& def, uint32_t capacity, std::pmr::memory_resource* memory);

    /// [tick] Time between two births of generations. The strain of turbulence with strength U and scale L is
    /// 4.4 U / L, the rms strain of an isotropic flow with a single wavelength.
    static base::Ticks periodOf(const EmitterDef& def);

    /// Starts at `now`. Particles with an index below `next` must be dead or already have coordinates.
    void begin(uint64_t next, base::Ticks now);
    /// Updates the coordinates after a step that ended at job.now.
    void follow(const AppearanceJob& job, const StepContext& context);
    /// Adds the group of coordinates that belongs to the group of blobs added last. The rows are written
    /// later.
    void open(base::Ticks now, base::KindId kind, uint32_t capacity, base::FrameSnapshot& snapshot) const;
    /// Copies row `row` of the store to element `to` of the group.
    void write(uint32_t row, uint32_t to, base::SnapshotGroup& group) const
    {
        for (size_t c = 0; c < MaterialCoordinates::kColumns; ++c)
            group.editColumn(c)[to] = coordinates_.value(c, row);
    }
    /// Saves the coordinates of living rows.
    void save(StateWriter& writer, const ParticleStore& store, base::Ticks now) const;
    void restore(StateReader& reader, const ParticleStore& store, base::Ticks now);

private:
    uint64_t youngerAt(base::Ticks now) const { return uint64_t(now / period_) + 1; }
    base::Ticks birthOf(uint64_t generation) const { return (base::Ticks(generation) - 1) * period_; }
    void bear(const AppearanceJob& job, uint64_t generation);
    void adopt(const AppearanceJob& job, const StepContext& context);
    template <class F>
    static void forEachLiving(const ParticleStore& store, base::Ticks now, F&& f);

    const EmitterDef& def_;
    base::Ticks period_;
    DetailGenerations shared_;
    uint64_t younger_ = 0; ///< number of the youngest generation for which coordinates exist
    uint64_t next_ = 0;    ///< birth index below which particles have coordinates
    MaterialCoordinates coordinates_;
};

} // namespace fx::sim
