/// @formula vortex-air
/// Air around an axis, and what keeps a particle on its circle.
///
/// symbol   unit   meaning
///   k       1      unit vector along the axis
///   r, R    m      way from the axis to the particle (a vector), radius of the fastest air
///   S, P, U m/s    speeds of the air: around, inwards, along the axis
///   t       m      k x r: where the turning goes, as long as r
///   w       1/s    v.t / r^2: how fast the particle turns by itself
///   T       s      length of the step
/// @derivation
///   The air turns with S f, f = 2 (r/R) / (1 + (r/R)^2): f = 1 at R, rigid inside, 1/r outside:
///       u = 2 R / (R^2 + r^2) (S t - P r) + R^2 / (R^2 + r^2) U k                              (1)
///   A step under a constant acceleration a moves by v T + a T^2 / 2. With q = w T / 2 and
///       a = -w^2 / (1 + q^2) (r + q t)                                                         (2)
///   the velocity turns by the angle 2 arctan q and the place turns by the same angle around the axis, so
///   that distance and speed stay as they are for any step.
/// @source    (1) is the vortex of [SCU75]; (2) elementary (the Cayley form of a rotation)
/// @deviation none
/// @valid     R > 0; at the axis itself nothing turns; (2) is stable for |q| <= 1/2, a turn of a radian in a
/// step
/// @accuracy  (2) keeps r within float rounding of each step, without drag and other forces
/// @tests     tests/simulation/particles/modules/test_forces.cpp
#include "simulation/particles/forces/force_ops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/forces/vortex_op.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "simulation/particles/fields/turn.h"
#include "simulation/particles/forces/force_constants.h"
#include "simulation/particles/forces/force_op.h"
#include "simulation/particles/forces/tile_lanes-inl.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::modules::HWY_NAMESPACE {
namespace {

void runVortex(const VortexDef& def, Tile& tile)
{
    const VortexConstants constants(def);
    const Float3 center = all(def.position), axis = all(def.axis);
    const Float squared = all(constants.squared), one = all(1.0f);
    const Float around = all(constants.around), inwards = all(constants.inwards);
    const Float along = all(constants.along);
    const bool holds = def.hold > 0.0f;
    for (uint32_t i = 0; i < tile.padded; i += uint32_t(hn::Lanes(Floats()))) {
        const Float3 way = minus(loadPosition(tile, i), center);
        const Float3 r = minus(way, times(axis, dot(way, axis)));
        const Float3 t = cross(axis, r);
        const Float rr = dot(r, r);
        const Float part = hn::Div(one, hn::Add(squared, rr));
        Float3 air = times(t, hn::Mul(around, part)); // (1)
        air = minus(air, times(r, hn::Mul(inwards, part)));
        addAir(tile, i, plus(air, times(axis, hn::Mul(along, part))));
        if (!holds)
            continue;
        const Float w = hn::Div(dot(loadVelocity(tile, i), t), hn::Max(rr, all(1e-12f)));
        const Float q = hn::Mul(hn::Mul(w, loadRow(tile.seconds + i)), all(0.5f));
        const Float pull = hn::Div(hn::Mul(hn::Mul(w, w), all(-def.hold)), hn::Add(one, hn::Mul(q, q)));
        addAcceleration(tile, i, times(plus(r, times(t, q)), pull)); // (2)
    }
}

} // namespace
} // namespace fx::sim::modules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace {

using namespace modules;
HWY_EXPORT(runVortex);

TileBound boundOf(const VortexDef& def)
{
    const float air = std::abs(def.speed) + std::abs(def.lift) + std::abs(def.pull);
    return {def.hold * def.speed * def.speed / def.radius, air, false};
}

/// See GpuModuleSource.
bool describe(const VortexDef& def, base::GpuModules& out)
{
    const glm::vec3 &p = def.position, &k = def.axis;
    const VortexConstants constants(def);
    out.add(def.hold > 0.0f ? base::GpuModule::HoldingVortex : base::GpuModule::Vortex,
            {p.x, p.y, p.z, k.x, k.y, k.z, constants.squared, constants.around, constants.inwards,
             constants.along, -def.hold});
    return true;
}

} // namespace

std::unique_ptr<TileOp> makeVortexOp(const VortexDef& def)
{
    VortexDef kept = def;
    kept.axis = unitOrUp(def.axis);
    kept.radius = std::max(def.radius, 1e-4f);
    kept.hold = std::clamp(def.hold, 0.0f, 1.0f);
    return makeForceOp(kept, boundOf(kept), describe, FX_FORCE_KERNEL(runVortex));
}

} // namespace fx::sim
#endif
