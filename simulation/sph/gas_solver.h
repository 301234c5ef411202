/// @file gas_solver.h
/// One body of hot gas of one instance.
#pragma once

#include "simulation/solver.h"
#include "simulation/sph/gas_def.h"
#include "simulation/sph/gas_motion.h"
#include "simulation/sph/gas_store.h"
#include "simulation/sph/neighbor_grid.h"

namespace fx::sim {

/// Most sub-steps of one step. What they do not cover is not simulated, and counted as clamped.
constexpr uint32_t kMostGasSubSteps = 400;

/// Smoothed particle hydrodynamics with sub-steps as short as sound needs to cross a particle.
class GasSolver final : public Solver
{
public:
    /// @param def outlives the solver
    /// @param kind of the groups it publishes
    GasSolver(const GasDef& def, base::KindId kind, std::pmr::memory_resource* memory);

    void step(const StepContext& context) override;
    void publish(const base::GroupInfo& base, base::FrameSnapshot& snapshot) const override;
    bool finished(base::Ticks) const override { return done_; }
    uint32_t elementCount() const override { return gas_.count; }

private:
    bool release(const StepContext& context);
    double subStep(const GasMotion& motion, double left);
    void sortParticles();
    float stableSeconds() const;
    void adaptParticles(uint32_t begin, uint32_t end);
    void countWork(StepCounters& counters) const;
    void retireWhenDissolved();

    const GasDef& def_;
    base::KindId kind_;
    GasStore gas_;
    NeighborGrid grid_;
    base::Ticks released_; ///< local time of the release
    base::Ticks now_ = 0;  ///< end of the last step
    bool begun_ = false;
    bool done_ = false;
};

} // namespace fx::sim
