#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/draw_order/depth_keys.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/draw_order/depth_keys.h"

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kBitsAtOnce = 16; // elements

using Tag = hn::CappedTag<uint32_t, kBitsAtOnce>;
using Signed = hn::Rebind<int32_t, Tag>;
using Floats = hn::ScalableTag<float>;

/// Bits of 16 elements, vector by vector.
template <class M>
HWY_INLINE void storeBits(const M* masks, uint8_t* out)
{
    const Tag tag;
    constexpr size_t kLanes = hn::MaxLanes(Tag());
    if constexpr (kLanes >= 8) {
        for (size_t v = 0; v < kBitsAtOnce / kLanes; ++v)
            hn::StoreMaskBits(tag, masks[v], out + v * (kLanes / 8));
    } else {
        uint32_t all = 0;
        for (size_t v = 0; v < kBitsAtOnce / kLanes; ++v) {
            uint8_t bits[8];
            hn::StoreMaskBits(tag, masks[v], bits);
            all |= uint32_t(bits[0]) << (v * kLanes);
        }
        out[0] = uint8_t(all);
        out[1] = uint8_t(all >> 8);
    }
}

/// @param count a multiple of kBitsAtOnce
void keys(const float* values, uint32_t flip, uint32_t* ioKeys, const KeyChanges& out, size_t count,
          KeySpan* outSpan)
{
    const Tag tag;
    constexpr size_t kLanes = hn::MaxLanes(Tag());
    using Mask = decltype(hn::Eq(hn::Zero(tag), hn::Zero(tag)));
    const auto zero = hn::Zero(tag);
    const auto gone = hn::Set(tag, kAbsentKey);
    const auto sign = hn::Set(tag, 0x80000000u);
    const auto noNumber = hn::Set(Signed(), 0x7F800001);
    const auto flips = hn::Set(tag, flip);
    const auto one = hn::Set(tag, 1u);
    auto lowest = gone;
    auto highest = zero;
    auto absent = zero;
    auto changed = zero;
    auto newcomers = zero;
    for (size_t i = 0; i < count; i += kBitsAtOnce) {
        Mask isOther[kBitsAtOnce / kLanes];
        Mask isNew[kBitsAtOnce / kLanes];
        for (size_t v = 0; v < kBitsAtOnce / kLanes; ++v) {
            uint32_t* place = ioKeys + i + v * kLanes;
            const auto bits = hn::LoadU(tag, reinterpret_cast<const uint32_t*>(values) + i + v * kLanes);
            const auto negative = hn::BitCast(tag, hn::ShiftRight<31>(hn::BitCast(Signed(), bits)));
            const auto plain = hn::Xor(hn::Xor(bits, hn::Or(negative, sign)), flips);
            const auto size = hn::BitCast(Signed(), hn::AndNot(sign, bits));
            const auto isNumber = hn::RebindMask(tag, hn::Lt(size, noNumber));
            const auto key = hn::IfThenElse(isNumber, plain, gone);
            const auto before = hn::LoadU(tag, place);
            hn::StoreU(key, tag, place);
            lowest = hn::Min(lowest, key);
            highest = hn::Max(highest, hn::IfThenElseZero(isNumber, plain));
            isOther[v] = hn::Ne(before, key);
            isNew[v] = hn::And(isOther[v], hn::Eq(before, gone));
            absent = hn::Add(absent, hn::IfThenZeroElse(isNumber, one));
            changed = hn::Add(changed, hn::IfThenElseZero(isOther[v], one));
            newcomers = hn::Add(newcomers, hn::IfThenElseZero(isNew[v], one));
        }
        storeBits(isOther, out.changed + i / 8);
        storeBits(isNew, out.newcomers + i / 8);
    }
    outSpan->lowest = hn::GetLane(hn::MinOfLanes(tag, lowest));
    outSpan->highest = hn::GetLane(hn::MaxOfLanes(tag, highest));
    outSpan->absent = hn::GetLane(hn::SumOfLanes(tag, absent));
    outSpan->changed = hn::GetLane(hn::SumOfLanes(tag, changed));
    outSpan->newcomers = hn::GetLane(hn::SumOfLanes(tag, newcomers));
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

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(keys);
HWY_EXPORT(distances);

namespace {

uint32_t keyOf(float value, uint32_t flip)
{
    const uint32_t bits = std::bit_cast<uint32_t>(value);
    const uint32_t key = bits ^ (uint32_t(int32_t(bits) >> 31) | 0x80000000u) ^ flip;
    return (bits & 0x7FFFFFFFu) > 0x7F800000u ? kAbsentKey : key;
}

} // namespace

KeySpan makeKeys(const float* values, uint32_t flip, uint32_t* ioKeys, const KeyChanges& out, size_t count)
{
    base::applyInstructionSetLimit();
    KeySpan span{kAbsentKey, 0, 0, 0, 0};
    const size_t whole = count / 64 * 64;
    if (whole > 0)
        HWY_DYNAMIC_DISPATCH(keys)(values, flip, ioKeys, out, whole, &span);
    if (whole < count) {
        std::fill_n(out.changed + whole / 8, 8, uint8_t(0));
        std::fill_n(out.newcomers + whole / 8, 8, uint8_t(0));
    }
    for (size_t i = whole; i < count; ++i) {
        const uint32_t before = ioKeys[i];
        const uint32_t key = keyOf(values[i], flip);
        const bool isHere = key != kAbsentKey;
        const bool isOther = key != before;
        const bool isNew = isOther && before == kAbsentKey;
        ioKeys[i] = key;
        out.changed[i / 8] |= uint8_t(unsigned(isOther) << (i % 8));
        out.newcomers[i / 8] |= uint8_t(unsigned(isNew) << (i % 8));
        span.lowest = std::min(span.lowest, key);
        span.highest = isHere ? std::max(span.highest, key) : span.highest;
        span.absent += isHere ? 0 : 1;
        span.changed += isOther ? 1 : 0;
        span.newcomers += isNew ? 1 : 0;
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
