/// @file look_lanes-inl.h
/// The pass that writes the kind "particle". Included once for each instruction set.
#if defined(FX_PARTICLE_LOOK_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_PARTICLE_LOOK_LANES_INL
#undef FX_PARTICLE_LOOK_LANES_INL
#else
#define FX_PARTICLE_LOOK_LANES_INL
#endif

#include "simulation/particles/color_lanes-inl.h"
#include "simulation/particles/motion_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {

/// Box and radius in lanes.
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
    HWY_INLINE void add(Which alive, const Floats* position, Floats r)
    {
        for (int a = 0; a < 3; ++a) {
            low[a] = hn::IfThenElse(alive, hn::Min(low[a], position[a]), low[a]);
            high[a] = hn::IfThenElse(alive, hn::Max(high[a], position[a]), high[a]);
        }
        radius = hn::Max(radius, r); // that of nobody is 0
    }
    HWY_INLINE void addTo(LookBounds& bounds) const
    {
        LookBounds found;
        for (int a = 0; a < 3; ++a) {
            found.low[a] = hn::GetLane(hn::MinOfLanes(kFloats, low[a]));
            found.high[a] = hn::GetLane(hn::MaxOfLanes(kFloats, high[a]));
        }
        found.radius = hn::GetLane(hn::MaxOfLanes(kFloats, radius));
        bounds.add(found);
    }
};

class Looks
{
public:
    Looks(const LookJob& job, const LookColumns& out)
        : job_(job), look_(job.program->def.look), out_(out), radius_(*job.store, stored::Radius),
          amount_(*job.store, stored::Amount), brightness_(*job.store, stored::Brightness),
          angle_(*job.store, stored::Angle), spin_(*job.store, stored::Spin),
          frame_(*job.store, stored::Frame), axis_{{*job.store, stored::AxisX},
                                                   {*job.store, stored::AxisY},
                                                   {*job.store, stored::AxisZ}},
          frames_(float(look_.tileColumns * look_.tileRows)),
          bright_(brightness_.rows || brightness_.constant != 1.0f),
          stretch_(look_.alignment == base::SpriteAlignment::Velocity && look_.kind == Appearance::Sprite
                       ? 0.5f * look_.stretch
                       : 0.0f)
    {}

    template <bool kBallistic, bool kBrief>
    void run(uint32_t begin, uint32_t end, LookBounds& outBounds) const
    {
        const MotionReader<kBallistic, kBrief> reader(job_);
        const bool moving = out_.velocity[0] || job_.program->bySpeed;
        BoundsLanes bounds;
        for (uint32_t row = begin; row < end; row += kWidth) {
            if (row >= job_.rows.gapBegin && row + kWidth <= job_.rows.gapEnd) {
                writeNobody(row);
                continue;
            }
            if (moving)
                write(row, reader.template read<true>(row), bounds);
            else
                write(row, reader.template read<false>(row), bounds);
        }
        bounds.addTo(outBounds);
    }

private:
    HWY_INLINE void put(Floats value, float* to) const
    {
        if (out_.stream)
            hn::Stream(value, kFloats, to);
        else
            hn::Store(value, kFloats, to);
    }
    HWY_INLINE void putColor(const ColorLanes& color, uint64_t* to) const
    {
        if (out_.stream) {
            hn::Stream(color.low, kWides, to);
            hn::Stream(color.high, kWides, to + kWidth / 2);
        } else {
            hn::Store(color.low, kWides, to);
            hn::Store(color.high, kWides, to + kWidth / 2);
        }
    }
    /// Rows that are neither in the gap nor beyond the window.
    HWY_INLINE Which inWindow(uint32_t row) const
    {
        const auto rows = hn::Add(hn::Iota(kInts, 0), hn::Set(kInts, int32_t(row)));
        const auto lower = hn::Lt(rows, hn::Set(kInts, int32_t(job_.rows.gapBegin)));
        const auto upper = hn::And(hn::Gt(rows, hn::Set(kInts, int32_t(job_.rows.gapEnd) - 1)),
                                   hn::Lt(rows, hn::Set(kInts, int32_t(job_.rows.count))));
        return hn::RebindMask(kFloats, hn::Or(lower, upper));
    }
    HWY_INLINE bool touchesBorder(uint32_t row) const
    {
        const RowWindow& rows = job_.rows;
        return row + kWidth > rows.count ||
               (rows.gapBegin < rows.gapEnd && row < rows.gapEnd && row + kWidth > rows.gapBegin);
    }

    void writeNobody(uint32_t row) const;
    HWY_INLINE void write(uint32_t row, const MotionLanes& motion, BoundsLanes& bounds) const;
    HWY_INLINE void writeMore(uint32_t row, Which alive, const MotionLanes& motion) const;
    HWY_INLINE void addMoving(Which alive, const MotionLanes& motion, Floats radius,
                              BoundsLanes& bounds) const;
    HWY_INLINE void writeOrientation(uint32_t row, Which alive, Floats angle) const;
    HWY_INLINE Floats frameAt(uint32_t row, const MotionLanes& motion) const;

    const LookJob& job_;
    const EmitterLook& look_;
    const LookColumns& out_;
    Source radius_, amount_, brightness_, angle_, spin_, frame_;
    Source axis_[3];
    float frames_;
    bool bright_;
    float stretch_; ///< [s] half of it lengthens a sprite to each side
};

HWY_INLINE void Looks::write(uint32_t row, const MotionLanes& motion, BoundsLanes& bounds) const
{
    Which alive = hn::Lt(motion.life, all(1.0f)); // false for NaN
    if (HWY_UNLIKELY(touchesBorder(row)))
        alive = hn::And(alive, inWindow(row));
    const CurveLanes looks(job_.program->looks, motion.life);
    Floats radius = radius_.at(row) * hn::Max(looks.value(look_channel::Size), all(1e-4f));
    Floats rgb[3] = {looks.value(look_channel::Red), looks.value(look_channel::Green),
                     looks.value(look_channel::Blue)};
    Floats opacity = amount_.at(row) * looks.value(look_channel::Opacity);
    if (job_.program->bySpeed) {
        const Floats* v = motion.velocity;
        const Floats speed = hn::Sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        const CurveLanes fast(*job_.program->bySpeed, hn::Min(speed * all(1.0f / look_.fastest), all(1.0f)));
        radius = radius * hn::Max(fast.value(look_channel::Size), all(1e-4f));
        opacity = opacity * fast.value(look_channel::Opacity);
        for (uint32_t c = 0; c < 3; ++c)
            rgb[c] = rgb[c] * fast.value(c);
    }
    if (bright_)
        for (Floats& c : rgb)
            c = c * brightness_.at(row);
    radius = hn::IfThenElseZero(alive, radius);
    put(hn::IfThenElseZero(alive, motion.position[0]), out_.x + row);
    put(hn::IfThenElseZero(alive, motion.position[1]), out_.y + row);
    put(hn::IfThenElseZero(alive, motion.position[2]), out_.z + row);
    put(hn::IfThenElseZero(alive, motion.age), out_.age + row);
    put(radius, out_.radius + row);
    putColor(packColor(alive, rgb, hn::Min(opacity, all(1.0f))), out_.color + row);
    if (out_.velocity[0])
        addMoving(alive, motion, radius, bounds);
    else
        bounds.add(alive, motion.position, radius);
    writeMore(row, alive, motion);
}

/// Sprites are longer by their way, and what was born since the snapshot before is drawn on its way from
/// where it was born.
HWY_INLINE void Looks::addMoving(Which alive, const MotionLanes& motion, Floats radius,
                                 BoundsLanes& bounds) const
{
    const Floats* v = motion.velocity;
    const Floats speed = hn::Sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    bounds.add(alive, motion.position, hn::IfThenElseZero(alive, radius + all(stretch_) * speed));
    const Which young = hn::And(alive, hn::Le(motion.age, all(kLongestStep)));
    const Floats start[3] = {motion.position[0] - v[0] * motion.age, motion.position[1] - v[1] * motion.age,
                             motion.position[2] - v[2] * motion.age};
    bounds.add(young, start, hn::Zero(kFloats));
}

HWY_INLINE void Looks::writeMore(uint32_t row, Which alive, const MotionLanes& motion) const
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
            out_.index[row + i] = job_.store->index[row + i];
}

/// The rotation by an angle about the particle's axis.
HWY_INLINE void Looks::writeOrientation(uint32_t row, Which alive, Floats angle) const
{
    const SinCosLanes half = sinCosTurns(angle * all(0.0795774715f)); // half of it, in turns
    for (int a = 0; a < 3; ++a)
        put(hn::IfThenElseZero(alive, half.sin * axis_[a].at(row)), out_.orientation[a] + row);
    put(hn::IfThenElseZero(alive, half.cos), out_.orientation[3] + row);
}

HWY_INLINE Floats Looks::frameAt(uint32_t row, const MotionLanes& motion) const
{
    const Floats first = frame_.at(row);
    if (look_.frames == FrameClock::OverLife)
        return first + motion.life * all(frames_);
    if (look_.frames == FrameClock::None)
        return first;
    const Floats gone = first + motion.age * all(look_.framesPerSecond);
    return gone - hn::Floor(gone * all(1.0f / frames_)) * all(frames_);
}

inline void Looks::writeNobody(uint32_t row) const
{
    const Floats zero = hn::Zero(kFloats);
    for (float* column : {out_.x, out_.y, out_.z, out_.age, out_.radius, out_.velocity[0], out_.velocity[1],
                          out_.velocity[2], out_.angle, out_.frame, out_.orientation[0], out_.orientation[1],
                          out_.orientation[2], out_.orientation[3]})
        if (column)
            put(zero, column + row);
    putColor({hn::Zero(kWides), hn::Zero(kWides)}, out_.color + row);
}

} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
