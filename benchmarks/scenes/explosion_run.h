/// @file explosion_run.h
/// The gas of the library's explosion without its other parts, stepped as in a game, for measurements.
#pragma once

#include "foundation/memory/host_memory.h"
#include "foundation/result/status.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "simulation/gas/gas_def.h"
#include "simulation/solver/solver.h"

#include <memory>

namespace fx::cli {

constexpr int kExplosionFrames = 60; ///< frames per second

struct ExplosionSetting
{
    uint32_t particles = 10'000; ///< number of particles, 8 .. 20000
    float soundSpeed = -1;       ///< [m/s] limit of the speed of sound; 0: none; negative: as in the preset
    float flowMach = 0.3f;       ///< [1] see sim::Quality; 0: none
};

/// Averages over the cloud.
struct ExplosionState
{
    double height;      ///< [m] height of the center
    double radius;      ///< [m] root mean square distance from the axis
    double speed;       ///< [m/s] root mean square
    double temperature; ///< [K] mean
};

class ExplosionRun
{
public:
    /// Creates a run of the library's explosion.
    /// @param tasks must outlive the run
    /// @return NotFound when the library has no explosion of gas
    static base::Result<std::unique_ptr<ExplosionRun>> create(const ExplosionSetting& setting,
                                                              base::TaskRunner& tasks);
    ExplosionRun(const sim::GasDef& gas, const sim::Quality& quality, base::TaskRunner& tasks);

    void step(); ///< takes the steps of one frame
    ExplosionState look();
    /// Publishes the present gas. @return snapshot that is valid until the next call of any function
    const base::FrameSnapshot& publish();
    /// [1] Median over particles of the distance to the nearest neighbor, divided by the particle spacing (m
    /// / rho)^(1/3). Values: 1 in a lattice, 0.55 for random points, 0.85 to 0.9 in glass, 0 without gas.
    double nearestOverSpacing();
    const sim::StepCounters& counters() const { return counters_; }

private:
    sim::GasDef def_;
    base::TaskRunner& tasks_;
    base::HostMemory memory_;
    base::SnapshotSchema schema_;
    std::unique_ptr<sim::Solver> solver_;
    base::Arena arena_;
    base::FrameSnapshot snapshot_;
    sim::InstanceParameters parameters_;
    sim::StepCounters counters_;
    int frame_ = 0;
};

} // namespace fx::cli
