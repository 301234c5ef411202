#include "simulation/particles/forces/force_ops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/forces/vector_field_op.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "simulation/particles/forces/force_constants.h"
#include "simulation/particles/forces/force_op.h"
#include "simulation/particles/forces/tile_lanes-inl.h"

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::modules::HWY_NAMESPACE {
namespace {

using Int = hn::Vec<Ints>;

/// Where rows lie on one axis of the grid; see formula trilinear-vectors.
struct GridAxis
{
    HWY_INLINE GridAxis(Float p, float low, float perCell, uint32_t nodes, uint32_t stride)
    {
        const Float g = hn::Mul(hn::Sub(p, all(low)), all(perCell)); // (1)
        const Float last = all(float(nodes - 1));
        const bool isFlat = nodes == 1;
        const Float bounded = isFlat ? hn::Zero(Floats()) : hn::Min(hn::Max(g, hn::Zero(Floats())), last);
        const Float cell = hn::Floor(hn::Min(bounded, all(float(std::max(nodes, 2u) - 2))));
        u = hn::Sub(bounded, cell);
        inside = isFlat ? hn::Eq(u, u) : hn::And(hn::Ge(g, hn::Zero(Floats())), hn::Le(g, last));
        lower = hn::Mul(hn::ConvertTo(Ints(), cell), hn::Set(Ints(), int32_t(stride)));
        upper = hn::Add(lower, hn::Set(Ints(), isFlat ? 0 : int32_t(stride)));
    }

    Float u;
    hn::Mask<Floats> inside;
    Int lower, upper; ///< numbers to skip
};

HWY_INLINE Float mix(Float a, Float b, Float u)
{
    return hn::Add(a, hn::Mul(u, hn::Sub(b, a)));
}

/// One channel between the eight corners.
HWY_INLINE Float interpolate(const float* values, const GridAxis& x, const GridAxis& y, const GridAxis& z)
{
    const auto at = [&](Int ix, Int iy, Int iz)
                        HWY_ATTR { return hn::GatherIndex(Floats(), values, hn::Add(hn::Add(ix, iy), iz)); };
    const auto row = [&](Int iy, Int iz)
                         HWY_ATTR { return mix(at(x.lower, iy, iz), at(x.upper, iy, iz), x.u); };
    const auto sheet = [&](Int iz) HWY_ATTR { return mix(row(y.lower, iz), row(y.upper, iz), y.u); };
    return mix(sheet(z.lower), sheet(z.upper), z.u); // (2)
}

void runVectorField(const VectorFieldDef& def, Tile& tile)
{
    const FieldGrid& grid = *def.grid;
    const auto [low, perCell] = VectorFieldConstants(def);
    const float* const values = grid.values.data();
    for (uint32_t i = 0; i < tile.padded; i += uint32_t(hn::Lanes(Floats()))) {
        const Float3 p = loadPosition(tile, i);
        const GridAxis x(p.x, low.x, perCell.x, grid.nodes.x, 3);
        const GridAxis y(p.y, low.y, perCell.y, grid.nodes.y, 3 * grid.nodes.x);
        const GridAxis z(p.z, low.z, perCell.z, grid.nodes.z, 3 * grid.nodes.x * grid.nodes.y);
        const Float strength =
            hn::IfThenElseZero(hn::And(x.inside, hn::And(y.inside, z.inside)), all(def.strength));
        const Float3 v{interpolate(values, x, y, z), interpolate(values + 1, x, y, z),
                       interpolate(values + 2, x, y, z)};
        if (def.isAcceleration)
            addAcceleration(tile, i, times(v, strength));
        else
            addAir(tile, i, times(v, strength));
    }
}

} // namespace
} // namespace fx::sim::modules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace {

using namespace modules;
HWY_EXPORT(runVectorField);

TileBound boundOf(const VectorFieldDef& def)
{
    float longest = 0.0f;
    for (size_t i = 0; i + 2 < def.grid->values.size(); i += 3) {
        const float* v = &def.grid->values[i];
        longest = std::max(longest, v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    }
    longest = std::sqrt(longest) * std::abs(def.strength);
    return def.isAcceleration ? TileBound{longest} : TileBound{0.0f, longest, false};
}

/// See GpuModuleSource.
bool describe(const VectorFieldDef& def, base::GpuModules& out)
{
    constexpr size_t kMaxOnGpu = size_t(1) << 24; // numbers, which go with each emitter
    const FieldGrid& grid = *def.grid;
    const auto [low, perCell] = VectorFieldConstants(def);
    if (grid.values.size() > kMaxOnGpu)
        return false;
    out.add(def.isAcceleration ? base::GpuModule::FieldForce : base::GpuModule::FieldAir,
            {low.x, low.y, low.z, perCell.x, perCell.y, perCell.z, float(grid.nodes.x), float(grid.nodes.y),
             float(grid.nodes.z), def.strength});
    out.numbers.insert(out.numbers.end(), grid.values.begin(), grid.values.end());
    return true;
}

} // namespace

std::unique_ptr<TileOp> makeVectorFieldOp(const VectorFieldDef& def)
{
    VectorFieldDef kept = def;
    kept.scale = std::max(def.scale, 1e-6f);
    return makeForceOp(kept, boundOf(kept), describe, FX_FORCE_KERNEL(runVectorField));
}

} // namespace fx::sim
#endif
