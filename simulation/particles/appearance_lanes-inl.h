/// @file appearance_lanes-inl.h
/// The pass that writes groups of the kind "particle". The file is included once for each instruction set.
#if defined(FX_PARTICLE_LOOK_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PARTICLE_LOOK_LANES_INL
#undef FX_PARTICLE_LOOK_LANES_INL
#else
#define FX_PARTICLE_LOOK_LANES_INL
#endif

#include "simulation/particles/color_lanes-inl.h"
#include "simulation/particles/motion_lanes-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {

/// Bounding box and largest radius, per lane.
struct BoundsLanes
{
    Floats low[3];
    Floats high[3];
    Floats radius;

    HWY_INLINE BoundsLanes() : radius(hn::Zero(kFloats))
    {
        for (int a = 0; a < 3; ++a) {
            low[a] = all(kFarAway);
            high[a] = all(-kFarAway);
        }
    }
    /// Extends the bounds by balls of radius `r`.
    /// @tparam kFull true if all particles of the vector are alive
    template <bool kFull>
    HWY_INLINE void add(Which alive, const Floats* position, Floats r)
    {
        for (int a = 0; a < 3; ++a) {
            const Floats lower = hn::Min(low[a], position[a]);
            const Floats upper = hn::Max(high[a], position[a]);
            low[a] = kFull ? lower : hn::IfThenElse(alive, lower, low[a]);
            high[a] = kFull ? upper : hn::IfThenElse(alive, upper, high[a]);
        }
        radius = hn::Max(radius, r); // that of an empty row is 0
    }
    HWY_INLINE void store(AppearanceBounds& out) const
    {
        for (int a = 0; a < 3; ++a) {
            out.low[a] = hn::GetLane(hn::MinOfLanes(kFloats, low[a]));
            out.high[a] = hn::GetLane(hn::MaxOfLanes(kFloats, high[a]));
        }
        out.radius = hn::GetLane(hn::MaxOfLanes(kFloats, radius));
    }
};

class AppearanceLanes
{
public:
    AppearanceLanes(const AppearanceJob& job, const AppearanceColumns& out)
        : job_(&job), appearance_(job.program->def.appearance), out_(out),
          radius_(*job.store, stored::Radius), amount_(*job.store, stored::Amount),
          brightness_(*job.store, stored::Brightness), angle_(*job.store, stored::Angle),
          spin_(*job.store, stored::Spin),
          frame_(*job.store, stored::Frame), axis_{{*job.store, stored::AxisX},
                                                   {*job.store, stored::AxisY},
                                                   {*job.store, stored::AxisZ}},
          tint_{
              {*job.store, stored::TintRed}, {*job.store, stored::TintGreen}, {*job.store, stored::TintBlue}},
          frames_(float(appearance_.tileColumns * appearance_.tileRows)),
          bright_(brightness_.rows || brightness_.constant != 1.0f)
    {}

    /// Switches to another job of the same program.
    HWY_INLINE void turnTo(const AppearanceJob& job)
    {
        job_ = &job;
        radius_.turnTo(*job_->store, stored::Radius);
        amount_.turnTo(*job_->store, stored::Amount);
        if (job_->program->plain)
            return;
        brightness_.turnTo(*job_->store, stored::Brightness);
        angle_.turnTo(*job_->store, stored::Angle);
        spin_.turnTo(*job_->store, stored::Spin);
        frame_.turnTo(*job_->store, stored::Frame);
        for (size_t a = 0; a < 3; ++a)
            axis_[a].turnTo(*job_->store, stored::AxisX + a);
        for (size_t a = 0; a < 3; ++a)
            tint_[a].turnTo(*job_->store, stored::TintRed + a);
    }

    /// Writes the rows [begin, end).
    /// @tparam kPlain ParticleProgram::plain
    /// @tparam kStream true: plain columns are written with non-temporal stores; false:
    ///         AppearanceColumns::stream decides
    template <bool kBallistic, bool kBrief, bool kPlain, bool kStream>
    void run(uint32_t begin, uint32_t end, AppearanceBounds& outBounds) const
    {
        runWith<kPlain, kStream>(MotionReader<kBallistic, kBrief>(*job_), begin, end, outBounds);
        leaveVectors();
    }
    template <bool kPlain, bool kStream, class Reader>
    HWY_INLINE void runWith(const Reader& reader, uint32_t begin, uint32_t end,
                            AppearanceBounds& outBounds) const
    {
        const bool moving = !kPlain && (out_.velocity[0] || job_->program->bySpeed);
        const bool stream = kPlain ? kStream : out_.stream;
        BoundsLanes bounds;
        Pieces pieces;
        for (uint32_t row = begin; row < end;) {
            const uint32_t inside = std::min(insideFrom(row), end);
            for (; row < inside; row += kWidth) {
                if (stream) { // the data are read from memory
                    reader.fetch(row + kAhead);
                    fetch<kPlain>(row + kAhead);
                }
                const MotionLanes motion =
                    moving ? reader.template read<true, true>(row) : reader.template read<false, true>(row);
                const Which alive = hn::Lt(motion.life, all(1.0f)); // false for NaN
                if (HWY_LIKELY(hn::AllTrue(kFloats, alive)))
                    write<kPlain, kStream, true>(row, alive, motion, pieces, bounds);
                else
                    write<kPlain, kStream, false>(row, alive, motion, pieces, bounds);
            }
            if (row >= end)
                break;
            if (row >= job_->rows.gapBegin && row + kWidth <= job_->rows.gapEnd) {
                writeNobody(row);
            } else {
                const MotionLanes motion =
                    moving ? reader.template read<true, true>(row) : reader.template read<false, true>(row);
                const Which alive = hn::And(hn::Lt(motion.life, all(1.0f)), inWindow(row));
                write<kPlain, kStream, false>(row, alive, motion, pieces, bounds);
            }
            row += kWidth;
        }
        bounds.store(outBounds);
    }
    /// Executes vzeroupper, which the compiler omits here. Without this instruction, the transition from AVX
    /// to SSE costs 60 ns.
    static HWY_INLINE void leaveVectors()
    {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
        _mm256_zeroupper();
#endif
    }

private:
    /// Prefetch distance in rows. The distance covers the latency of memory, and the prefetched data fit into
    /// a cache.
    static constexpr uint32_t kAhead = 256;

    /// Indices of the curve pieces that the previous particles used.
    struct Pieces
    {
        uint32_t life = 0;
        uint32_t speed = 0;
    };

    HWY_INLINE void put(Floats value, float* to) const
    {
        put(value, to, out_.stream);
    }
    static HWY_INLINE void put(Floats value, float* to, bool stream)
    {
        if (stream)
            hn::Stream(value, kFloats, to);
        else
            hn::Store(value, kFloats, to);
    }
    static HWY_INLINE void putColor(const ColorLanes& color, uint64_t* to, bool stream)
    {
        if (stream) {
            hn::Stream(color.low, kWides, to);
            hn::Stream(color.high, kWides, to + kWidth / 2);
        } else {
            hn::Store(color.low, kWides, to);
            hn::Store(color.high, kWides, to + kWidth / 2);
        }
    }
    /// Mask of the rows that are in the window and outside of its gap.
    HWY_INLINE Which inWindow(uint32_t row) const
    {
        const auto rows = hn::Add(hn::Iota(kInts, 0), hn::Set(kInts, int32_t(row)));
        const auto lower = hn::Lt(rows, hn::Set(kInts, int32_t(job_->rows.gapBegin)));
        const auto upper = hn::And(hn::Gt(rows, hn::Set(kInts, int32_t(job_->rows.gapEnd) - 1)),
                                   hn::Lt(rows, hn::Set(kInts, int32_t(job_->rows.count))));
        return hn::RebindMask(kFloats, hn::Or(lower, upper));
    }
    /// End of the whole vectors that begin at `row` and lie completely in the window.
    uint32_t insideFrom(uint32_t row) const
    {
        const RowWindow& rows = job_->rows;
        if (rows.gapBegin < rows.gapEnd && row < rows.gapEnd)
            return std::max(row, std::min(rows.gapBegin, rows.count) / kWidth * kWidth);
        return std::max(row, rows.count / kWidth * kWidth);
    }

    /// Prefetches data for write().
    template <bool kPlain>
    HWY_INLINE void fetch(uint32_t row) const
    {
        radius_.fetch(row);
        amount_.fetch(row);
        if constexpr (kPlain)
            return;
        for (const Source* source : {&brightness_, &angle_, &spin_, &frame_})
            source->fetch(row);
        for (size_t a = 0; a < 3; ++a) {
            axis_[a].fetch(row);
            tint_[a].fetch(row);
        }
    }

    void writeNobody(uint32_t row) const;
    /// Writes one vector of particles.
    /// @tparam kFull true if all particles of the vector are alive
    template <bool kPlain, bool kStream, bool kFull>
    HWY_INLINE void write(uint32_t row, Which alive, const MotionLanes& motion, Pieces& pieces,
                          BoundsLanes& bounds) const;
    HWY_INLINE void writeMore(uint32_t row, Which alive, const MotionLanes& motion) const;
    HWY_INLINE void addMoving(Which alive, const MotionLanes& motion, Floats radius,
                              BoundsLanes& bounds) const;
    HWY_INLINE void writeOrientation(uint32_t row, Which alive, Floats angle) const;
    HWY_INLINE Floats frameAt(uint32_t row, const MotionLanes& motion) const;

    const AppearanceJob* job_;
    const EmitterAppearance& appearance_;
    const AppearanceColumns& out_;
    Source radius_, amount_, brightness_, angle_, spin_, frame_;
    Source axis_[3];
    Source tint_[3];
    float frames_;
    bool bright_;
};

template <bool kPlain, bool kStream, bool kFull>
HWY_INLINE void AppearanceLanes::write(uint32_t row, Which alive, const MotionLanes& motion, Pieces& pieces,
                                       BoundsLanes& bounds) const
{
    const auto ofAlive = [alive](Floats x) HWY_ATTR { return kFull ? x : hn::IfThenElseZero(alive, x); };
    const CurveLanes curves(job_->program->byLife, motion.life, pieces.life);
    Floats radius = radius_.at(row) * hn::Max(curves.value(appearance_channel::Size), all(1e-4f));
    Floats rgb[3] = {curves.value(appearance_channel::Red), curves.value(appearance_channel::Green),
                     curves.value(appearance_channel::Blue)};
    Floats opacity = amount_.at(row) * curves.value(appearance_channel::Opacity);
    if (!kPlain && job_->program->bySpeed) {
        const Floats* v = motion.velocity;
        const Floats speed = hn::Sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        const CurveLanes fast(*job_->program->bySpeed,
                              hn::Min(speed * all(1.0f / appearance_.fastest), all(1.0f)), pieces.speed);
        radius = radius * hn::Max(fast.value(appearance_channel::Size), all(1e-4f));
        opacity = opacity * fast.value(appearance_channel::Opacity);
        for (uint32_t c = 0; c < 3; ++c)
            rgb[c] = rgb[c] * fast.value(c);
    }
    if (!kPlain && tint_[0].rows)
        for (uint32_t c = 0; c < 3; ++c)
            rgb[c] = rgb[c] * tint_[c].at(row);
    for (Floats& c : rgb) {
        if (!kPlain && bright_)
            c = c * brightness_.at(row);
        c = ofAlive(kPlain ? c : boundedForHalf(c));
    }
    opacity = ofAlive(hn::Max(hn::Min(opacity, all(1.0f)), hn::Zero(kFloats)));
    radius = ofAlive(radius);
    const bool stream = kPlain ? kStream : out_.stream;
    put(ofAlive(motion.position[0]), out_.x + row, stream);
    put(ofAlive(motion.position[1]), out_.y + row, stream);
    put(ofAlive(motion.position[2]), out_.z + row, stream);
    put(ofAlive(motion.age), out_.age + row, stream);
    put(radius, out_.radius + row, stream);
    putColor(packColor(rgb, opacity), out_.color + row, stream);
    if (!kPlain && out_.velocity[0])
        addMoving(alive, motion, radius, bounds);
    else
        bounds.add<kFull>(alive, motion.position, radius);
    if (!kPlain)
        writeMore(row, alive, motion);
}

/// Extends the bounds. Sprites are stretched along their path unless they rotate. Particles born since the
/// previous snapshot are drawn along their path since birth. The age of a particle does not show whether it
/// was born since then, because the instance's time may run faster.
HWY_INLINE void AppearanceLanes::addMoving(Which alive, const MotionLanes& motion, Floats radius,
                                           BoundsLanes& bounds) const
{
    const Floats* v = motion.velocity;
    const Floats along = all(job_->program->along);
    const Floats back = hn::Min(motion.age, all(kRoundedUp * job_->secondsBack)) + along;
    Floats head[3], tail[3];
    for (int a = 0; a < 3; ++a) {
        head[a] = motion.position[a] + v[a] * along;
        tail[a] = motion.position[a] - v[a] * back;
    }
    const Floats speed = hn::Sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    bounds.add<false>(alive, head, hn::IfThenElseZero(alive, radius + all(job_->program->across) * speed));
    bounds.add<false>(alive, tail, hn::Zero(kFloats));
}

HWY_INLINE void AppearanceLanes::writeMore(uint32_t row, Which alive, const MotionLanes& motion) const
{
    if (out_.velocity[0])
        for (int a = 0; a < 3; ++a)
            put(hn::IfThenElseZero(alive, motion.velocity[a]), out_.velocity[a] + row);
    if (out_.angle || out_.orientation[0]) {
        const Floats angle = angle_.at(row) + spin_.at(row) * motion.age;
        if (out_.angle)
            put(hn::IfThenElseZero(alive, angle), out_.angle + row);
        else
            writeOrientation(row, alive, angle);
    }
    if (out_.frame)
        put(hn::IfThenElseZero(alive, frameAt(row, motion)), out_.frame + row);
    if (out_.index)
        for (uint32_t i = 0; i < kWidth; ++i)
            out_.index[row + i] = job_->store->index[row + i];
}

/// Writes the rotation by an angle about the particle's axis.
HWY_INLINE void AppearanceLanes::writeOrientation(uint32_t row, Which alive, Floats angle) const
{
    const SinCosLanes half = sinCosTurns(angle * all(0.0795774715f)); // half of it, in turns
    for (int a = 0; a < 3; ++a)
        put(hn::IfThenElseZero(alive, half.sin * axis_[a].at(row)), out_.orientation[a] + row);
    put(hn::IfThenElseZero(alive, half.cos), out_.orientation[3] + row);
}

HWY_INLINE Floats AppearanceLanes::frameAt(uint32_t row, const MotionLanes& motion) const
{
    const Floats first = frame_.at(row);
    if (appearance_.frames == FrameClock::OverLife)
        return first + motion.life * all(frames_);
    if (appearance_.frames == FrameClock::None)
        return first;
    const Floats gone = first + motion.age * all(appearance_.framesPerSecond);
    return gone - hn::Floor(gone * all(1.0f / frames_)) * all(frames_);
}

inline void AppearanceLanes::writeNobody(uint32_t row) const
{
    const Floats zero = hn::Zero(kFloats);
    for (float* column : {out_.x, out_.y, out_.z, out_.age, out_.radius, out_.velocity[0], out_.velocity[1],
                          out_.velocity[2], out_.angle, out_.frame, out_.orientation[0], out_.orientation[1],
                          out_.orientation[2], out_.orientation[3]})
        if (column)
            put(zero, column + row);
    putColor({hn::Zero(kWides), hn::Zero(kWides)}, out_.color + row, out_.stream);
}

} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
