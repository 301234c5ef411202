#include "rendering/reference/dazzle/dazzle_levels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::render {

namespace {

__extension__ typedef unsigned __int128 uint128;

constexpr uint32_t kWhite = 255;

struct Histogram
{
    uint64_t over = 0;
    uint64_t headroom = 0;
    std::array<uint64_t, kWhite + 1> count{};
};

Histogram histogramOf(std::span<const uint32_t> levels)
{
    Histogram histogram;
    for (const uint32_t level : levels) {
        if (level > kWhite) {
            histogram.over += level - kWhite;
            continue;
        }
        histogram.headroom += kWhite - level;
        ++histogram.count[level];
    }
    return histogram;
}

/// [level] glare that is wanted, cut to the headroom.
uint64_t glareOf(const Histogram& histogram, double gain)
{
    if (gain == 1.0)
        return std::min(histogram.over, histogram.headroom);
    const double wanted = std::floor(double(histogram.over) * gain + 0.5);
    return wanted < double(histogram.headroom) ? uint64_t(wanted) : histogram.headroom;
}

/// q_i of every level, (1).
std::array<uint64_t, kWhite + 1> quotas(const Histogram& histogram, uint64_t glare)
{
    std::array<uint64_t, kWhite + 1> quota{};
    if (histogram.headroom == 0)
        return quota;
    uint64_t above = 0;
    uint64_t dealt = 0;
    for (uint32_t i = kWhite + 1; i-- > 0;) {
        above += histogram.count[i] * (kWhite - i);
        const uint64_t sum = uint64_t(uint128(glare) * above / histogram.headroom);
        quota[i] = sum - dealt;
        dealt = sum;
    }
    return quota;
}

} // namespace

std::vector<uint8_t> dazzleLevels(std::span<const uint32_t> levels, double gain)
{
    const Histogram histogram = histogramOf(levels);
    const std::array<uint64_t, kWhite + 1> quota = quotas(histogram, glareOf(histogram, gain));
    std::array<uint64_t, kWhite + 1> seen{};
    std::vector<uint8_t> out;
    out.reserve(levels.size());
    for (const uint32_t level : levels) {
        if (level >= kWhite) {
            out.push_back(uint8_t(kWhite));
            continue;
        }
        const uint64_t count = histogram.count[level];
        const uint64_t rest = quota[level] % count;
        const uint64_t n = seen[level]++;
        const bool isRaised = (n + 1) * rest / count > n * rest / count; // (2)
        out.push_back(uint8_t(level + quota[level] / count + (isRaised ? 1 : 0)));
    }
    return out;
}

std::vector<int64_t> dazzleLevelsAsPrinted(std::span<const uint32_t> levels)
{
    const Histogram histogram = histogramOf(levels);
    int64_t over = int64_t(histogram.over);
    int64_t sum = int64_t(histogram.headroom);
    std::array<int64_t, kWhite + 1> increment{};
    for (int64_t i = kWhite; i >= 0 && sum != 0; --i) {
        const int64_t wanted = over * (int64_t(kWhite) - i);
        const int64_t count = int64_t(histogram.count[size_t(i)]);
        increment[size_t(i)] = wanted / sum + (wanted % sum > sum / 2 ? 1 : 0);
        over -= count * increment[size_t(i)];
        sum -= count * (int64_t(kWhite) - i);
    }
    std::vector<int64_t> out;
    out.reserve(levels.size());
    for (const uint32_t level : levels)
        out.push_back(level > kWhite ? int64_t(kWhite) : int64_t(level) + increment[level]);
    return out;
}

} // namespace fx::render
