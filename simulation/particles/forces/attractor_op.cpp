/// @formula attraction
/// Acceleration towards a point.
///
/// symbol   unit   meaning
///   d       m      way from the particle to the point
///   e       m      softening
///   S, R    m/s2, m strength, and the distance that has it
///   n       1      -1 spring, 0 constant, 1 inverse, 2 inverse square
/// @derivation
///   s = (d^2 + e^2)^(1/2), a = S R^n d / s^(n+1)                                            (1)
///   which is the gradient of a potential, so that energy is kept where steps are short.
/// @source    elementary
/// @deviation none
/// @valid     R > 0; at the point itself a = 0
/// @accuracy  float rounding
/// @tests     tests/simulation/particles/modules/test_forces.cpp
#include "simulation/particles/forces/force_ops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/forces/attractor_op.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "simulation/particles/forces/force_constants.h"
#include "simulation/particles/forces/force_op.h"
#include "simulation/particles/forces/tile_lanes-inl.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::modules::HWY_NAMESPACE {
namespace {

/// 1 / s^(n+1)
template <Falloff F>
HWY_INLINE Float slope(Float squared)
{
    if constexpr (F == Falloff::Spring)
        return all(1.0f);
    if constexpr (F == Falloff::Constant)
        return hn::Div(all(1.0f), hn::Sqrt(squared));
    if constexpr (F == Falloff::Inverse)
        return hn::Div(all(1.0f), squared);
    return hn::Div(all(1.0f), hn::Mul(squared, hn::Sqrt(squared)));
}

template <Falloff F>
void attract(const AttractorDef& def, Tile& tile)
{
    const AttractorConstants constants(def);
    const Float3 center = all(def.position);
    const Float softening = all(constants.softening);
    for (uint32_t i = 0; i < tile.padded; i += uint32_t(hn::Lanes(Floats()))) {
        const Float3 d = minus(center, loadPosition(tile, i));
        const Float dd = dot(d, d);
        const Float share = hn::Mul(all(constants.factor), slope<F>(hn::Add(dd, softening))); // (1)
        addAcceleration(tile, i, times(d, hn::IfThenElseZero(hn::Le(dd, all(constants.reach)), share)));
    }
}

void runAttractor(const AttractorDef& def, Tile& tile)
{
    switch (def.falloff) {
    case Falloff::Spring:
        return attract<Falloff::Spring>(def, tile);
    case Falloff::Constant:
        return attract<Falloff::Constant>(def, tile);
    case Falloff::Inverse:
        return attract<Falloff::Inverse>(def, tile);
    case Falloff::InverseSquare:
        return attract<Falloff::InverseSquare>(def, tile);
    }
}

} // namespace
} // namespace fx::sim::modules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace {

using namespace modules;
HWY_EXPORT(runAttractor);

TileBound boundOf(const AttractorDef& def)
{
    const float s = std::abs(def.strength), ratio = def.radius / std::max(def.softening, 1e-30f);
    switch (def.falloff) {
    case Falloff::Spring: // grows without end unless it ends somewhere
        return def.reach > 0.0f ? TileBound{s * def.reach / def.radius} : TileBound{};
    case Falloff::Constant:
        return {s};
    case Falloff::Inverse:
        return {s * ratio};
    case Falloff::InverseSquare:
        break;
    }
    return {s * ratio * ratio};
}

/// See GpuModuleSource.
bool describe(const AttractorDef& def, base::GpuModules& out)
{
    const AttractorConstants constants(def);
    const glm::vec3& p = def.position;
    constexpr base::GpuModule kModules[] = {base::GpuModule::Spring, base::GpuModule::Constant,
                                            base::GpuModule::Inverse, base::GpuModule::InverseSquare};
    out.add(kModules[size_t(def.falloff)],
            {p.x, p.y, p.z, constants.softening, constants.reach, constants.factor});
    return true;
}

} // namespace

std::unique_ptr<TileOp> makeAttractorOp(const AttractorDef& def)
{
    AttractorDef kept = def;
    kept.radius = std::max(def.radius, 1e-4f);
    return makeForceOp(kept, boundOf(kept), describe, FX_FORCE_KERNEL(runAttractor));
}

} // namespace fx::sim
#endif
