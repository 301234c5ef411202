/// @file motion_lanes-inl.h
/// Positions of particles at a time, and curves over their lives. The file is included once for each
/// instruction set.
#if defined(FX_PARTICLE_MOTION_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PARTICLE_MOTION_LANES_INL
#undef FX_PARTICLE_MOTION_LANES_INL
#else
#define FX_PARTICLE_MOTION_LANES_INL
#endif

#include "simulation/motion/lanes-inl.h"
#include "simulation/particles/appearance_kernel.h"

#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {

/// Values of an attribute, which are stored in rows or constant for all particles.
struct Source
{
    const float* rows;
    float constant;

    HWY_INLINE Source(const ParticleStore& store, size_t column)
        : rows(store.values[column].data()), constant(store.constant[column])
    {}
    HWY_INLINE void turnTo(const ParticleStore& store, size_t column) { rows = store.values[column].data(); }
    HWY_INLINE Floats at(uint32_t row) const { return rows ? hn::Load(kFloats, rows + row) : all(constant); }
    HWY_INLINE void fetch(uint32_t row) const
    {
        if (rows)
            hwy::Prefetch(rows + row);
    }
};

struct MotionLanes
{
    Floats position[3];
    Floats velocity[3]; ///< only on request
    Floats age;
    Floats life; ///< [1] age / lifetime
};

/// Reads the motion of kWidth particles at a time.
template <bool kBallistic, bool kBrief>
class MotionReader
{
public:
    explicit MotionReader(const AppearanceJob& job)
        : perLife_(*job.store, stored::PerLife), x_{{*job.store, stored::X},
                                                    {*job.store, stored::Y},
                                                    {*job.store, stored::Z}},
          drag_(dragOf(job)), hasDrag_(drag_ > 0.0f), perDrag_(hasDrag_ ? 1.0f / drag_ : 0.0f)
    {
        turnTo(job);
    }
    /// Switches to another job of the same program.
    HWY_INLINE void turnTo(const AppearanceJob& job)
    {
        const ParticleStore& store = *job.store;
        bornShort_ = store.bornShort.data();
        born_ = store.born.data();
        perLife_.turnTo(store, stored::PerLife);
        for (size_t a = 0; a < 3; ++a) {
            x_[a].rows = store.placed ? store.values[stored::X + a].data() : nullptr;
            v_[a] = store.values[stored::VelocityX + a].data();
        }
        now_ = job.now;
        pull_ = job.pull;
        longest_ = float(base::toSeconds(job.now - job.motionBegin));
    }

    /// Reads the motion of the particles in the rows that begin at `row`.
    /// @tparam kDeadStay true: dead particles are not moved, so that less data is read. The positions of dead
    ///         particles are then arbitrary
    template <bool kVelocity, bool kDeadStay>
    HWY_INLINE MotionLanes read(uint32_t row) const
    {
        MotionLanes m;
        if constexpr (kBrief)
            m.age = secondsOf(bornShort_ + row, uint32_t(now_));
        else
            m.age = secondsOf(born_ + row, now_);
        m.life = m.age * perLife_.at(row);
        if constexpr (kBallistic) {
            const Floats moving = hn::Min(m.age, all(longest_));
            const Floats t = kDeadStay ? hn::IfThenElseZero(hn::Lt(m.life, all(1.0f)), moving) : moving;
            const DragLanes step =
                hasDrag_ ? dragLanes<kVelocity>(all(drag_), all(perDrag_), t) : freeLanes(t);
            for (int a = 0; a < 3; ++a) {
                const Floats v = hn::Load(kFloats, v_[a] + row);
                m.position[a] = x_[a].at(row) + step.gain * v + step.ramp * all(pull_[a]); // (1)
                if constexpr (kVelocity)
                    m.velocity[a] = step.decay * v + step.gain * all(pull_[a]); // (2)
            }
        } else {
            for (int a = 0; a < 3; ++a) {
                m.position[a] = hn::Load(kFloats, x_[a].rows + row);
                if constexpr (kVelocity)
                    m.velocity[a] = hn::Load(kFloats, v_[a] + row);
            }
        }
        return m;
    }

    /// Prefetches data for read().
    HWY_INLINE void fetch(uint32_t row) const
    {
        if constexpr (kBrief) {
            hwy::Prefetch(bornShort_ + row);
        } else {
            hwy::Prefetch(born_ + row);
            hwy::Prefetch(born_ + row + kTilePadding / 2); // a row takes twice as much
        }
        perLife_.fetch(row);
        for (int a = 0; a < 3; ++a) {
            x_[a].fetch(row);
            hwy::Prefetch(v_[a] + row);
        }
    }

private:
    static float dragOf(const AppearanceJob& job)
    {
        const float drag = job.program->def.forces.drag;
        return drag > 0.0f ? std::min(drag, 1e6f) : 0.0f;
    }
    static HWY_INLINE DragLanes freeLanes(Floats t) { return {all(1.0f), t, all(0.5f) * t * t}; }

    const uint32_t* bornShort_;
    const base::Ticks* born_;
    Source perLife_;
    Source x_[3];
    const float* v_[3];
    base::Ticks now_;
    float drag_;
    bool hasDrag_;
    float perDrag_; ///< [s]
    glm::vec3 pull_;
    float longest_; ///< [s] upper bound of the time since the motion of a particle began
};

/// Evaluates ramp-curves for the channels of one RampCurves, at one parameter per particle.
class CurveLanes
{
public:
    /// Finds the pieces of the curves at the parameters `t`.
    /// @param ioPiece index of the piece that the previous particles used; the search begins there
    HWY_INLINE CurveLanes(const RampCurves& curves, Floats t, uint32_t& ioPiece) : curves_(curves), t_(t)
    {
        if (HWY_UNLIKELY(curves_.byTable)) {
            const Floats s = hn::Min(hn::Max(t, hn::Zero(kFloats)), all(1.0f)) * all(float(kLast));
            const auto i = hn::Min(hn::ConvertTo(kInts, s), hn::Set(kInts, int32_t(kLast) - 1));
            fraction_ = s - hn::ConvertTo(kFloats, i);
            place_ = i;
            return;
        }
        piece_ = ioPiece;
        const Which inside =
            hn::And(hn::Ge(t, all(curves_.from[piece_])), hn::Lt(t, all(curves_.from[piece_ + 1])));
        together_ = hn::AllTrue(kFloats, inside);
        if (HWY_LIKELY(together_))
            return;
        for (uint32_t k = 1; k <= curves_.ramps; ++k) {
            const auto beyond = hn::RebindMask(kInts, hn::Ge(t, all(curves_.from[k])));
            place_ = hn::Add(place_, hn::IfThenElseZero(beyond, hn::Set(kInts, 1)));
        }
        ioPiece = uint32_t(hn::GetLane(place_));
    }
    HWY_INLINE Floats value(uint32_t channel) const
    {
        if (curves_.isConstant(channel))
            return all(curves_.start[channel]);
        if (HWY_UNLIKELY(curves_.byTable)) {
            const float* table = curves_.table[channel].data();
            const Floats low = hn::GatherIndex(kFloats, table, place_);
            return low + fraction_ * (hn::GatherIndex(kFloats, table + 1, place_) - low); // (3)
        }
        const float* const starts = curves_.pieceStart[channel].data();
        const float* const slopes = curves_.pieceSlope[channel].data();
        if (HWY_LIKELY(together_))
            return all(starts[piece_]) + all(slopes[piece_]) * t_; // (2)
        return ofPlace(starts) + ofPlace(slopes) * t_;
    }

private:
    /// Looks up the value of each particle's piece in a table with one value per piece.
    HWY_INLINE Floats ofPlace(const float* table) const
    {
#if HWY_TARGET != HWY_SCALAR
        if (kWidth >= 8 && curves_.ramps < kWidth)
            return hn::TableLookupLanes(hn::LoadU(kFloats, table), hn::IndicesFromVec(kFloats, place_));
#endif
        Floats found = all(table[0]);
        for (uint32_t k = 1; k <= curves_.ramps; ++k)
            found = hn::IfThenElse(hn::Ge(t_, all(curves_.from[k])), all(table[k]), found);
        return found;
    }
    static constexpr size_t kLast = base::kCurveSamples;

    const RampCurves& curves_;
    Floats t_;
    Floats fraction_ = hn::Zero(kFloats);
    hn::Vec<IntTag> place_ = hn::Zero(kInts);
    uint32_t piece_ = 0;
    bool together_ = false;
};

} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
