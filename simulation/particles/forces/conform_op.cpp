/// @formula conform-spring
/// A damped spring along the normal of a surface, stable for any step.
///
/// symbol   unit   meaning
///   d       m      distance of the particle from where it is to be, signed
///   n, v    1, m/s normal of the surface there, velocity along it
///   k, c    1/s2, 1/s stiffness and damping
///   T       s      length of the step
/// @derivation
///   The implicit step, with the force at the end, v' = v - T (k (d + T v') + c v'), has
///       a = (v' - v) / T = -(k d + (c + k T) v) / (1 + c T + k T^2)                             (1)
///   With d' = d + v T + a T^2 / 2 the step has the determinant 1 - C + K/2 and the trace 2 - C - K/2, where
///   K = k T^2 / (1 + c T + k T^2) < 1 and K/2 < C <= 1, so both eigenvalues stay inside of the unit circle
///   for every k, c and T.                                                                        (2)
/// @source    elementary (backward Euler)
/// @deviation none
/// @valid     k, c, T >= 0
/// @accuracy  first order in T
/// @tests     tests/simulation/particles/modules/test_forces.cpp
#include "simulation/particles/forces/force_ops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/forces/conform_op.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "simulation/particles/forces/force_op.h"
#include "simulation/particles/forces/tile_lanes-inl.h"

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::modules::HWY_NAMESPACE {
namespace {

/// Signed distance to a surface, and its normal.
struct Near
{
    Float distance;
    Float3 normal;
};

HWY_INLINE Near nearSphere(const ConformDef& def, const Float3& p)
{
    const Float size = hn::Sqrt(dot(p, p));
    const Float per = hn::Div(all(1.0f), hn::Max(size, all(1e-12f)));
    return {hn::Sub(size, all(def.size.x)), times(p, per)};
}

HWY_INLINE Near nearBox(const ConformDef& def, const Float3& p)
{
    const Float zero = hn::Zero(Floats());
    const Float3 q{hn::Sub(hn::Abs(p.x), all(def.size.x)), hn::Sub(hn::Abs(p.y), all(def.size.y)),
                   hn::Sub(hn::Abs(p.z), all(def.size.z))};
    const Float3 out{hn::Max(q.x, zero), hn::Max(q.y, zero), hn::Max(q.z, zero)};
    const Float outside = hn::Sqrt(dot(out, out));
    const Float most = hn::Max(q.x, hn::Max(q.y, q.z));
    const auto isOut = hn::Gt(outside, zero);
    const Float per = hn::Div(all(1.0f), hn::Max(outside, all(1e-12f)));
    // Inside, the nearest face; of equally near ones the first.
    const auto onX = hn::Eq(q.x, most), onY = hn::AndNot(onX, hn::Eq(q.y, most));
    const auto onZ = hn::Not(hn::Or(onX, onY));
    const auto part = [&](Float o, hn::Mask<Floats> on, Float place) HWY_ATTR {
        const Float size = hn::IfThenElse(isOut, hn::Mul(o, per), hn::IfThenElseZero(on, all(1.0f)));
        return hn::CopySign(size, place);
    };
    return {hn::Add(outside, hn::Min(most, zero)),
            {part(out.x, onX, p.x), part(out.y, onY, p.y), part(out.z, onZ, p.z)}};
}

/// The field has no form for many places at once: its samples are gathered first.
struct MeshSamples
{
    alignas(64) float distance[kTilePadding], x[kTilePadding], y[kTilePadding], z[kTilePadding];

    Near take(const ConformDef& def, const Tile& tile, uint32_t i)
    {
        for (uint32_t k = 0; k < uint32_t(hn::Lanes(Floats())); ++k) {
            const glm::vec3 p(tile.x[i + k], tile.y[i + k], tile.z[i + k]);
            const DistanceField::Sample s = def.field->sample(p - def.position);
            distance[k] = s.distance;
            x[k] = s.normal.x;
            y[k] = s.normal.y;
            z[k] = s.normal.z;
        }
        return {loadRow(distance), {loadRow(x), loadRow(y), loadRow(z)}};
    }
};

void runConform(const ConformDef& def, Tile& tile)
{
    const Float stiffness = all(def.stiffness), damping = all(def.damping);
    const Float reach = all(def.reach > 0.0f ? def.reach : std::numeric_limits<float>::max());
    MeshSamples samples;
    for (uint32_t i = 0; i < tile.padded; i += uint32_t(hn::Lanes(Floats()))) {
        const Float3 p = minus(loadPosition(tile, i), all(def.position));
        const Near near = def.kind == SurfaceKind::Mesh     ? samples.take(def, tile, i)
                          : def.kind == SurfaceKind::Sphere ? nearSphere(def, p)
                                                            : nearBox(def, p);
        const Float d = hn::Sub(near.distance, all(def.distance));
        const Float v = dot(loadVelocity(tile, i), near.normal);
        const Float t = loadRow(tile.seconds + i);
        const Float kt = hn::Mul(stiffness, t);
        const Float pull = hn::Add(hn::Mul(stiffness, d), hn::Mul(hn::Add(damping, kt), v)); // (1)
        const Float part = hn::Add(all(1.0f), hn::Mul(hn::Add(damping, kt), t));
        const Float a = hn::Neg(hn::Div(pull, part));
        addAcceleration(tile, i, times(near.normal, hn::IfThenElseZero(hn::Le(hn::Abs(d), reach), a)));
    }
}

} // namespace
} // namespace fx::sim::modules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace {

using namespace modules;
HWY_EXPORT(runConform);

TileBound boundOf(const ConformDef& def)
{
    if (def.stiffness > 0.0f && !(def.reach > 0.0f))
        return {};
    return {def.stiffness * (def.reach + std::abs(def.distance))};
}

/// See GpuModuleSource.
bool describe(const ConformDef& def, base::GpuModules& out)
{
    if (def.kind == SurfaceKind::Mesh)
        return false;
    const glm::vec3 &p = def.position, &size = def.size;
    const float reach = def.reach > 0.0f ? def.reach : std::numeric_limits<float>::max();
    out.add(def.kind == SurfaceKind::Sphere ? base::GpuModule::ConformSphere : base::GpuModule::ConformBox,
            {p.x, p.y, p.z, size.x, size.y, size.z, def.distance, def.stiffness, def.damping, reach});
    return true;
}

} // namespace

std::unique_ptr<TileOp> makeConformOp(const ConformDef& def)
{
    ConformDef kept = def;
    kept.stiffness = std::max(def.stiffness, 0.0f);
    kept.damping = std::max(def.damping, 0.0f);
    return makeForceOp(kept, boundOf(kept), describe, FX_FORCE_KERNEL(runConform));
}

} // namespace fx::sim
#endif
