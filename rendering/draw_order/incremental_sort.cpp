#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/draw_order/incremental_sort.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "rendering/draw_order/depth_keys.h"
#include "rendering/draw_order/incremental_sort.h"

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstring>

HWY_BEFORE_NAMESPACE();
namespace fx::render::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kMaxLanes = 16;
constexpr uint64_t kNoPair = ~uint64_t(0);

using Tag = hn::CappedTag<uint32_t, kMaxLanes>;
using BlockTag = hn::CappedTag<uint32_t, kSortedBlock>;
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
    alignas(64) static constexpr int32_t kBelow[kMaxLanes] = {0, 0, 1, 2,  3,  4,  5,  6,
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
/// lane, the uppermost lane is spare then. @return the one that was left out; kNoPair when the others would
/// not rise
HWY_INLINE uint64_t leaveOneOut(Pairs& pairs, uint64_t last, size_t fall)
{
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    if (fall == 0)
        return kNoPair;
    alignas(64) uint32_t keys[kMaxLanes];
    alignas(64) uint32_t elements[kMaxLanes];
    hn::Store(pairs.key, tag, keys);
    hn::Store(pairs.element, tag, elements);
    const auto pairAt = [&](size_t i) { return uint64_t(keys[i]) << 32 | elements[i]; };
    const uint64_t lower = fall >= 2 ? pairAt(fall - 2) : last;
    const bool itFits = pairAt(fall) >= lower; // then that before it does not
    if (!itFits && fall + 1 < lanes && pairAt(fall + 1) < pairAt(fall - 1))
        return kNoPair;
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

void extendSorted(SortedPart& sorted)
{
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    const auto gone = hn::Set(tag, kAbsentKey);
    SortedPart c = sorted;
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
                c.displacedCount == c.mostDisplaced)
                break;
            const uint64_t out = leaveOneOut(next, last.first(), size_t(hn::FindFirstTrue(tag, falls)));
            if (out == kNoPair)
                break;
            c.displaced[c.displacedCount++] = out;
            --count;
        }
        hn::StoreU(next.element, tag, c.order + c.kept); // not beyond what has been read: kept <= at
        c.kept += count;
        last = {spread(next.key, count - 1), spread(next.element, count - 1)};
    }
    c.last = last.first();
    sorted = c;
#else
    static_cast<void>(sorted);
#endif
}

void keepUnmoved(SortedPart& sorted, const uint8_t* changed)
{
    size_t kept = 0;
    size_t at = 0;
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    for (; at + lanes <= sorted.count; at += lanes) {
        const Words element = hn::LoadU(tag, sorted.order + at);
        const auto words = keysOf(reinterpret_cast<const uint32_t*>(changed), hn::ShiftRight<5>(element));
        const auto bit = hn::Shr(words, hn::And(element, hn::Set(tag, 31u)));
        const auto isStill = hn::Eq(hn::And(bit, hn::Set(tag, 1u)), hn::Zero(tag));
        if (hn::AllTrue(tag, isStill)) {
            hn::StoreU(element, tag, sorted.order + kept);
            kept += lanes;
        } else {
            kept += hn::CompressStore(element, isStill, tag, sorted.order + kept);
        }
    }
#endif
    for (; at < sorted.count; ++at) {
        const uint32_t element = sorted.order[at];
        sorted.order[kept] = element;
        kept += (changed[element / 8] >> (element % 8) & 1) == 0 ? 1 : 0;
    }
    sorted.kept = kept;
    sorted.at = sorted.count;
}

/// The first block of the sorted part, at most `block`, before which all blocks stand before `key`: found by
/// the keys of the blocks' ends, which lie side by side. Prefetches the keys of its elements.
HWY_INLINE size_t blockOf(const SortedPart& sorted, uint32_t key, size_t block)
{
#if HWY_TARGET != HWY_SCALAR
    const Tag tag;
    const size_t lanes = hn::Lanes(tag);
    for (size_t behind = lanes; behind == lanes && block >= lanes; block -= behind)
        behind = hn::CountTrue(
            tag, hn::Not(hn::Lt(hn::LoadU(tag, sorted.blockEnds + block - lanes), hn::Set(tag, key))));
#endif
    while (block > 0 && sorted.blockEnds[block - 1] >= key)
        --block;
    const size_t end = std::min((block + 1) * kSortedBlock, sorted.kept);
    for (size_t place = block * kSortedBlock; place < end; ++place)
        __builtin_prefetch(&sorted.keys[sorted.order[place]]);
    return block;
}

/// How many of order[begin, end), at most kSortedBlock elements, stand before `pair`.
HWY_INLINE size_t countBelow(const SortedPart& sorted, size_t begin, size_t end, uint64_t pair)
{
    size_t count = 0;
#if HWY_TARGET != HWY_SCALAR
    const BlockTag tag;
    const size_t lanes = hn::Lanes(tag);
    const auto key = hn::Set(tag, uint32_t(pair >> 32));
    const auto element = hn::Set(tag, uint32_t(pair));
    for (; begin + lanes <= end; begin += lanes) {
        const auto elements = hn::LoadU(tag, sorted.order + begin);
        const auto keys = keysOf(sorted.keys, elements);
        const auto isBelow = hn::Or(hn::Lt(keys, key), hn::And(hn::Eq(keys, key), hn::Lt(elements, element)));
        count += hn::CountTrue(tag, isBelow);
    }
#endif
    for (; begin < end; ++begin)
        count += (uint64_t(sorted.keys[sorted.order[begin]]) << 32 | sorted.order[begin]) < pair ? 1 : 0;
    return count;
}

/// How many of the first `end` of the sorted part stand before `pair`, from `block` on.
HWY_INLINE size_t placeIn(const SortedPart& sorted, uint64_t pair, size_t block, size_t end)
{
    for (size_t place = block * kSortedBlock; place < end; place += kSortedBlock) {
        const size_t beyond = std::min(place + kSortedBlock, end);
        const size_t before = countBelow(sorted, place, beyond, pair);
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
void mergeAll(const SortedPart& sorted, const uint64_t* moved, size_t count)
{
    constexpr size_t kLead = 8;
    for (size_t stop = kSortedBlock; stop < sorted.kept + kSortedBlock; stop += kSortedBlock)
        sorted.blockEnds[stop / kSortedBlock - 1] =
            sorted.keys[sorted.order[std::min(stop, sorted.kept) - 1]];
    std::array<size_t, kLead> blocks{};
    size_t block = (sorted.kept + kSortedBlock - 1) / kSortedBlock;
    size_t end = sorted.kept; // of the sorted part that is still in its old place
    for (size_t step = 0; step < count + kLead; ++step) {
        const size_t known = blocks[step % kLead];
        if (step < count)
            blocks[step % kLead] = block = blockOf(sorted, uint32_t(moved[count - 1 - step] >> 32), block);
        if (step < kLead)
            continue;
        const size_t left = count + kLead - step;
        const uint64_t pair = moved[left - 1];
        const size_t high = placeIn(sorted, pair, known, end); // all from here on are behind it
        moveUp(sorted.order, high, end, left);
        sorted.order[high + left - 1] = uint32_t(pair);
        end = high;
    }
}

} // namespace
} // namespace fx::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render {

HWY_EXPORT(extendSorted);
HWY_EXPORT(keepUnmoved);
HWY_EXPORT(mergeAll);

void extendSortedByVectors(SortedPart& sorted)
{
    HWY_DYNAMIC_DISPATCH(extendSorted)(sorted);
}

void keepUnchanged(SortedPart& sorted, const uint8_t* changed)
{
    HWY_DYNAMIC_DISPATCH(keepUnmoved)(sorted, changed);
}

void mergeMoved(const SortedPart& sorted, const uint64_t* moved, size_t count)
{
    HWY_DYNAMIC_DISPATCH(mergeAll)(sorted, moved, count);
}

} // namespace fx::render
#endif
