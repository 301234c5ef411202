#include "simulation/sph/neighbors/morton_sort.h"

#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/neighbors/morton.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace fx::sim {

namespace {

constexpr uint32_t kBlock = 32768;  ///< particles of a histogram
constexpr uint32_t kDigitBits = 11; ///< of a pass at most
constexpr uint32_t kDigits = 1u << kDigitBits;
constexpr uint32_t kPlaceBits = 29; ///< of a word; the rest are bits of its key
constexpr uint32_t kMaxPasses = (64 - kPlaceBits) / kDigitBits;
constexpr uint32_t kMaxDepth = 4;   ///< of curves within cells of curves
constexpr uint32_t kInsertion = 32; ///< runs up to this length are sorted by insertion

uint32_t blocksOf(size_t count)
{
    return uint32_t((count + kBlock - 1) / kBlock);
}

void countDigits(const uint64_t* words, uint32_t count, uint32_t shift, uint64_t mask, uint32_t* histogram)
{
    std::fill_n(histogram, mask + 1, 0u);
    for (uint32_t i = 0; i < count; ++i)
        ++histogram[words[i] >> shift & mask];
}

/// Moves words to the slots that `next` has for their digits, one after another.
void moveByDigits(const uint64_t* words, uint32_t count, uint32_t shift, uint64_t mask, uint32_t* next,
                  uint64_t* to)
{
    for (uint32_t i = 0; i < count; ++i) {
        const uint64_t word = words[i];
        to[next[word >> shift & mask]++] = word;
    }
}

/// Runs loops where it is, for the parts of a loop that is parallel already.
class HereRunner final : public base::TaskRunner
{
public:
    void run(uint32_t count, uint32_t, base::LoopBody body, void* argument) override
    {
        if (count > 0)
            body(argument, 0, count);
    }
};

/// Low and high of one axis; NaN is left out.
template <class T>
std::pair<double, double> extremes(const T* x, uint32_t begin, uint32_t end)
{
    constexpr uint32_t kChains = 16; // independent, so that the compiler uses vectors
    std::array<T, kChains> low;
    std::array<T, kChains> high;
    low.fill(std::numeric_limits<T>::infinity());
    high.fill(-std::numeric_limits<T>::infinity());
    uint32_t i = begin;
    for (; i + kChains <= end; i += kChains)
        for (uint32_t k = 0; k < kChains; ++k) {
            low[k] = x[i + k] < low[k] ? x[i + k] : low[k];
            high[k] = x[i + k] > high[k] ? x[i + k] : high[k];
        }
    for (; i < end; ++i) {
        low[0] = std::min(low[0], x[i]);
        high[0] = std::max(high[0], x[i]);
    }
    return {double(*std::min_element(low.begin(), low.end())),
            double(*std::max_element(high.begin(), high.end()))};
}

/// Cell of a coordinate; what is out of range or not a number lands in a border cell.
uint32_t cellOf(double x, double low, double perCell)
{
    constexpr double kMax = double((1u << kMortonAxisBits) - 1);
    const double cell = (x - low) * perCell;
    return uint32_t(cell < kMax ? (cell > 0 ? cell : 0.0) : kMax);
}

} // namespace

/// Some bits of a word.
template <class T>
struct MortonSort<T>::Digit
{
    uint32_t shift;
    uint32_t bits;
};

/// Places [begin, end).
template <class T>
struct MortonSort<T>::Range
{
    uint32_t begin;
    uint32_t end;
    uint32_t count() const { return end - begin; }
};

template <class T>
MortonSort<T>::MortonSort(std::pmr::memory_resource* memory, uint32_t capacity)
    : keys_(memory, capacity), order_(memory, capacity), words_(memory, capacity),
      spareWords_(memory, capacity), spareOrder_(memory, capacity),
      histogram_(memory, size_t(blocksOf(capacity)) * kDigits),
      firstRun_(memory, size_t(blocksOf(capacity)) + 1), bounds_(memory, blocksOf(capacity))
{}

template <class T>
void MortonSort<T>::sort(const std::array<const T*, 3>& axes, uint32_t count, const Domain& domain,
                         base::TaskRunner& tasks)
{
    count_ = count;
    if (count == 0)
        return;
    axes_ = axes;
    makeKeys(domain, tasks);
    sortRange({0, count}, 0, histogram_.first(size_t(blocksOf(count)) * kDigits), tasks);
}

/// Low and high of all particles [m].
template <class T>
std::array<double, 6> MortonSort<T>::boundsOfAll(base::TaskRunner& tasks)
{
    const uint32_t blocks = blocksOf(count_);
    parallelRows(tasks, blocks, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t block = begin; block < end; ++block)
            for (uint32_t a = 0; a < 3; ++a)
                std::tie(bounds_[block][a], bounds_[block][3 + a]) =
                    extremes(axes_[a], block * kBlock, std::min(count_, (block + 1) * kBlock));
    });
    std::array<double, 6> bounds = bounds_[0];
    for (uint32_t block = 1; block < blocks; ++block)
        for (uint32_t a = 0; a < 3; ++a) {
            bounds[a] = std::min(bounds[a], bounds_[block][a]);
            bounds[3 + a] = std::max(bounds[3 + a], bounds_[block][3 + a]);
        }
    return bounds;
}

template <class T>
void MortonSort<T>::makeKeys(const Domain& domain, base::TaskRunner& tasks)
{
    std::array<double, 6> bounds = boundsOfAll(tasks);
    double extent = 0;
    for (uint32_t a = 0; a < 3; ++a) {
        if (domain.axes[a] == AxisKind::Periodic) {
            bounds[a] = domain.low[int(a)];
            bounds[3 + a] = domain.high[int(a)];
        }
        extent = std::max(extent, bounds[3 + a] - bounds[a]);
    }
    const double perCell = extent > 0 ? double(1u << kMortonAxisBits) / extent : 0.0;
    const std::array<double, 3> low{bounds[0], bounds[1], bounds[2]};
    parallelRows(tasks, count_, kBlock, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            keys_[i] = keyOf(i, low, perCell);
            order_[i] = i;
        }
    });
}

template <class T>
uint64_t MortonSort<T>::keyOf(uint32_t index, const std::array<double, 3>& low, double perCell) const
{
    return mortonKey(cellOf(double(axes_[0][index]), low[0], perCell),
                     cellOf(double(axes_[1][index]), low[1], perCell),
                     cellOf(double(axes_[2][index]), low[2], perCell));
}

/// Bits in which keys of a range differ.
template <class T>
uint64_t MortonSort<T>::differingBits(Range range, base::TaskRunner& tasks) const
{
    std::atomic<uint64_t> all{0};
    parallelRows(tasks, range.count(), kBlock, [&](uint32_t begin, uint32_t end) {
        uint64_t bits = 0;
        for (uint32_t i = range.begin + begin; i < range.begin + end; ++i)
            bits |= keys_[i] ^ keys_[range.begin];
        all.fetch_or(bits, std::memory_order_relaxed);
    });
    return all;
}

/// Sorts keys and order of a range. `histogram` has one row a block; with one row everything happens here.
template <class T>
void MortonSort<T>::sortRange(Range range, uint32_t depth, std::span<uint32_t> histogram,
                              base::TaskRunner& tasks)
{
    const uint32_t highBit = uint32_t(std::bit_width(differingBits(range, tasks)));
    if (highBit == 0) {
        sortCell(range, depth);
        return;
    }
    const uint32_t enough = uint32_t(std::bit_width(range.count())) + 3; // most slots are told apart then
    const uint32_t wanted = std::min(highBit, enough);
    const uint32_t passes = std::min((wanted + kDigitBits - 1) / kDigitBits, kMaxPasses);
    const uint32_t digitBits = std::min((wanted + passes - 1) / passes, kDigitBits);
    const uint32_t sorted = passes * digitBits;
    const uint32_t lowBit = highBit > sorted ? highBit - sorted : 0;
    const uint64_t mask = (uint64_t(1) << sorted) - 1;
    uint64_t* from = passes % 2 == 0 ? words_.data() : spareWords_.data();
    uint64_t* to = passes % 2 == 0 ? spareWords_.data() : words_.data();
    parallelRows(tasks, range.count(), kBlock, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            from[range.begin + i] = ((keys_[range.begin + i] >> lowBit) & mask) << kPlaceBits | i;
    });
    for (uint32_t pass = 0; pass < passes; ++pass) {
        scatter(from, to, range, {kPlaceBits + pass * digitBits, digitBits}, histogram, tasks);
        std::swap(from, to);
    }
    moveToWords(range, tasks);
    sortRuns(range, lowBit, depth, uint32_t(histogram.size() / kDigits), tasks);
}

/// One pass: by one digit of the words, stable.
template <class T>
void MortonSort<T>::scatter(const uint64_t* from, uint64_t* to, Range range, Digit digit,
                            std::span<uint32_t> histogram, base::TaskRunner& tasks)
{
    const uint32_t blocks = uint32_t(histogram.size() / kDigits);
    const uint32_t size = (range.count() + blocks - 1) / blocks;
    const uint64_t mask = (uint64_t(1) << digit.bits) - 1;
    const auto part = [&](uint32_t block) {
        return Range{range.begin + std::min(range.count(), block * size),
                     range.begin + std::min(range.count(), (block + 1) * size)};
    };
    parallelRows(tasks, blocks, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t block = begin; block < end; ++block)
            countDigits(from + part(block).begin, part(block).count(), digit.shift, mask,
                        histogram.data() + block * kDigits);
    });
    uint32_t next = range.begin;
    for (uint32_t value = 0; value <= mask; ++value)
        for (uint32_t block = 0; block < blocks; ++block)
            next += std::exchange(histogram[block * kDigits + value], next);
    parallelRows(tasks, blocks, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t block = begin; block < end; ++block)
            moveByDigits(from + part(block).begin, part(block).count(), digit.shift, mask,
                         histogram.data() + block * kDigits, to);
    });
}

/// Puts keys and order in the order of the words.
template <class T>
void MortonSort<T>::moveToWords(Range range, base::TaskRunner& tasks)
{
    parallelRows(tasks, range.count(), kBlock, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = range.begin + begin; i < range.begin + end; ++i) {
            const uint32_t source = range.begin + uint32_t(words_[i] & ((1u << kPlaceBits) - 1));
            spareWords_[i] = keys_[source];
            spareOrder_[i] = order_[source];
        }
    });
    if (range.count() == count_) { // everything has moved: no need to move it back
        std::swap(keys_, spareWords_);
        std::swap(order_, spareOrder_);
        return;
    }
    std::copy(spareWords_.data() + range.begin, spareWords_.data() + range.end, keys_.data() + range.begin);
    std::copy(spareOrder_.data() + range.begin, spareOrder_.data() + range.end, order_.data() + range.begin);
}

/// Sorts further all runs whose keys are equal from `lowBit` up. Every block has the runs that begin in it.
template <class T>
void MortonSort<T>::sortRuns(Range range, uint32_t lowBit, uint32_t depth, uint32_t blocks,
                             base::TaskRunner& tasks)
{
    const auto begins = [&](uint32_t i) {
        return i == range.begin || i == range.end || keys_[i - 1] >> lowBit != keys_[i] >> lowBit;
    };
    const uint32_t size = (range.count() + blocks - 1) / blocks;
    if (blocks == 1) {
        sortRunsOf(range, lowBit, depth);
        return;
    }
    for (uint32_t block = 0; block <= blocks; ++block) {
        uint32_t first = range.begin + std::min(range.count(), block * size);
        if (block > 0)
            first = std::max(first, firstRun_[block - 1]);
        while (!begins(first))
            ++first;
        firstRun_[block] = first;
    }
    parallelRows(tasks, blocks, 1, [&](uint32_t begin, uint32_t end) {
        sortRunsOf({firstRun_[begin], firstRun_[end]}, lowBit, depth);
    });
}

template <class T>
void MortonSort<T>::sortRunsOf(Range range, uint32_t lowBit, uint32_t depth)
{
    uint32_t first = range.begin;
    while (first < range.end) {
        uint32_t last = first + 1;
        while (last < range.end && keys_[last - 1] >> lowBit == keys_[last] >> lowBit)
            ++last;
        if (last - first > kInsertion) {
            std::array<uint32_t, kDigits> histogram;
            HereRunner here;
            sortRange({first, last}, depth, histogram, here);
        } else {
            insert(first, last);
        }
        first = last;
    }
}

/// Sorts particles with equal keys by keys within their own box, and restores the keys.
template <class T>
void MortonSort<T>::sortCell(Range range, uint32_t depth)
{
    if (depth == kMaxDepth || range.count() <= kInsertion)
        return;
    std::array<double, 3> low;
    double extent = 0;
    for (uint32_t a = 0; a < 3; ++a) {
        T least = axes_[a][order_[range.begin]];
        T most = least;
        for (uint32_t i = range.begin; i < range.end; ++i) {
            least = std::min(least, axes_[a][order_[i]]);
            most = std::max(most, axes_[a][order_[i]]);
        }
        low[a] = double(least);
        extent = std::max(extent, double(most) - low[a]);
    }
    const double perCell = double(1u << kMortonAxisBits) / extent;
    if (!std::isfinite(perCell)) // all at one position
        return;
    const uint64_t key = keys_[range.begin];
    for (uint32_t i = range.begin; i < range.end; ++i)
        keys_[i] = keyOf(order_[i], low, perCell);
    std::array<uint32_t, kDigits> histogram;
    HereRunner here;
    sortRange(range, depth + 1, histogram, here);
    std::fill(keys_.data() + range.begin, keys_.data() + range.end, key);
}

template <class T>
void MortonSort<T>::insert(uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin + 1; i < end; ++i) {
        const uint64_t key = keys_[i];
        const uint32_t index = order_[i];
        uint32_t slot = i;
        for (; slot > begin && keys_[slot - 1] > key; --slot) {
            keys_[slot] = keys_[slot - 1];
            order_[slot] = order_[slot - 1];
        }
        keys_[slot] = key;
        order_[slot] = index;
    }
}

template class MortonSort<float>;
template class MortonSort<double>;

} // namespace fx::sim
