#include "rendering/draw_order/depth_sort.h"

#include "rendering/draw_order/depth_keys.h"
#include "rendering/draw_order/rising_run.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

namespace fx::render {

namespace {

constexpr uint32_t kMostDigitBits = 13; ///< as many places to write to as the caches near the core follow
constexpr size_t kMostPasses = 3;
constexpr size_t kProbe = 2048;       ///< elements after which a hopeless mending is given up
constexpr size_t kRunPause = 16;      ///< elements after a run before another is looked for
constexpr size_t kAhead = 32;         ///< elements whose keys are fetched before they are looked at
constexpr size_t kMostMovedShare = 6; ///< mending pays while less than one in so many has moved
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

    Digits(uint32_t low, uint32_t high, uint32_t mostBits = kMostDigitBits)
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

using Offsets = std::array<uint32_t, size_t(1) << kMostDigitBits>;

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
        keys_.assign(count, kAbsentKey);
        changed_.resize((count + 63) / 64);
        arrived_.resize((count + 63) / 64);
    }
    const KeyChanges changes{reinterpret_cast<uint8_t*>(changed_.data()),
                             reinterpret_cast<uint8_t*>(arrived_.data())};
    const KeySpan span = makeKeys(distances.data(), flip, keys_.data(), changes, count);
    lowest_ = span.lowest;
    highest_ = span.highest;
    presentCount_ = count - span.absent;
    if (order_.empty() || !mendLastOrder(span.changed, span.newcomers))
        sortAll();
    return order_;
}

/// If few keys have changed, their elements are sorted and merged in; otherwise the elements that are out of
/// order are.
bool DepthSort::mendLastOrder(size_t changed, size_t newcomers)
{
    const size_t limit = presentCount_ / kMostMovedShare + 8;
    if (newcomers > limit)
        return false;
    sortedElements_ = 0;
    if (changed == 0)
        return true;
    moved_.resize(std::max(moved_.size(), limit + 1));
    blockEnds_.resize(std::max(blockEnds_.size(), order_.size() / kChainBlock + 1));
    Chain chain{keys_.data(),     order_.data(), blockEnds_.data(), 0, 0, order_.size(), 0, moved_.data(), 0,
                limit - newcomers};
    size_t moved = 0;
    if (changed <= limit) {
        keepUnchanged(chain, reinterpret_cast<const uint8_t*>(changed_.data()));
        moved = take(changed_, 0);
    } else {
        if (!keepRising(chain))
            return false;
        moved = newcomers > 0 ? take(arrived_, chain.asideCount) : chain.asideCount;
    }
    sortedElements_ = moved;
    sortMoved(moved);
    order_.resize(chain.kept + moved);
    chain.order = order_.data();
    mergeMoved(chain, moved_.data(), moved);
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

/// Walks along the last order and keeps a rising chain, moved together at the front of order_. Who does not
/// fit is put aside, unless as few of the chain's last stand in the way as were put aside just before: then
/// those are the ones that have moved.
/// @return false when too many would be put aside
bool DepthSort::keepRising(Chain& chain)
{
    constexpr uint64_t kNobody = uint64_t(kAbsentKey) << 32;
    uint32_t* const order = chain.order;
    const auto pairAt = [&](size_t place) { return pairOf(chain.keys[order[place]], order[place]); };
    const auto keep = [&](uint64_t pair) {
        order[chain.kept++] = uint32_t(pair);
        chain.last = pair;
    };
    size_t misfits = 0; // one after another
    size_t nextRun = 0; // where a run of many is looked for again
    for (; chain.at < chain.count; ++chain.at) {
        if (chain.at >= nextRun && misfits == 0) {
            keepRisingRun(chain);
            if (chain.at == chain.count)
                break;
            nextRun = chain.at + kRunPause;
        }
        __builtin_prefetch(&chain.keys[order[std::min(chain.at + kAhead, chain.count - 1)]]);
        const uint64_t pair = pairAt(chain.at);
        if (pair >= chain.last && pair < kNobody) [[likely]] {
            keep(pair);
            misfits = 0;
            continue;
        }
        if (pair >= kNobody)
            continue;
        size_t inTheWay = 1;
        while (inTheWay <= misfits && inTheWay < chain.kept && pairAt(chain.kept - 1 - inTheWay) > pair)
            ++inTheWay;
        const bool chainYields = inTheWay >= chain.kept || pairAt(chain.kept - 1 - inTheWay) <= pair;
        const size_t aside = chainYields ? inTheWay : 1;
        if (chain.asideCount + aside > chain.mostAside ||
            (chain.at < kProbe && chain.asideCount > kProbe / 4))
            return false;
        for (size_t k = 1; k <= aside; ++k)
            chain.aside[chain.asideCount++] = chainYields ? pairAt(chain.kept - k) : pair;
        misfits = chainYields ? 0 : misfits + 1;
        if (chainYields) {
            chain.kept -= inTheWay;
            keep(pair);
        }
    }
    return true;
}

/// By key, digits from the lowest, then by index.
void DepthSort::sortMoved(size_t count)
{
    const Digits digits(lowest_, highest_, count < kFew ? kFewDigitBits : kMostDigitBits);
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
    std::array<Offsets, kMostPasses> offsets;
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
