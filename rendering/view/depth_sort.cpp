#include "rendering/view/depth_sort.h"

#include "rendering/view/depth_keys.h"
#include "rendering/view/rising_run.h"

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
    if (keys_.size() != distances.size()) // another list
        order_.clear();
    keys_.swap(lastKeys_);
    keys_.resize(distances.size());
    if (order_.empty())
        lastKeys_.assign(distances.size(), kAbsentKey);
    const KeySpan span = makeKeys(distances.data(), flip, lastKeys_.data(), keys_.data(), distances.size());
    lowest_ = span.lowest;
    highest_ = span.highest;
    presentCount_ = distances.size() - span.absent;
    newcomers_ = span.newcomers;
    if (order_.empty() || !mendLastOrder())
        sortAll();
    return order_;
}

bool DepthSort::mendLastOrder()
{
    const size_t limit = presentCount_ / kMostMovedShare + 8;
    if (newcomers_ > limit)
        return false;
    moved_.resize(std::max(moved_.size(), limit + 1));
    blockEnds_.resize(std::max(blockEnds_.size(), order_.size() / kChainBlock + 1));
    size_t kept = 0;
    size_t moved = 0;
    if (!splitLastOrder(limit - newcomers_, &kept, &moved))
        return false;
    takeNewcomers(&moved);
    sortedElements_ = moved;
    order_.resize(kept);
    sortMoved(moved);
    merge(kept, moved);
    return true;
}

/// Walks along the last order and keeps a rising chain, moved together at the front of order_. Who does not
/// fit is put aside, unless as few of the chain's last stand in the way as were put aside just before: then
/// those are the ones that have moved.
/// @return false when more than `limit` would be put aside
bool DepthSort::splitLastOrder(size_t limit, size_t* outKept, size_t* outMoved)
{
    constexpr uint64_t kNobody = uint64_t(kAbsentKey) << 32;
    Chain chain{keys_.data(), order_.data(), blockEnds_.data(), 0, 0, order_.size(), 0, moved_.data(), 0,
                limit};
    uint32_t* const order = chain.order;
    const auto pairAt = [&](size_t place) { return pairOf(chain.keys[order[place]], order[place]); };
    const auto keep = [&](uint64_t pair) {
        chain.blockEnds[chain.kept / kChainBlock] = uint32_t(pair >> 32);
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
            nextRun = chain.at + kChainBlock;
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
        if (chain.asideCount + aside > limit || (chain.at < kProbe && chain.asideCount > kProbe / 4))
            return false;
        for (size_t k = 1; k <= aside; ++k)
            chain.aside[chain.asideCount++] = chainYields ? pairAt(chain.kept - k) : pair;
        misfits = chainYields ? 0 : misfits + 1;
        if (chainYields) {
            chain.kept -= inTheWay;
            keep(pair);
        }
    }
    *outKept = chain.kept;
    *outMoved = chain.asideCount;
    return true;
}

/// Appends who was absent in the last order.
void DepthSort::takeNewcomers(size_t* ioMoved)
{
    for (size_t i = 0; newcomers_ > 0 && i < keys_.size(); ++i)
        if (lastKeys_[i] == kAbsentKey && keys_[i] != kAbsentKey) {
            moved_[(*ioMoved)++] = pairOf(keys_[i], uint32_t(i));
            --newcomers_;
        }
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
    for (size_t begin = 0, end = 0; begin < count; begin = end) { // who is equally far: by index
        for (end = begin + 1; end < count && moved_[end] >> 32 == moved_[begin] >> 32;)
            ++end;
        if (end - begin > 1)
            std::sort(moved_.begin() + std::ptrdiff_t(begin), moved_.begin() + std::ptrdiff_t(end));
    }
}

/// The first block of the chain, at most `block`, before which all blocks stand before `key`: found by the
/// keys of the blocks' ends, which lie side by side. Asks for the keys of its elements.
size_t DepthSort::blockOf(const Chain& chain, uint32_t key, size_t block)
{
    while (block > 0 && chain.blockEnds[block - 1] >= key)
        --block;
    const size_t end = std::min((block + 1) * kChainBlock, chain.kept);
    for (size_t place = block * kChainBlock; place < end; ++place)
        __builtin_prefetch(&chain.keys[chain.order[place]]);
    return block;
}

/// How many of the first `end` of the chain stand before `pair`, from `block` on.
size_t DepthSort::placeIn(const Chain& chain, uint64_t pair, size_t block, size_t end)
{
    for (size_t place = block * kChainBlock; place < end; place += kChainBlock) {
        const size_t beyond = std::min(place + kChainBlock, end);
        const size_t before = countBelow(chain, place, beyond, pair);
        if (place + before < beyond)
            return place + before;
    }
    return end;
}

/// From the end: each of those who moved has its place looked for ahead of the one before it, and what lies
/// between moves up as a block. Blocks are looked for some elements ahead, so that keys have come by then.
void DepthSort::merge(size_t kept, size_t moved)
{
    constexpr size_t kLead = 8;
    order_.resize(kept + moved);
    uint32_t* order = order_.data();
    const Chain chain{keys_.data(), order, blockEnds_.data(), kept, kept, kept, 0, nullptr, 0, 0};
    std::array<size_t, kLead> blocks{};
    size_t block = (kept + kChainBlock - 1) / kChainBlock;
    size_t end = kept; // of the chain that is still in its old place
    for (size_t step = 0; step < moved + kLead; ++step) {
        const size_t known = blocks[step % kLead];
        if (step < moved)
            blocks[step % kLead] = block = blockOf(chain, uint32_t(moved_[moved - 1 - step] >> 32), block);
        if (step < kLead)
            continue;
        const size_t left = moved + kLead - step;
        const uint64_t pair = moved_[left - 1];
        const size_t high = placeIn(chain, pair, known, end); // all from here on are behind it
        std::memmove(order + high + left, order + high, (end - high) * sizeof *order);
        order[high + left - 1] = uint32_t(pair);
        end = high;
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
    order_.resize(presentCount_); // who is absent stands at the end
}

} // namespace fx::render
