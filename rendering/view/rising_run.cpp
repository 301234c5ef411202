#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/view/rising_run.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/view/depth_keys.h"
#include "rendering/view/rising_run.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<uint32_t, kChainBlock>;
using Signed = hn::Rebind<int32_t, Tag>;
using Words = hn::Vec<Tag>;

#if HWY_TARGET != HWY_SCALAR
/// The keys of elements.
HWY_INLINE Words keysOf(const uint32_t* keys, Words elements)
{
    return hn::GatherIndex(Tag(), keys, hn::BitCast(Signed(), elements));
}

/// Each lane gets that of the lane below, the first one `first`.
HWY_INLINE Words shifted(Words lanes, uint32_t first)
{
    const Tag tag;
    alignas(64) static constexpr int32_t kBelow[kChainBlock] = {0, 0, 1, 2,  3,  4,  5,  6,
                                                                7, 8, 9, 10, 11, 12, 13, 14};
    const auto below = hn::SetTableIndices(tag, kBelow);
    return hn::IfThenElse(hn::FirstN(tag, 1), hn::Set(tag, first), hn::TableLookupLanes(lanes, below));
}
#endif

#if HWY_TARGET != HWY_SCALAR
/// Appends whole vectors to a chain that ends in `last`; the last `spare` lanes do not count.
HWY_INLINE void append(Chain& c, Words element, size_t spare)
{
    const Tag tag;
    const size_t count = hn::Lanes(tag) - spare;
    hn::StoreU(element, tag, c.order + c.kept); // not beyond what has been read, because kept <= at
    const uint32_t lastElement = c.order[c.kept + count - 1];
    const uint32_t lastKey = c.keys[lastElement];
    c.blockEnds[c.kept / kChainBlock] = lastKey;
    c.kept += count;
    c.blockEnds[(c.kept - 1) / kChainBlock] = lastKey;
    c.at += count + spare;
    c.last = uint64_t(lastKey) << 32 | lastElement;
}

/// Where one element is below that before it, it or that one is put aside. False, and nothing has happened,
/// when the others would not rise.
HWY_INLINE bool putOneAside(Chain& c, Words key, Words element, size_t fall)
{
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    if (fall == 0 || c.asideCount == c.mostAside)
        return false;
    alignas(64) uint32_t keys[kChainBlock];
    alignas(64) uint32_t elements[kChainBlock];
    hn::Store(key, tag, keys);
    hn::Store(element, tag, elements);
    const auto pairAt = [&](size_t i) { return uint64_t(keys[i]) << 32 | elements[i]; };
    const uint64_t lower = fall >= 2 ? pairAt(fall - 2) : c.last;
    const bool itFits = pairAt(fall) >= lower; // then that before it does not
    if (!itFits && fall + 1 < lanes && pairAt(fall + 1) < pairAt(fall - 1))
        return false;
    const size_t out = itFits ? fall - 1 : fall;
    c.aside[c.asideCount++] = pairAt(out);
    const Words place = hn::Iota(tag, 0);
    const auto isBehind = hn::Not(hn::Lt(place, hn::Set(tag, uint32_t(out))));
    const Words from = hn::Min(hn::Add(place, hn::IfThenElseZero(isBehind, hn::Set(tag, 1u))),
                               hn::Set(tag, uint32_t(lanes - 1)));
    append(c, hn::TableLookupLanes(element, hn::IndicesFromVec(tag, hn::BitCast(Signed(), from))), 1);
    return true;
}
#endif

void keepRun(Chain& chain)
{
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    const auto gone = hn::Set(tag, kAbsentKey);
    Chain c = chain;
    while (c.at + lanes <= c.count) {
        const Words element = hn::LoadU(tag, c.order + c.at);
        const Words key = keysOf(c.keys, element);
        const Words keyBefore = shifted(key, uint32_t(c.last >> 32));
        const Words elementBefore = shifted(element, uint32_t(c.last));
        const auto isAfter =
            hn::Or(hn::Lt(keyBefore, key), hn::And(hn::Eq(keyBefore, key), hn::Lt(elementBefore, element)));
        const auto fits = hn::AndNot(hn::Eq(key, gone), isAfter);
        if (HWY_LIKELY(hn::AllTrue(tag, fits))) {
            append(c, element, 0);
            continue;
        }
        const auto falls = hn::Not(fits);
        if (hn::CountTrue(tag, falls) > 1 || !hn::AllFalse(tag, hn::Eq(key, gone)) ||
            !putOneAside(c, key, element, size_t(hn::FindFirstTrue(tag, falls))))
            break;
    }
    chain = c;
#else
    static_cast<void>(chain);
#endif
}

size_t below(const Chain& chain, size_t begin, size_t end, uint64_t pair)
{
    size_t count = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    const auto key = hn::Set(tag, uint32_t(pair >> 32));
    const auto element = hn::Set(tag, uint32_t(pair));
    for (; begin + lanes <= end; begin += lanes) {
        const Words elements = hn::LoadU(tag, chain.order + begin);
        const Words keys = keysOf(chain.keys, elements);
        const auto isBelow = hn::Or(hn::Lt(keys, key), hn::And(hn::Eq(keys, key), hn::Lt(elements, element)));
        count += hn::CountTrue(tag, isBelow);
    }
#endif
    for (; begin < end; ++begin)
        count += (uint64_t(chain.keys[chain.order[begin]]) << 32 | chain.order[begin]) < pair ? 1 : 0;
    return count;
}

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(keepRun);
HWY_EXPORT(below);

void keepRisingRun(Chain& chain)
{
    HWY_DYNAMIC_DISPATCH(keepRun)(chain);
}

size_t countBelow(const Chain& chain, size_t begin, size_t end, uint64_t pair)
{
    return HWY_DYNAMIC_DISPATCH(below)(chain, begin, end, pair);
}

} // namespace fx::render
#endif
