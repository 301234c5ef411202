#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/view/depth_keys.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/view/depth_keys.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<uint32_t>;
using Signed = hn::ScalableTag<int32_t>;
using Floats = hn::ScalableTag<float>;

void keys(const float* values, uint32_t flip, const uint32_t* last, uint32_t* out, size_t count,
          KeySpan* ioSpan)
{
    const Tag tag;
    const auto zero = hn::Zero(tag);
    const auto gone = hn::Set(tag, kAbsentKey);
    const auto sign = hn::Set(tag, 0x80000000u);
    const auto noNumber = hn::Set(Signed(), 0x7F800001);
    const auto flips = hn::Set(tag, flip);
    const auto one = hn::Set(tag, 1u);
    auto lowest = gone;
    auto highest = zero;
    auto absent = zero;
    auto newcomers = zero;
    for (size_t i = 0; i < count; i += hn::Lanes(tag)) {
        const auto bits = hn::LoadU(tag, reinterpret_cast<const uint32_t*>(values) + i);
        const auto negative = hn::BitCast(tag, hn::ShiftRight<31>(hn::BitCast(Signed(), bits)));
        const auto plain = hn::Xor(hn::Xor(bits, hn::Or(negative, sign)), flips);
        const auto size = hn::BitCast(Signed(), hn::AndNot(sign, bits));
        const auto isNumber = hn::RebindMask(tag, hn::Lt(size, noNumber));
        const auto key = hn::IfThenElse(isNumber, plain, gone);
        hn::StoreU(key, tag, out + i);
        lowest = hn::Min(lowest, key);
        highest = hn::Max(highest, hn::IfThenElseZero(isNumber, plain));
        absent = hn::Add(absent, hn::IfThenZeroElse(isNumber, one));
        const auto wasGone = hn::Eq(hn::LoadU(tag, last + i), gone);
        newcomers = hn::Add(newcomers, hn::IfThenElseZero(hn::And(isNumber, wasGone), one));
    }
    ioSpan->lowest = hn::GetLane(hn::MinOfLanes(tag, lowest));
    ioSpan->highest = hn::GetLane(hn::MaxOfLanes(tag, highest));
    ioSpan->absent = hn::GetLane(hn::SumOfLanes(tag, absent));
    ioSpan->newcomers = hn::GetLane(hn::SumOfLanes(tag, newcomers));
}

/// @return how many rows were done: whole vectors only
size_t distances(const RowColumns& rows, const float* eye, bool isParallel, float scale, float offset,
                 float* out)
{
    const Floats tag;
    const auto ex = hn::Set(tag, eye[0]);
    const auto ey = hn::Set(tag, eye[1]);
    const auto ez = hn::Set(tag, eye[2]);
    const auto scales = hn::Set(tag, scale);
    const auto offsets = hn::Set(tag, offset);
    const auto nothing = hn::Set(tag, std::numeric_limits<float>::quiet_NaN());
    const size_t lanes = hn::Lanes(tag);
    size_t i = 0;
    for (; i + lanes <= rows.count; i += lanes) {
        const auto x = hn::LoadU(tag, rows.x + i);
        const auto y = hn::LoadU(tag, rows.y + i);
        const auto z = hn::LoadU(tag, rows.z + i);
        const auto dx = hn::Sub(x, ex);
        const auto dy = hn::Sub(y, ey);
        const auto dz = hn::Sub(z, ez);
        const auto along = hn::Add(hn::Add(hn::Mul(x, ex), hn::Mul(y, ey)), hn::Mul(z, ez));
        const auto squared = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
        const auto distance = isParallel ? along : hn::Sqrt(squared);
        const auto isThere = hn::Gt(hn::LoadU(tag, rows.radius + i), hn::Zero(tag));
        hn::StoreU(hn::IfThenElse(isThere, hn::Add(hn::Mul(distance, scales), offsets), nothing), tag,
                   out + i);
    }
    return i;
}

size_t lanes()
{
    return hn::Lanes(Tag());
}

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(keys);
HWY_EXPORT(distances);
HWY_EXPORT(lanes);

namespace {

uint32_t keyOf(float value, uint32_t flip)
{
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t key = bits ^ (uint32_t(int32_t(bits) >> 31) | 0x80000000u) ^ flip;
    return (bits & 0x7FFFFFFFu) > 0x7F800000u ? kAbsentKey : key;
}

} // namespace

KeySpan makeKeys(const float* values, uint32_t flip, const uint32_t* last, uint32_t* outKeys, size_t count)
{
    base::applyInstructionSetLimit();
    KeySpan span{kAbsentKey, 0, 0, 0};
    const size_t whole = count / HWY_DYNAMIC_DISPATCH(lanes)() * HWY_DYNAMIC_DISPATCH(lanes)();
    if (whole > 0)
        HWY_DYNAMIC_DISPATCH(keys)(values, flip, last, outKeys, whole, &span);
    for (size_t i = whole; i < count; ++i) {
        const uint32_t key = keyOf(values[i], flip);
        const bool isHere = key != kAbsentKey;
        outKeys[i] = key;
        span.lowest = std::min(span.lowest, key);
        span.highest = isHere ? std::max(span.highest, key) : span.highest;
        span.absent += isHere ? 0 : 1;
        span.newcomers += isHere && last[i] == kAbsentKey ? 1 : 0;
    }
    if (span.absent == count)
        span.lowest = span.highest = 0;
    return span;
}

void rowDistances(const RowColumns& rows, const glm::vec3& eye, bool isParallel, float scale, float offset,
                  float* out)
{
    base::applyInstructionSetLimit();
    const size_t done = HWY_DYNAMIC_DISPATCH(distances)(rows, &eye.x, isParallel, scale, offset, out);
    for (size_t i = done; i < rows.count; ++i) {
        const float dx = rows.x[i] - eye.x;
        const float dy = rows.y[i] - eye.y;
        const float dz = rows.z[i] - eye.z;
        const float along = (rows.x[i] * eye.x + rows.y[i] * eye.y) + rows.z[i] * eye.z;
        const float distance = isParallel ? along : std::sqrt((dx * dx + dy * dy) + dz * dz);
        out[i] = rows.radius[i] > 0.0f ? distance * scale + offset : std::numeric_limits<float>::quiet_NaN();
    }
}

} // namespace fx::render
#endif
