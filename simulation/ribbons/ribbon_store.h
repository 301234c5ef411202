/// @file ribbon_store.h
/// Where particles have been: rings of points, one a row of the particle store.
///
/// @formula ribbon-points
/// Points of a trail, their distance from the birth, and the visible part.
///
/// symbol   unit   meaning
///   b        tick   birth of the particle
///   T        tick   lifetime of the trail, in ticks
///   N        1      most points
///   k        1      number of a point, 0, 1, ...
///   x_k      m      place of the particle at tick b + k h; m least distance between points
///   s_k      m      arc length from the birth
/// @derivation
///   Points are taken at ticks that the birth alone decides, N - 2 of them in a lifetime:
///       b + k h,   h = T / (N - 2) rounded up                                               (1)
///   and kept when they are farther than m from the last one that was kept; from one kept point to the next
///       s_k = s_j + |x_k - x_j|                                                             (2)
///   so that a point never changes its arc length while it is seen. The head lies where the particle is, or
///   where it died, with (2) from the newest point. The tail ends at the age T: between the last point that
///   is younger and the first that is not, place and arc length are interpolated in proportion to time (3)
///   What is published goes on beyond that age for a step, at most 1/30 s, so that the tail is known at any
///   moment between two steps of that length; drawing ends it at the age T of that moment.
///   Near its ends, at arc length s between the tail's s_t and the head's s_h, a strip whose ends are soft
///   over f has its opacity times
///       min(s_h - s, s - s_t, f) / f                                                        (4)
///   and a texture that is as long as the strip is read at
///       (s - s_t) / (s_h - s_t)                                                             (5)
///   Where motion is integrated, x_k lies on the straight way of its step, in proportion to time.
/// @source    elementary
/// @deviation none
/// @valid     T > 0, N >= 3; a birth that takes the row of a dead particle ends that one's trail
/// @accuracy  float rounding of sums of at most one term a point
/// @tests     tests/simulation/particles/events/test_trails.cpp
#pragma once

#include "foundation/memory/column.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/ribbon_def.h"
#include "simulation/solver/budgeted_solver.h"

#include <memory_resource>
#include <vector>

namespace fx::sim {

/// Threads: one at a time.
class RibbonStore
{
public:
    RibbonStore(const RibbonDef& def, uint32_t rows, std::pmr::memory_resource* memory);

    /// [byte] memory of a store with `rows` rows.
    static size_t bytesOf(const RibbonDef& def, uint32_t rows)
    {
        return size_t(rows) * (sizeof(Trail) + size_t(def.maxPoints) * sizeof(Point));
    }

    /// A stretch of local time.
    struct Span
    {
        base::Ticks begin;
        base::Ticks end;
    };
    /// Adds the points of a step, at the end of which `job` describes the particles, within the work budget.
    /// @param ioRow row of the next particle, 0 at first @return whether all particles have been processed
    bool follow(const AppearanceJob& job, const Span& step, uint32_t& ioRow, base::WorkBudget& work);
    bool empty() const { return count_ == 0; }
    /// Most rows that publish() writes.
    size_t mostPoints() const { return size_t(rows_) * (def_.maxPoints + 1); }
    /// Writes all trails at `now`, as BudgetedSolver::proceedPublication().
    /// @param past [tick] before `now` for which the tails must be known; trails are longer by about this
    ///         time
    bool publish(base::Ticks now, base::Ticks past, base::SnapshotGroup& group, PublicationPlace& ioPlace,
                 base::WorkBudget& work) const;
    void clear();

    void save(StateWriter& writer) const;
    /// @param store of the particles, restored  @param now [tick] local time of the state
    void restore(StateReader& reader, const ParticleStore& store, base::Ticks now);

private:
    struct Point
    {
        glm::vec3 position{0.0f};
        float arc = 0;
        base::Ticks tick = 0;
    };
    struct Trail
    {
        uint64_t index = kNoParticle; ///< of the particle
        Point head;                   ///< position now, or at death
        uint32_t first = 0;           ///< oldest point in the ring
        uint32_t count = 0;
        uint64_t next = 0; ///< k of the next point
        bool ended = false;
        glm::vec3 tint{1.0f}; ///< of the particle
    };
    const Point& pointOf(uint32_t row, uint32_t k) const ///< 0: the oldest
    {
        return points_[size_t(row) * def_.maxPoints + (trails_[row].first + k) % def_.maxPoints];
    }
    void begin(const AppearanceJob& job, uint32_t row);
    void followRow(const AppearanceJob& job, uint32_t row, const Span& step);
    void checkRow(StateReader& reader, const ParticleStore& store, uint32_t row, base::Ticks now) const;
    void keep(uint32_t row, const Point& point);
    void forget(uint32_t row, base::Ticks now);
    struct Writer;

    const RibbonDef& def_;
    uint32_t rows_;
    base::Ticks lifetime_;
    base::Ticks interval_;
    uint32_t count_ = 0; ///< trails that have points
    std::pmr::vector<Trail> trails_;
    base::Column<Point> points_;
};

} // namespace fx::sim
