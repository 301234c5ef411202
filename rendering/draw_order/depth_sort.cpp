#include "rendering/draw_order/depth_sort.h"

#include "foundation/memory/amortized_vector.h"
#include "rendering/draw_order/depth_keys.h"
#include "rendering/draw_order/incremental_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace fx::render {

namespace {

constexpr uint32_t kMaxDigitBits = 13; ///< as many places to write to as the caches near the core follow
constexpr size_t kMaxPasses = 3;
constexpr size_t kProbe =
    2048; ///< first elements; with a quarter of them out of order, all are sorted without the old order
constexpr size_t kScanPause = 16;     ///< elements after a sorted vector before the next is looked for
constexpr size_t kAhead = 32;         ///< elements whose keys are fetched before they are looked at
constexpr size_t kMaxMovedShare = 6;  ///< incremental sorting pays while less than one in so many has moved
constexpr size_t kFew = 16384;        ///< elements that are sorted by small digits,
constexpr uint32_t kFewDigitBits = 9; ///< because counting large ones would take longer

uint64_t pairOf(uint32_t key, uint32_t index)
{
    return uint64_t(key) << 32 | index;
}

/// How keys from `lowest` on are cut into digits.
struct Digits
{
    uint32_t lowest, beyond; ///< beyond: what absent keys become, one more than the highest
    uint32_t passes, bits, mask;

    Digits(uint32_t low, uint32_t high, uint32_t mostBits = kMaxDigitBits)
        : lowest(low), beyond(high - low + 1)
    {
        const uint32_t width = std::max<uint32_t>(uint32_t(std::bit_width(beyond)), 1);
        passes = (width + mostBits - 1) / mostBits;
        bits = (width + passes - 1) / passes;
        mask = (1u << bits) - 1;
    }
    uint32_t of(uint32_t key, uint32_t pass) const
    {
        return std::min(key - lowest, beyond) >> (pass * bits) & mask;
    }
};

using Offsets = std::array<uint32_t, size_t(1) << kMaxDigitBits>;

/// Counts to first places.
void accumulate(Offsets& counts, uint32_t mask)
{
    uint32_t sum = 0;
    for (uint32_t d = 0; d <= mask; ++d)
        sum = std::exchange(counts[d], sum) + sum;
}

} // namespace

std::span<const uint32_t> DepthSort::sort(std::span<const float> distances, uint32_t flip)
{
    const size_t count = distances.size();
    if (keys_.size() != count || order_.empty()) { // another list
        order_.clear();
        base::assignAmortized(keys_, count, kAbsentKey);
        changed_.resize((count + 63) / 64);
        arrived_.resize((count + 63) / 64);
    }
    const KeyChanges changes{reinterpret_cast<uint8_t*>(changed_.data()),
                             reinterpret_cast<uint8_t*>(arrived_.data())};
    const KeySpan span = makeKeys(distances.data(), flip, keys_.data(), changes, count);
    lowest_ = span.lowest;
    highest_ = span.highest;
    presentCount_ = count - span.absent;
    if (order_.empty() || !updateLastOrder(span.changed, span.newcomers))
        sortAll();
    return order_;
}

/// If few keys have changed, their elements are sorted and merged in; otherwise the elements that are out of
/// order are.
bool DepthSort::updateLastOrder(size_t changed, size_t newcomers)
{
    const size_t limit = presentCount_ / kMaxMovedShare + 8;
    if (newcomers > limit)
        return false;
    sortedElements_ = 0;
    if (changed == 0)
        return true;
    moved_.resize(std::max(moved_.size(), limit + 1));
    blockEnds_.resize(std::max(blockEnds_.size(), order_.size() / kSortedBlock + 1));
    SortedPart sorted{
        keys_.data(),     order_.data(), blockEnds_.data(), 0, 0, order_.size(), 0, moved_.data(), 0,
        limit - newcomers};
    size_t moved = 0;
    if (changed <= limit) {
        keepUnchanged(sorted, reinterpret_cast<const uint8_t*>(changed_.data()));
        moved = take(changed_, 0);
    } else {
        if (!keepSorted(sorted))
            return false;
        moved = newcomers > 0 ? take(arrived_, sorted.displacedCount) : sorted.displacedCount;
    }
    sortedElements_ = moved;
    sortMoved(moved);
    order_.resize(sorted.kept + moved);
    sorted.order = order_.data();
    mergeMoved(sorted, moved_.data(), moved);
    return true;
}

/// Appends the elements of `set` that are present to the first `count` in moved_. @return their number then
size_t DepthSort::take(std::span<const uint64_t> set, size_t count)
{
    for (size_t word = 0; word < set.size(); ++word)
        for (uint64_t bits = set[word]; bits != 0; bits &= bits - 1) {
            const uint32_t index = uint32_t(64 * word) + uint32_t(std::countr_zero(bits));
            if (keys_[index] != kAbsentKey)
                moved_[count++] = pairOf(keys_[index], index);
        }
    return count;
}

/// Walks along the last order and keeps its ascending part, compacted at the front of order_. An element that
/// does not fit is displaced, unless as few of the last sorted elements stand in the way as were displaced
/// just before: then those are the ones that have moved.
/// @return false when too many would be displaced
bool DepthSort::keepSorted(SortedPart& sorted)
{
    constexpr uint64_t kNoPair = uint64_t(kAbsentKey) << 32;
    uint32_t* const order = sorted.order;
    const auto pairAt = [&](size_t place) { return pairOf(sorted.keys[order[place]], order[place]); };
    const auto keep = [&](uint64_t pair) {
        order[sorted.kept++] = uint32_t(pair);
        sorted.last = pair;
    };
    size_t misfits = 0;  // one after another
    size_t nextScan = 0; // where sorted vectors are looked for again
    for (; sorted.at < sorted.count; ++sorted.at) {
        if (sorted.at >= nextScan && misfits == 0) {
            extendSortedByVectors(sorted);
            if (sorted.at == sorted.count)
                break;
            nextScan = sorted.at + kScanPause;
        }
        __builtin_prefetch(&sorted.keys[order[std::min(sorted.at + kAhead, sorted.count - 1)]]);
        const uint64_t pair = pairAt(sorted.at);
        if (pair >= sorted.last && pair < kNoPair) [[likely]] {
            keep(pair);
            misfits = 0;
            continue;
        }
        if (pair >= kNoPair)
            continue;
        size_t inTheWay = 1;
        while (inTheWay <= misfits && inTheWay < sorted.kept && pairAt(sorted.kept - 1 - inTheWay) > pair)
            ++inTheWay;
        const bool sortedYields = inTheWay >= sorted.kept || pairAt(sorted.kept - 1 - inTheWay) <= pair;
        const size_t displacing = sortedYields ? inTheWay : 1;
        if (sorted.displacedCount + displacing > sorted.mostDisplaced ||
            (sorted.at < kProbe && sorted.displacedCount > kProbe / 4))
            return false;
        for (size_t k = 1; k <= displacing; ++k)
            sorted.displaced[sorted.displacedCount++] = sortedYields ? pairAt(sorted.kept - k) : pair;
        misfits = sortedYields ? 0 : misfits + 1;
        if (sortedYields) {
            sorted.kept -= inTheWay;
            keep(pair);
        }
    }
    return true;
}

/// By key, digits from the lowest, then by index.
void DepthSort::sortMoved(size_t count)
{
    const Digits digits(lowest_, highest_, count < kFew ? kFewDigitBits : kMaxDigitBits);
    scratch_.resize(std::max(scratch_.size(), moved_.size()));
    Offsets offsets;
    for (uint32_t pass = 0; pass < digits.passes && count > 1; ++pass) {
        std::fill_n(offsets.begin(), digits.mask + 1, 0u);
        for (size_t i = 0; i < count; ++i)
            ++offsets[digits.of(uint32_t(moved_[i] >> 32), pass)];
        accumulate(offsets, digits.mask);
        for (size_t i = 0; i < count; ++i)
            scratch_[offsets[digits.of(uint32_t(moved_[i] >> 32), pass)]++] = moved_[i];
        moved_.swap(scratch_);
        scratch_.resize(std::max(scratch_.size(), moved_.size()));
    }
    for (size_t begin = 0, end = 0; begin < count; begin = end) { // equal distances: by index
        for (end = begin + 1; end < count && moved_[end] >> 32 == moved_[begin] >> 32;)
            ++end;
        if (end - begin > 1)
            std::sort(moved_.begin() + std::ptrdiff_t(begin), moved_.begin() + std::ptrdiff_t(end));
    }
}

/// The first pass reads the keys in the order of their indices, the last writes indices only.
void DepthSort::sortAll()
{
    const size_t count = keys_.size();
    const Digits digits(lowest_, highest_);
    sortedElements_ = presentCount_;
    order_.resize(count);
    if (digits.passes > 1)
        pairs_.resize(std::max(pairs_.size(), count + 1));
    if (digits.passes > 2)
        scratch_.resize(std::max(scratch_.size(), count));
    std::array<Offsets, kMaxPasses> offsets;
    for (uint32_t p = 0; p < digits.passes; ++p)
        std::fill_n(offsets[p].begin(), digits.mask + 1, 0u);
    for (size_t i = 0; i < count; ++i)
        for (uint32_t p = 0; p < digits.passes; ++p)
            ++offsets[p][digits.of(keys_[i], p)];
    for (uint32_t p = 0; p < digits.passes; ++p)
        accumulate(offsets[p], digits.mask);
    const uint32_t lastPass = digits.passes - 1;
    if (lastPass == 0) {
        for (size_t i = 0; i < count; ++i)
            order_[offsets[0][digits.of(keys_[i], 0)]++] = uint32_t(i);
    } else {
        for (size_t i = 0; i < count; ++i)
            pairs_[offsets[0][digits.of(keys_[i], 0)]++] = pairOf(keys_[i], uint32_t(i));
        uint64_t* from = pairs_.data();
        if (lastPass == 2) {
            for (size_t i = 0; i < count; ++i)
                scratch_[offsets[1][digits.of(uint32_t(from[i] >> 32), 1)]++] = from[i];
            from = scratch_.data();
        }
        for (size_t i = 0; i < count; ++i)
            order_[offsets[lastPass][digits.of(uint32_t(from[i] >> 32), lastPass)]++] = uint32_t(from[i]);
    }
    order_.resize(presentCount_); // absent elements are at the end
}

} // namespace fx::render
