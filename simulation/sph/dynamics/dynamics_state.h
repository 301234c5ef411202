/// @file dynamics_state.h
/// State shared by the parts of the gas dynamics. Only code of this folder uses this header.
#pragma once

#include "simulation/sph/dynamics/gas_columns.h"
#include "simulation/sph/dynamics/gas_dynamics.h"
#include "simulation/sph/dynamics/step_clock.h"
#include "simulation/sph/neighbors/neighbor_lists.h"
#include "simulation/sph/neighbors/particle_tree.h"
#include "simulation/sph/pair_loops/density_loop.h"
#include "simulation/sph/pair_loops/force_loop.h"

#include <atomic>
#include <limits>

namespace fx::sim {

constexpr double kEndless = 1e30; ///< [s] time step of a particle that no criterion limits

/// After heat input or new particles, step criteria underestimate the changes of the flow. Therefore the
/// first step is shortened by this factor, and each further step may be twice as long as the previous step.
/// The energy error of a point blast in 24^3 particles with block steps is 1.9e-2 for the factor 1, 5e-3 for
/// 1/2, 3.2e-3 for 1/4 and 3.0e-3 for 1/8.
constexpr float kFirstSteps = 0.25f;

/// Heat that will be released at a later time.
struct DelayedHeat
{
    double seconds; ///< [s] time from the beginning of the next frame to the release
    double joules;
    uint32_t id;
    uint32_t isGiven; ///< 1 from the release until the end of the frame, else 0
};

/// Neighbor lists of all particles and their validity. The lists are reused in the following frames.
struct ListState
{
    bool valid = false;
    double margin = 0;  ///< [1] search margin with which the lists were built
    double moved = 0;   ///< [1] largest displacement of a particle since the build, in units of its support
    double growth = 0;  ///< [1] largest relative growth of a support since the build
    double perStep = 0; ///< [1] increase of `moved` in the last sub-step
};

/// A call of advance() that continues in further calls.
struct Advance
{
    bool isOpen = false;
    double left = 0;  ///< [s] part of the requested time that remains
    double frame = 0; ///< [s] length of the open frame; 0 between frames
    AdvanceReport report;
};

template <class T>
struct DynamicsState
{
    DynamicsState(const GasDynamicsDef& definition, std::pmr::memory_resource* memory);

    uint32_t placeOf(uint32_t particle) const { return slot[particle]; }
    std::span<const uint32_t> activeSlots() const { return active.first(activeCount); }
    PairSlots<T> pairsOf(std::span<const uint32_t> slots) const
    {
        return {lists, records.data(), def.domain, slots};
    }
    double seconds(double ticks) const { return ticks * tick; }

    GasDynamicsDef def;
    DensityRules densityRules;
    ForceRules forceRules;
    double pressureScale = 1; ///< [1] factor of GasDynamics::setPressureScale()
    double soundScale = 1;    ///< [1] square root of pressureScale

    uint32_t count = 0;
    GasColumns<T> gas;
    base::Column<uint32_t> slot; ///< slot of each id
    bool fresh = false;          ///< true: some particles have no density yet
    /// true: accelerations are outdated, because the caller changed particles
    bool stale = false;
    bool shaken = false;    ///< true: the first steps must be short, because heat or particles were added
    bool heatedNow = false; ///< true: heat was released at the present tick
    std::pmr::vector<DelayedHeat> delayed; ///< sorted by time

    ParticleTree<T> tree;
    bool treeIsSorted = false;
    /// true after restoring a state: the tree must be rebuilt from sortedX..sortedSupport
    bool mustRecoverTree = false;
    NeighborLists<T> lists;
    ListState listState;
    bool listsServeActive = false; ///< true: every active slot has a list
    /// Positions [m] and supports [m] at the last sort. The sort can be repeated from these values.
    base::Column<T> sortedX, sortedY, sortedZ, sortedSupport;
    base::Column<T> nowX, nowY, nowZ; ///< [m] present positions, from which the tree is refitted
    /// Positions [m] and supports [m] when the neighbor lists were built; meaningful while the lists are
    /// valid.
    base::Column<T> listX, listY, listZ, listSupport;
    /// Records of the particles at the present time, as read by the loops over pairs.
    base::Column<GasRecord<T>> records;
    base::Column<uint32_t> recordRound; ///< number of the prediction that wrote each record
    uint32_t round = 0;                 ///< number of the last prediction
    bool recordsAreComplete = false;    ///< true: the last prediction has written all records

    uint64_t now = 0;              ///< [tick] present time within the frame
    double tick = 0;               ///< [s] length of a tick
    base::Column<uint32_t> active; ///< slots of the particles whose step ends now (active slots), ascending
    uint32_t activeCount = 0;
    base::Column<uint32_t> blockCounts; ///< number of active slots in each block of kBlock slots
    base::Column<uint64_t> blockEnds;   ///< [tick] earliest end, after `now`, of a step in each block
    base::Column<T> blockSpeeds;        ///< [1/s2] largest (|v| / H)^2 in each block
    base::Column<uint64_t> blockNow;    ///< [tick] time of the positions nowX..nowZ of each block
    base::Column<uint8_t> blockChanged; ///< 1 if steps in the block have changed since the last prediction
    std::atomic<uint64_t> nextEnd{0};   ///< [tick] earliest end of a step after `now`
    double fastest = 0;                 ///< [1/s] largest |v| / H

    base::Column<uint8_t> wantsReach;
    base::Column<uint32_t> wanting; ///< active slots that need longer lists, ascending
    base::Column<uint32_t> neighbors;
    base::Column<uint32_t> pairs;
    base::Column<T> heating;
    base::Column<T> signalSpeed;
    base::Column<T> fastestNeighbor;
    /// for each particle: level of the longest step that its neighborhood allows
    base::Column<uint8_t> levelLimit;

    std::atomic<uint64_t> clamped{0};
    uint64_t pairSum = 0;
    uint64_t searches = 0;
    Advance advance;
};

/// Maximum and minimum of values from several threads. The result does not depend on the order of calls.
template <class N>
void raiseTo(std::atomic<N>& largest, N value)
{
    N seen = largest.load(std::memory_order_relaxed);
    while (seen < value && !largest.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}
template <class N>
void lowerTo(std::atomic<N>& smallest, N value)
{
    N seen = smallest.load(std::memory_order_relaxed);
    while (value < seen && !smallest.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

/// [m5/(kg s2)] The quantity p of formula gas-pair-forces.
template <class T>
T pushOf(const DynamicsState<T>& s, T correction, T pressure, T density)
{
    const T excess = pressure - T(s.def.ambientPressure);
    const T drawn = s.def.tension ? excess : std::max(excess, T(0));
    return T(s.pressureScale) * correction * drawn / (density * density);
}

/// [m] Largest support that periodic axes and pairs of walls allow.
double largestInDomain(const GasDynamicsDef& def);

/// Number of slots of a block. Sums and searches over all particles process one block at a time.
constexpr uint32_t kBlock = 1024;

/// Makes the next prediction process the block of `slot`. Thread-safe.
template <class T>
void markChanged(DynamicsState<T>& s, uint32_t slot)
{
    std::atomic_ref<uint8_t>(s.blockChanged[slot / kBlock]).store(1, std::memory_order_relaxed);
}

inline uint32_t blockCount(uint32_t count)
{
    return (count + kBlock - 1) / kBlock;
}

} // namespace fx::sim
