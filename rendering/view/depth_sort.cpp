#include "rendering/view/depth_sort.h"

#include "rendering/view/depth_keys.h"

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

uint64_t pairOf(uint32_t key, uint32_t index)
{
    return uint64_t(key) << 32 | index;
}

/// How keys from `lowest` on are cut into digits.
struct Digits
{
    uint32_t lowest, beyond; ///< beyond: what absent keys become, one more than the highest
    uint32_t passes, bits, mask;

    Digits(uint32_t low, uint32_t high) : lowest(low), beyond(high - low + 1)
    {
        const uint32_t width = std::max<uint32_t>(uint32_t(std::bit_width(beyond)), 1);
        passes = (width + kMostDigitBits - 1) / kMostDigitBits;
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
    uint32_t* order = order_.data();
    const uint32_t* keys = keys_.data();
    const auto pairAt = [&](size_t place) { return pairOf(keys[order[place]], order[place]); };
    size_t kept = 0;
    size_t moved = 0;
    size_t misfits = 0; // one after another
    uint64_t last = 0;
    const size_t count = order_.size();
    for (size_t i = 0; i < count; ++i) {
        __builtin_prefetch(&keys[order[std::min(i + kAhead, count - 1)]]);
        const uint64_t pair = pairAt(i);
        if (pair >= last && pair < kNobody) [[likely]] {
            order[kept++] = uint32_t(pair);
            last = pair;
            misfits = 0;
            continue;
        }
        if (pair >= kNobody)
            continue;
        size_t inTheWay = 1;
        while (inTheWay <= misfits && inTheWay < kept && pairAt(kept - 1 - inTheWay) > pair)
            ++inTheWay;
        const bool chainYields = inTheWay >= kept || pairAt(kept - 1 - inTheWay) <= pair;
        const size_t aside = chainYields ? inTheWay : 1;
        if (moved + aside > limit || (i < kProbe && moved > kProbe / 4))
            return false;
        if (chainYields) {
            for (size_t k = 1; k <= inTheWay; ++k)
                moved_[moved + k - 1] = pairAt(kept - k);
            kept -= inTheWay;
            order[kept++] = uint32_t(pair);
            last = pair;
            misfits = 0;
        } else {
            moved_[moved] = pair;
            ++misfits;
        }
        moved += aside;
    }
    *outKept = kept;
    *outMoved = moved;
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
    const Digits digits(lowest_, highest_);
    scratch_.resize(std::max(scratch_.size(), moved_.size()));
    for (uint32_t pass = 0; pass < digits.passes && count > 1; ++pass) {
        Offsets offsets{};
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

/// From the end: each of those who moved has its place looked for ahead of the one before it, in steps that
/// double, and what lies between moves up as a block.
void DepthSort::merge(size_t kept, size_t moved)
{
    order_.resize(kept + moved);
    uint32_t* order = order_.data();
    size_t end = kept; // of the chain that is still in its old place
    for (size_t left = moved; left > 0; --left) {
        const uint64_t pair = moved_[left - 1];
        const auto isBehind = [&](size_t place) { return pairOf(keys_[order[place]], order[place]) > pair; };
        size_t step = 1;
        size_t high = end; // all from here on are behind it
        while (high >= step && isBehind(high - step)) {
            high -= step;
            step *= 2;
        }
        size_t low = high >= step ? high - step + 1 : 0;
        while (low < high) {
            const size_t middle = low + (high - low) / 2;
            if (isBehind(middle))
                high = middle;
            else
                low = middle + 1;
        }
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
