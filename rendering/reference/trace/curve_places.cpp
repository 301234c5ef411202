#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/reference/trace/curve_places.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/reference/trace/curve_order.h"

#include <hwy/highway.h>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace fx::render::trace::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<uint32_t, 16>;
using Cells = hn::Vec<Tag>;

constexpr int kBits = 20; ///< of a cell number

/// All ones in lanes whose `bit` is set, otherwise zero.
HWY_INLINE Cells maskOf(Cells x, uint32_t bit)
{
    const Tag tag;
    const Cells one = hn::Set(tag, bit);
    return hn::VecFromMask(tag, hn::Eq(hn::And(x, one), one));
}

HWY_INLINE void turn(Cells& x0, Cells& xi, uint32_t bit)
{
    const Cells below = hn::Set(Tag(), bit - 1u);
    const Cells has = maskOf(xi, bit);
    const Cells exchanged = hn::AndNot(has, hn::And(hn::Xor(x0, xi), below));
    x0 = hn::Xor(x0, hn::Xor(hn::And(below, has), exchanged)); // (1)
    xi = hn::Xor(xi, exchanged);
}

HWY_INLINE void placeOnCurve(Cells& x0, Cells& x1, Cells& x2)
{
    for (uint32_t bit = 1u << (kBits - 1); bit > 1; bit >>= 1) {
        x0 = hn::Xor(x0, hn::And(hn::Set(Tag(), bit - 1u), maskOf(x0, bit))); // (1)
        turn(x0, x1, bit);
        turn(x0, x2, bit);
    }
    x1 = hn::Xor(x1, x0); // (2)
    x2 = hn::Xor(x2, x1);
    Cells above = x2; // bit j becomes the sum modulo 2 of the bits j and higher
    above = hn::Xor(above, hn::ShiftRight<1>(above));
    above = hn::Xor(above, hn::ShiftRight<2>(above));
    above = hn::Xor(above, hn::ShiftRight<4>(above));
    above = hn::Xor(above, hn::ShiftRight<8>(above));
    above = hn::Xor(above, hn::ShiftRight<16>(above));
    above = hn::ShiftRight<1>(above);
    x0 = hn::Xor(x0, above);
    x1 = hn::Xor(x1, above);
    x2 = hn::Xor(x2, above);
}

void turnAll(uint32_t* x0, uint32_t* x1, uint32_t* x2, size_t count)
{
    const Tag tag;
    for (size_t i = 0; i < count; i += hn::Lanes(tag)) {
        Cells a = hn::LoadU(tag, x0 + i);
        Cells b = hn::LoadU(tag, x1 + i);
        Cells c = hn::LoadU(tag, x2 + i);
        placeOnCurve(a, b, c);
        hn::StoreU(a, tag, x0 + i);
        hn::StoreU(b, tag, x1 + i);
        hn::StoreU(c, tag, x2 + i);
    }
}

} // namespace
} // namespace fx::render::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

namespace trace {
namespace {

HWY_EXPORT(turnAll);

/// Moves bit j to bit 3 j, for 21 bits.
uint64_t spread(uint32_t x)
{
    uint64_t v = x;
    v = (v | v << 32) & 0x1F00000000FFFFu;
    v = (v | v << 16) & 0x1F0000FF0000FFu;
    v = (v | v << 8) & 0x100F00F00F00F00Fu;
    v = (v | v << 4) & 0x10C30C30C30C30C3u;
    return (v | v << 2) & 0x1249249249249249u;
}

} // namespace
} // namespace trace

void curvePlaces(CurveBatch& io)
{
    base::applyInstructionSetLimit();
    using namespace trace;
    const size_t count = (std::min(io.count, CurveBatch::kRoom) + 15) / 16 * 16;
    HWY_DYNAMIC_DISPATCH(turnAll)(io.cell[0].data(), io.cell[1].data(), io.cell[2].data(), count);
    for (size_t i = 0; i < io.count; ++i)
        io.place[i] = spread(io.cell[0][i]) << 2 | spread(io.cell[1][i]) << 1 | spread(io.cell[2][i]); // (3)
}

} // namespace fx::render
#endif
