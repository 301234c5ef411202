/// @file tile_lanes-inl.h
/// Three-dimensional vectors for as many rows of a tile as the instruction set has lanes. The file is
/// included once for each instruction set.
#if defined(FX_TILE_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef FX_TILE_LANES_INL
#undef FX_TILE_LANES_INL
#else
#define FX_TILE_LANES_INL
#endif

#include "simulation/particles/tile.h"

#include <glm/vec3.hpp>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::modules::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, kTilePadding>;
using Float = hn::Vec<Floats>;
using Ints = hn::RebindToSigned<Floats>;

HWY_INLINE Float all(float value)
{
    return hn::Set(Floats(), value);
}
HWY_INLINE Float loadRow(const float* from)
{
    return hn::Load(Floats(), from);
}

struct Float3
{
    Float x, y, z;
};

HWY_INLINE Float3 all(const glm::vec3& v)
{
    return {all(v.x), all(v.y), all(v.z)};
}
HWY_INLINE Float3 loadPosition(const Tile& tile, uint32_t i)
{
    return {loadRow(tile.x + i), loadRow(tile.y + i), loadRow(tile.z + i)};
}
HWY_INLINE Float3 loadVelocity(const Tile& tile, uint32_t i)
{
    return {loadRow(tile.vx + i), loadRow(tile.vy + i), loadRow(tile.vz + i)};
}
HWY_INLINE Float3 minus(const Float3& a, const Float3& b)
{
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Float3 plus(const Float3& a, const Float3& b)
{
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Float3 times(const Float3& a, Float s)
{
    return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE Float dot(const Float3& a, const Float3& b)
{
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Float3 cross(const Float3& a, const Float3& b)
{
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE void addRow(float* row, Float value)
{
    hn::Store(hn::Add(loadRow(row), value), Floats(), row);
}
HWY_INLINE void addAcceleration(Tile& tile, uint32_t i, const Float3& a)
{
    addRow(tile.ax + i, a.x);
    addRow(tile.ay + i, a.y);
    addRow(tile.az + i, a.z);
}
HWY_INLINE void addAir(Tile& tile, uint32_t i, const Float3& u)
{
    addRow(tile.ux + i, u.x);
    addRow(tile.uy + i, u.y);
    addRow(tile.uz + i, u.z);
}

} // namespace fx::sim::modules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif // include guard of this target
