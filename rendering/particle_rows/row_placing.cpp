#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/particle_rows/row_placing.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/particle_rows/row_placing.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, kRowsBehind>;
using Vec = hn::Vec<Tag>;

struct Vec3
{
    Vec x, y, z;
};

HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

/// rotation * (scale * v), as glm computes it.
class Turn
{
public:
    HWY_INLINE explicit Turn(const PlacedRows& rows)
        : q_{hn::Set(Tag(), rows.rotation.x), hn::Set(Tag(), rows.rotation.y),
             hn::Set(Tag(), rows.rotation.z)},
          w_(hn::Set(Tag(), rows.rotation.w)), scale_(hn::Set(Tag(), rows.scale)), two_(hn::Set(Tag(), 2.0f))
    {}
    HWY_INLINE Vec3 operator()(const Vec3& v) const
    {
        const Vec3 s{hn::Mul(scale_, v.x), hn::Mul(scale_, v.y), hn::Mul(scale_, v.z)};
        const Vec3 uv = cross(q_, s);
        const Vec3 uuv = cross(q_, uv);
        return {along(s.x, uv.x, uuv.x), along(s.y, uv.y, uuv.y), along(s.z, uv.z, uuv.z)};
    }
    HWY_INLINE Vec length(Vec value) const { return hn::Mul(scale_, value); }

private:
    HWY_INLINE Vec along(Vec v, Vec uv, Vec uuv) const
    {
        return hn::Add(v, hn::Mul(hn::Add(hn::Mul(uv, w_), uuv), two_));
    }

    Vec3 q_;
    Vec w_, scale_, two_;
};

HWY_INLINE Vec3 load(const PlacedRows& rows, size_t i)
{
    const Tag tag;
    return {hn::LoadU(tag, rows.from[0] + i), hn::LoadU(tag, rows.from[1] + i),
            hn::LoadU(tag, rows.from[2] + i)};
}

/// The first `rows` of a vector: those behind are of another group.
HWY_INLINE void store(Vec v, size_t rows, float* out)
{
    const Tag tag;
    if (rows >= hn::Lanes(tag))
        hn::StoreU(v, tag, out);
    else
        hn::BlendedStore(v, hn::FirstN(tag, rows), tag, out);
}

/// What of a vector shows something lies within.
class Extent
{
public:
    HWY_INLINE Extent()
        : lowX_(hn::Inf(Tag())), lowY_(lowX_), lowZ_(lowX_), highX_(hn::Neg(lowX_)), highY_(highX_),
          highZ_(highX_), widest_(hn::Zero(Tag()))
    {}
    HWY_INLINE void add(const Vec3& v, Vec radius, size_t rows)
    {
        const auto is = hn::And(hn::Gt(radius, hn::Zero(Tag())), hn::FirstN(Tag(), rows));
        grow(is, v.x, lowX_, highX_);
        grow(is, v.y, lowY_, highY_);
        grow(is, v.z, lowZ_, highZ_);
        widest_ = hn::IfThenElse(hn::And(is, hn::Gt(radius, widest_)), radius, widest_);
    }
    HWY_INLINE void give(PlacedRows& out) const
    {
        const Tag tag;
        const auto lowest = [&tag](Vec v) { return hn::GetLane(hn::MinOfLanes(tag, v)); };
        const auto highest = [&tag](Vec v) { return hn::GetLane(hn::MaxOfLanes(tag, v)); };
        out.extent.low = {lowest(lowX_), lowest(lowY_), lowest(lowZ_)};
        out.extent.high = {highest(highX_), highest(highY_), highest(highZ_)};
        out.extent.reach = highest(widest_);
    }

private:
    template <class M>
    HWY_INLINE static void grow(M is, Vec v, Vec& low, Vec& high)
    {
        low = hn::IfThenElse(hn::And(is, hn::Lt(v, low)), v, low);
        high = hn::IfThenElse(hn::And(is, hn::Gt(v, high)), v, high);
    }

    Vec lowX_, lowY_, lowZ_;
    Vec highX_, highY_, highZ_;
    Vec widest_;
};

void place(PlacedRows* groups, size_t count)
{
    const Tag tag;
    for (size_t g = 0; g < count; ++g) {
        PlacedRows& rows = groups[g];
        const Turn turn(rows);
        const Vec ox = hn::Set(tag, rows.offset.x);
        const Vec oy = hn::Set(tag, rows.offset.y);
        const Vec oz = hn::Set(tag, rows.offset.z);
        Extent extent;
        for (size_t i = 0; i < rows.count; i += hn::Lanes(tag)) {
            const Vec3 v = load(rows, i);
            const Vec radius = hn::LoadU(tag, rows.radius + i);
            extent.add(v, radius, rows.count - i);
            const Vec3 turned = turn(v);
            const size_t left = rows.count - i;
            store(hn::Add(ox, turned.x), left, rows.to[0] + i);
            store(hn::Add(oy, turned.y), left, rows.to[1] + i);
            store(hn::Add(oz, turned.z), left, rows.to[2] + i);
            store(turn.length(radius), left, rows.toRadius + i);
        }
        extent.give(rows);
    }
}

void turn(const PlacedRows* groups, size_t count)
{
    for (size_t g = 0; g < count; ++g) {
        const Turn turn(groups[g]);
        for (size_t i = 0; i < groups[g].count; i += hn::Lanes(Tag())) {
            const Vec3 v = turn(load(groups[g], i));
            store(v.x, groups[g].count - i, groups[g].to[0] + i);
            store(v.y, groups[g].count - i, groups[g].to[1] + i);
            store(v.z, groups[g].count - i, groups[g].to[2] + i);
        }
    }
}

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(place);
HWY_EXPORT(turn);

void placeRows(std::span<PlacedRows> groups)
{
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(place)(groups.data(), groups.size());
}

void turnRows(std::span<const PlacedRows> groups)
{
    base::applyInstructionSetLimit();
    HWY_DYNAMIC_DISPATCH(turn)(groups.data(), groups.size());
}

} // namespace fx::render
#endif
