#include "rendering/reference/trace/curve_order.h"

#include <algorithm>
#include <array>
#include <utility>

namespace fx::render {

namespace {

constexpr uint32_t kDigitBits = 11; ///< sorted at a time
constexpr uint32_t kDigits = 1u << kDigitBits;
constexpr uint32_t kChunk = 1u << 14; ///< elements whose digits are counted together

using Counts = std::array<uint32_t, kDigits>;

uint32_t digitOf(const KeyedIndex& element, uint32_t shift)
{
    return uint32_t(element.key >> shift) & (kDigits - 1);
}

/// Turns counts of chunks into the places where each chunk's elements of each digit begin.
/// @return false if all elements have the same digit
bool placeChunks(std::vector<Counts>& ioCounts, size_t total)
{
    uint32_t sum = 0;
    for (uint32_t digit = 0; digit < kDigits; ++digit) {
        const uint32_t before = sum;
        for (Counts& counts : ioCounts)
            sum += std::exchange(counts[digit], sum);
        if (sum - before == total)
            return false;
    }
    return true;
}

} // namespace

void sortByKey(std::vector<KeyedIndex>& io, std::vector<KeyedIndex>& scratch, base::TaskRunner& tasks)
{
    const size_t count = io.size();
    const uint32_t chunks = uint32_t((count + kChunk - 1) / kChunk);
    scratch.resize(count);
    std::vector<Counts> counts(chunks);
    uint64_t used = 0;
    for (const KeyedIndex& element : io)
        used |= element.key;
    const auto rangeOf = [count](uint32_t chunk) {
        return std::pair(size_t(chunk) * kChunk, std::min(size_t(chunk + 1) * kChunk, count));
    };
    for (uint32_t shift = 0; shift < 64 && (used >> shift) != 0; shift += kDigitBits) {
        tasks.parallelFor(chunks, 1, [&](uint32_t first, uint32_t last) {
            for (uint32_t chunk = first; chunk < last; ++chunk) {
                counts[chunk].fill(0);
                const auto [begin, end] = rangeOf(chunk);
                for (size_t i = begin; i < end; ++i)
                    ++counts[chunk][digitOf(io[i], shift)];
            }
        });
        if (!placeChunks(counts, count))
            continue;
        tasks.parallelFor(chunks, 1, [&](uint32_t first, uint32_t last) {
            for (uint32_t chunk = first; chunk < last; ++chunk) {
                const auto [begin, end] = rangeOf(chunk);
                for (size_t i = begin; i < end; ++i)
                    scratch[counts[chunk][digitOf(io[i], shift)]++] = io[i];
            }
        });
        io.swap(scratch);
    }
}

} // namespace fx::render
