#include "simulation/particles/builtin_ops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/ground_lanes.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/motion/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fx::sim::particles::HWY_NAMESPACE {
namespace {

HWY_INLINE Floats clampedShare(Floats share)
{
    return hn::Min(hn::Max(share, hn::Zero(kFloats)), all(1.0f));
}

/// Numbers in brackets are those of ground-bounce.
HWY_INLINE void bounceRows(const GroundContact& ground, Tile& tile, uint32_t i, Which below)
{
    float* const x[3] = {tile.x + i, tile.y + i, tile.z + i};
    float* const v[3] = {tile.vx + i, tile.vy + i, tile.vz + i};
    const float* const fromX[3] = {tile.fromX + i, tile.fromY + i, tile.fromZ + i};
    const float* const fromV[3] = {tile.fromVX + i, tile.fromVY + i, tile.fromVZ + i};
    const Floats height = all(ground.height);
    const Floats above = hn::Load(kFloats, fromX[1]) - height;
    const Floats drop = hn::Load(kFloats, fromX[1]) - hn::Load(kFloats, x[1]);
    const Floats met = clampedShare(above / drop);
    const Floats f = hn::IfThenElseZero(hn::Gt(drop, hn::Zero(kFloats)), met); // (1)
    const Floats rest = all(1.0f) - f;
    const Floats seconds = hn::Load(kFloats, tile.seconds + i);
    const Floats way = rest * seconds;
    const Floats bend = all(0.5f) * rest * rest * seconds;
    const Floats grip = all(1.0f - ground.friction);
    Floats position[3], velocity[3];
    for (int a = 0; a < 3; ++a) {
        const Floats start = hn::Load(kFloats, fromV[a]);
        const Floats change = hn::Load(kFloats, v[a]) - start;
        velocity[a] = start + f * change; // (2)
        velocity[a] =
            a == 1 ? hn::Max(all(-ground.restitution) * velocity[a], hn::Zero(kFloats)) : velocity[a] * grip;
        const Floats from = hn::Load(kFloats, fromX[a]);
        position[a] = from + f * (hn::Load(kFloats, x[a]) - from);
        position[a] = position[a] + (way * velocity[a] + bend * change); // (3)
        velocity[a] = velocity[a] + rest * change;
    }
    const Which lies = hn::Le(position[1], height); // (4)
    position[1] = hn::IfThenElse(lies, height, position[1]);
    velocity[1] = hn::IfThenZeroElse(lies, velocity[1]);
    for (int a = 0; a < 3; ++a) {
        hn::Store(hn::IfThenElse(below, position[a], hn::Load(kFloats, x[a])), kFloats, x[a]);
        hn::Store(hn::IfThenElse(below, velocity[a], hn::Load(kFloats, v[a])), kFloats, v[a]);
    }
    hn::Store(hn::IfThenElse(below, met, hn::Load(kFloats, tile.contact + i)), kFloats, tile.contact + i);
    const Words flags = hn::Load(kWords, tile.flags + i);
    const Words marks = hn::Set(kWords, uint32_t(tile_flag::Hit | tile_flag::Collided));
    hn::Store(hn::IfThenElse(hn::RebindMask(kWords, below), hn::Or(flags, marks), flags), kWords,
              tile.flags + i);
}

void bounceTileLanes(const GroundContact& ground, Tile& tile)
{
    const Words still = hn::Set(kWords, uint32_t(tile_flag::Empty | tile_flag::Stuck));
    for (uint32_t i = 0; i < tile.padded; i += kWidth) {
        const Words flags = hn::And(hn::Load(kWords, tile.flags + i), still);
        const Which moves = hn::RebindMask(kFloats, hn::Eq(flags, hn::Zero(kWords)));
        const Which below = hn::And(moves, hn::Lt(hn::Load(kFloats, tile.y + i), all(ground.height)));
        if (!hn::AllFalse(kFloats, below))
            bounceRows(ground, tile, i, below);
    }
}

} // namespace
} // namespace fx::sim::particles::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace particles {
namespace {
HWY_EXPORT(bounceTileLanes);
} // namespace
} // namespace particles

void bounceTile(const GroundContact& ground, Tile& tile)
{
    using namespace particles;
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(bounceTileLanes)(ground, tile);
}

} // namespace fx::sim
#endif
