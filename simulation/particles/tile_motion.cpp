#include "simulation/particles/tile_motion.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/tile_motion.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/motion/lanes-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {
namespace {

void fillTimesLanes(const TileTimes& times, Tile& tile)
{
    const Floats whole = all(float(base::toSeconds(times.end - times.begin)));
    for (uint32_t i = 0; i < tile.padded; i += kWidth) {
        const Floats left = secondsOf(times.born + i, times.end);
        const Floats age = hn::Max(secondsOf(times.born + i, times.begin), hn::Zero(kFloats));
        const Floats perLife =
            times.perLife ? hn::LoadU(kFloats, times.perLife + i) : all(times.perLifeOfAll);
        const Floats life = age * perLife;
        const Words flags = hn::Load(kWords, tile.flags + i);
        const Words empty = hn::Set(kWords, uint32_t(tile_flag::Empty));
        const auto marked = hn::RebindMask(kFloats, hn::Eq(hn::And(flags, empty), empty));
        const Which alive = hn::AndNot(marked, hn::Lt(life, all(1.0f)));
        hn::Store(age, kFloats, tile.age + i);
        hn::Store(hn::IfThenElseZero(alive, hn::Min(left, whole)), kFloats, tile.seconds + i);
        hn::Store(hn::IfThenElse(alive, life, all(1.0f)), kFloats, tile.life + i);
        const Words marks = hn::IfThenElse(hn::RebindMask(kWords, alive), flags, hn::Or(flags, empty));
        hn::Store(marks, kWords, tile.flags + i);
    }
}

struct Axis
{
    float* x;
    float* v;
    float* from;
    float* fromV;
    const float* u;
    const float* a;
};

/// (2): what half the quadratic drag leaves of the velocity relative to the air.
HWY_INLINE void brake(const Axis* axes, Floats q, Floats halfTime, Floats* v, uint32_t i)
{
    Floats w[3];
    for (int a = 0; a < 3; ++a)
        w[a] = v[a] - hn::Load(kFloats, axes[a].u + i);
    const Floats speed = hn::Sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    const Floats keep = all(1.0f) / (all(1.0f) + q * speed * halfTime);
    for (int a = 0; a < 3; ++a)
        v[a] = hn::Load(kFloats, axes[a].u + i) + w[a] * keep;
}

void integrateLanes(Tile& tile)
{
    const Axis axes[3] = {{tile.x, tile.vx, tile.fromX, tile.fromVX, tile.ux, tile.ax},
                          {tile.y, tile.vy, tile.fromY, tile.fromVY, tile.uy, tile.ay},
                          {tile.z, tile.vz, tile.fromZ, tile.fromVZ, tile.uz, tile.az}};
    for (uint32_t i = 0; i < tile.padded; i += kWidth) {
        const Words rest = hn::Set(kWords, uint32_t(tile_flag::Stuck | tile_flag::Empty));
        const Words flags = hn::And(hn::Load(kWords, tile.flags + i), rest);
        const Which moves = hn::RebindMask(kFloats, hn::Eq(flags, hn::Zero(kWords)));
        const Floats t = hn::IfThenElseZero(moves, hn::Load(kFloats, tile.seconds + i));
        const Floats k = hn::Load(kFloats, tile.drag + i);
        const Floats q = hn::Load(kFloats, tile.quadratic + i);
        const DragLanes step = dragLanes<true>(k, all(1.0f) / hn::Max(k, all(1e-30f)), t);
        const Floats half = all(0.5f) * t;
        const bool quadratic = !hn::AllFalse(kFloats, hn::Gt(q, hn::Zero(kFloats)));
        Floats v[3];
        for (int a = 0; a < 3; ++a) {
            v[a] = hn::Load(kFloats, axes[a].v + i);
            hn::Store(v[a], kFloats, axes[a].fromV + i);
        }
        if (quadratic)
            brake(axes, q, half, v, i);
        for (int a = 0; a < 3; ++a) { // (3)
            const Floats x = hn::Load(kFloats, axes[a].x + i);
            const Floats pull = hn::Load(kFloats, axes[a].a + i) + k * hn::Load(kFloats, axes[a].u + i);
            hn::Store(x, kFloats, axes[a].from + i);
            hn::Store(x + step.gain * v[a] + step.ramp * pull, kFloats, axes[a].x + i);
            v[a] = step.decay * v[a] + step.gain * pull;
        }
        if (quadratic)
            brake(axes, q, half, v, i);
        for (int a = 0; a < 3; ++a)
            hn::Store(v[a], kFloats, axes[a].v + i);
    }
}

} // namespace
} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace particles {
namespace {
HWY_EXPORT(fillTimesLanes);
HWY_EXPORT(integrateLanes);
} // namespace
} // namespace particles

void fillTimes(const TileTimes& times, Tile& tile)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(fillTimesLanes)(times, tile);
}

void integrate(Tile& tile)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(integrateLanes)(tile);
}

} // namespace fx::sim
#endif
