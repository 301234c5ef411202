#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/draw_order/rising_run.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/draw_order/depth_keys.h"
#include "rendering/draw_order/rising_run.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kMostLanes = 16;
constexpr uint64_t kNobody = ~uint64_t(0);

using Tag = hn::CappedTag<uint32_t, kMostLanes>;
using BlockTag = hn::CappedTag<uint32_t, kChainBlock>;
using Signed = hn::Rebind<int32_t, Tag>;
using Words = hn::Vec<Tag>;

#if HWY_TARGET != HWY_SCALAR
/// The keys of elements.
template <class V>
HWY_INLINE V keysOf(const uint32_t* keys, V elements)
{
    const hn::DFromV<V> tag;
    return hn::GatherIndex(tag, keys, hn::BitCast(hn::RebindToSigned<decltype(tag)>(), elements));
}

/// Each lane gets that of the lane below, the first one that of `first`.
HWY_INLINE Words shifted(Words lanes, Words first)
{
    const Tag tag;
    alignas(64) static constexpr int32_t kBelow[kMostLanes] = {0, 0, 1, 2,  3,  4,  5,  6,
                                                               7, 8, 9, 10, 11, 12, 13, 14};
    return hn::IfThenElse(hn::FirstN(tag, 1), first,
                          hn::TableLookupLanes(lanes, hn::SetTableIndices(tag, kBelow)));
}

/// Lane `from` everywhere.
HWY_INLINE Words spread(Words lanes, size_t from)
{
    const Tag tag;
    return hn::TableLookupLanes(lanes,
                                hn::IndicesFromVec(tag, hn::BitCast(Signed(), hn::Set(tag, uint32_t(from)))));
}

/// Elements side by side, and their keys.
struct Pairs
{
    Words key, element;

    uint64_t first() const { return uint64_t(hn::GetLane(key)) << 32 | hn::GetLane(element); }
};

/// Where only element `fall` is below that before it, it or that one is left out: all above it move down by a
/// lane, the uppermost lane is spare then. @return the one that was left out; kNobody when the others would
/// not rise
HWY_INLINE uint64_t leaveOneOut(Pairs& pairs, uint64_t last, size_t fall)
{
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    if (fall == 0)
        return kNobody;
    alignas(64) uint32_t keys[kMostLanes];
    alignas(64) uint32_t elements[kMostLanes];
    hn::Store(pairs.key, tag, keys);
    hn::Store(pairs.element, tag, elements);
    const auto pairAt = [&](size_t i) { return uint64_t(keys[i]) << 32 | elements[i]; };
    const uint64_t lower = fall >= 2 ? pairAt(fall - 2) : last;
    const bool itFits = pairAt(fall) >= lower; // then that before it does not
    if (!itFits && fall + 1 < lanes && pairAt(fall + 1) < pairAt(fall - 1))
        return kNobody;
    const size_t out = itFits ? fall - 1 : fall;
    const Words place = hn::Iota(tag, 0);
    const auto isBehind = hn::Not(hn::Lt(place, hn::Set(tag, uint32_t(out))));
    const Words from = hn::Min(hn::Add(place, hn::IfThenElseZero(isBehind, hn::Set(tag, 1u))),
                               hn::Set(tag, uint32_t(lanes - 1)));
    const auto indices = hn::IndicesFromVec(tag, hn::BitCast(Signed(), from));
    pairs = {hn::TableLookupLanes(pairs.key, indices), hn::TableLookupLanes(pairs.element, indices)};
    return pairAt(out);
}
#endif

void keepRun(Chain& chain)
{
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    const auto gone = hn::Set(tag, kAbsentKey);
    Chain c = chain;
    Pairs last{hn::Set(tag, uint32_t(c.last >> 32)), hn::Set(tag, uint32_t(c.last))};
    for (; c.at + lanes <= c.count; c.at += lanes) {
        const Words element = hn::LoadU(tag, c.order + c.at);
        Pairs next{keysOf(c.keys, element), element};
        const Pairs before{shifted(next.key, last.key), shifted(element, last.element)};
        const auto isAfter = hn::Or(hn::Lt(before.key, next.key),
                                    hn::And(hn::Eq(before.key, next.key), hn::Lt(before.element, element)));
        const auto falls = hn::Or(hn::Eq(next.key, gone), hn::Not(isAfter));
        size_t count = lanes;
        if (HWY_UNLIKELY(!hn::AllFalse(tag, falls))) {
            if (hn::CountTrue(tag, falls) > 1 || !hn::AllFalse(tag, hn::Eq(next.key, gone)) ||
                c.asideCount == c.mostAside)
                break;
            const uint64_t out = leaveOneOut(next, last.first(), size_t(hn::FindFirstTrue(tag, falls)));
            if (out == kNobody)
                break;
            c.aside[c.asideCount++] = out;
            --count;
        }
        hn::StoreU(next.element, tag, c.order + c.kept); // not beyond what has been read: kept <= at
        c.kept += count;
        last = {spread(next.key, count - 1), spread(next.element, count - 1)};
    }
    c.last = last.first();
    chain = c;
#else
    static_cast<void>(chain);
#endif
}

void keepStill(Chain& chain, const uint8_t* changed)
{
    size_t kept = 0;
    size_t at = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    for (; at + lanes <= chain.count; at += lanes) {
        const Words element = hn::LoadU(tag, chain.order + at);
        const auto words = keysOf(reinterpret_cast<const uint32_t*>(changed), hn::ShiftRight<5>(element));
        const auto bit = hn::Shr(words, hn::And(element, hn::Set(tag, 31u)));
        const auto isStill = hn::Eq(hn::And(bit, hn::Set(tag, 1u)), hn::Zero(tag));
        if (hn::AllTrue(tag, isStill)) {
            hn::StoreU(element, tag, chain.order + kept);
            kept += lanes;
        } else {
            kept += hn::CompressStore(element, isStill, tag, chain.order + kept);
        }
    }
#endif
    for (; at < chain.count; ++at) {
        const uint32_t element = chain.order[at];
        chain.order[kept] = element;
        kept += (changed[element / 8] >> (element % 8) & 1) == 0 ? 1 : 0;
    }
    chain.kept = kept;
    chain.at = chain.count;
}

/// The first block of the chain, at most `block`, before which all blocks stand before `key`: found by the
/// keys of the blocks' ends, which lie side by side. Prefetches the keys of its elements.
HWY_INLINE size_t blockOf(const Chain& chain, uint32_t key, size_t block)
{
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    for (size_t behind = lanes; behind == lanes && block >= lanes; block -= behind)
        behind = hn::CountTrue(
            tag, hn::Not(hn::Lt(hn::LoadU(tag, chain.blockEnds + block - lanes), hn::Set(tag, key))));
#endif
    while (block > 0 && chain.blockEnds[block - 1] >= key)
        --block;
    const size_t end = std::min((block + 1) * kChainBlock, chain.kept);
    for (size_t place = block * kChainBlock; place < end; ++place)
        __builtin_prefetch(&chain.keys[chain.order[place]]);
    return block;
}

/// How many of order[begin, end), at most kChainBlock elements, stand before `pair`.
HWY_INLINE size_t countBelow(const Chain& chain, size_t begin, size_t end, uint64_t pair)
{
    size_t count = 0;
#if HWY_TARGET != HWY_SCALAR
    const BlockTag tag;
    const size_t lanes = hn::Lanes(tag);
    const auto key = hn::Set(tag, uint32_t(pair >> 32));
    const auto element = hn::Set(tag, uint32_t(pair));
    for (; begin + lanes <= end; begin += lanes) {
        const auto elements = hn::LoadU(tag, chain.order + begin);
        const auto keys = keysOf(chain.keys, elements);
        const auto isBelow = hn::Or(hn::Lt(keys, key), hn::And(hn::Eq(keys, key), hn::Lt(elements, element)));
        count += hn::CountTrue(tag, isBelow);
    }
#endif
    for (; begin < end; ++begin)
        count += (uint64_t(chain.keys[chain.order[begin]]) << 32 | chain.order[begin]) < pair ? 1 : 0;
    return count;
}

/// How many of the first `end` of the chain stand before `pair`, from `block` on.
HWY_INLINE size_t placeIn(const Chain& chain, uint64_t pair, size_t block, size_t end)
{
    for (size_t place = block * kChainBlock; place < end; place += kChainBlock) {
        const size_t beyond = std::min(place + kChainBlock, end);
        const size_t before = countBelow(chain, place, beyond, pair);
        if (place + before < beyond)
            return place + before;
    }
    return end;
}

/// Moves order[begin, end) up by `by` places, at least 1.
HWY_INLINE void moveUp(uint32_t* order, size_t begin, size_t end, size_t by)
{
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    for (; begin + lanes <= end; end -= lanes)
        hn::StoreU(hn::LoadU(tag, order + end - lanes), tag, order + end - lanes + by);
#endif
    std::memmove(order + begin + by, order + begin, (end - begin) * sizeof *order);
}

/// From the end: finds the position of each moved element before that of the previous one, and moves the
/// elements between them up as a block. Blocks are found some elements ahead, so that their keys are in the
/// cache by then.
void mergeAll(const Chain& chain, const uint64_t* moved, size_t count)
{
    constexpr size_t kLead = 8;
    for (size_t stop = kChainBlock; stop < chain.kept + kChainBlock; stop += kChainBlock)
        chain.blockEnds[stop / kChainBlock - 1] = chain.keys[chain.order[std::min(stop, chain.kept) - 1]];
    std::array<size_t, kLead> blocks{};
    size_t block = (chain.kept + kChainBlock - 1) / kChainBlock;
    size_t end = chain.kept; // of the chain that is still in its old place
    for (size_t step = 0; step < count + kLead; ++step) {
        const size_t known = blocks[step % kLead];
        if (step < count)
            blocks[step % kLead] = block = blockOf(chain, uint32_t(moved[count - 1 - step] >> 32), block);
        if (step < kLead)
            continue;
        const size_t left = count + kLead - step;
        const uint64_t pair = moved[left - 1];
        const size_t high = placeIn(chain, pair, known, end); // all from here on are behind it
        moveUp(chain.order, high, end, left);
        chain.order[high + left - 1] = uint32_t(pair);
        end = high;
    }
}

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(keepRun);
HWY_EXPORT(keepStill);
HWY_EXPORT(mergeAll);

void keepRisingRun(Chain& chain)
{
    HWY_DYNAMIC_DISPATCH(keepRun)(chain);
}

void keepUnchanged(Chain& chain, const uint8_t* changed)
{
    HWY_DYNAMIC_DISPATCH(keepStill)(chain, changed);
}

void mergeMoved(const Chain& chain, const uint64_t* moved, size_t count)
{
    HWY_DYNAMIC_DISPATCH(mergeAll)(chain, moved, count);
}

} // namespace fx::render
#endif
