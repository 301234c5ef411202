/// @file ribbon_store.h
/// Past positions of particles: one ring of points for each row of the particle store.
///
/// @formula ribbon-points
/// Points of a trail, their distance from the birth, and the visible part.
///
/// symbol   unit   meaning
///   b        tick   birth of the particle
///   T        tick   lifetime of the trail, in ticks
///   N        1      most points
///   k        1      number of a point, 0, 1, ...
///   x_k      m      position of the particle at tick b + k h; m least distance between points
///   s_k      m      arc length from the birth
/// @derivation
///   Points are sampled at ticks that depend only on the birth, N - 2 of them in a lifetime:
///       b + k h,   h = T / (N - 2) rounded up                                               (1)
///   A point is kept if its distance from the last kept point exceeds m. From a kept point j to the next, k,
///       s_k = s_j + |x_k - x_j|                                                             (2)
///   so the arc length of a point does not change while it is visible. The head is the position of the
///   particle, or of its death, with (2) from the newest point. The tail ends at the age T: position and arc
///   length are interpolated in time between the oldest point younger than T and the next older point    (3)
///   The published trail extends beyond the age T by one step, at most 1/30 s, so that the tail is known at
///   any moment between two steps. Drawing cuts it at the age T at that moment.
///   At arc length s between the tail's s_t and the head's s_h, a strip with soft ends of length f has its
///   opacity multiplied by
///       min(s_h - s, s - s_t, f) / f                                                        (4)
///   A texture that is stretched over the whole strip is read at
///       (s - s_t) / (s_h - s_t)                                                             (5)
///   If motion is integrated, x_k is interpolated in time along the straight path of its step.
/// @source    elementary
/// @deviation none
/// @valid     T > 0, N >= 3; a birth in the row of a dead particle removes the trail of that particle
/// @accuracy  float rounding of sums with at most one term per point
/// @tests     tests/simulation/particles/events/test_trails.cpp
#pragma once

#include "foundation/memory/column.h"
#include "simulation/particles/appearance_kernel.h"
#include "simulation/particles/ribbon_def.h"
#include "simulation/solver/budgeted_solver.h"

#include <memory_resource>
#include <vector>

namespace fx::sim {

/// The trails of the particles of one emitter. Threads: one at a time.
class RibbonStore
{
public:
    RibbonStore(const RibbonDef& def, uint32_t rows, std::pmr::memory_resource* memory);

    /// [byte] memory of a store with `rows` rows.
    static size_t bytesOf(const RibbonDef& def, uint32_t rows)
    {
        return size_t(rows) * (sizeof(Trail) + size_t(def.maxPoints) * sizeof(Point));
    }

    /// An interval of local time.
    struct Span
    {
        base::Ticks begin;
        base::Ticks end;
    };
    /// Adds the points of a step, within the work budget. `job` describes the particles at the end of the
    /// step.
    /// @param ioRow row of the next particle; 0 for the first call
    /// @return true if all particles have been processed
    bool follow(const AppearanceJob& job, const Span& step, uint32_t& ioRow, base::WorkBudget& work);
    bool empty() const { return count_ == 0; }
    /// Maximum number of rows that publish() writes.
    size_t mostPoints() const { return size_t(rows_) * (def_.maxPoints + 1); }
    /// Writes all trails at `now`. See BudgetedSolver::proceedPublication() for the budget.
    /// @param past [tick] time before `now` for which the ends of trails must be known. Trails are longer by
    ///         about this time
    bool publish(base::Ticks now, base::Ticks past, base::SnapshotGroup& group, PublicationPlace& ioPlace,
                 base::WorkBudget& work) const;
    void clear();

    void save(StateWriter& writer) const;
    /// Restores the output of save().
    /// @param store restored store of the particles
    /// @param now [tick] local time of the state
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
        uint64_t index = kNoParticle; ///< index of the particle
        Point head;                   ///< present position of the particle, or its position at death
        uint32_t first = 0;           ///< index of the oldest point in the ring
        uint32_t count = 0;
        uint64_t next = 0; ///< number k of the next point
        bool ended = false;
        glm::vec3 tint{1.0f}; ///< tint of the particle
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
    uint32_t count_ = 0; ///< number of trails that have points
    std::pmr::vector<Trail> trails_;
    base::Column<Point> points_;
};

} // namespace fx::sim
