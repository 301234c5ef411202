#include "rendering/reference/dazzle/dazzle_reference.h"

#include "rendering/reference/dazzle/dazzle_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace fx::render {

namespace {

/// exp(-x) for x >= 0: the text of dazzle_budget.comp.glsl. x = n ln 2 - r with |r| <= ln 2 / 2; the first
/// half of ln 2 has 32 bits, so that its product with n is exact; 13 terms of the series leave 2^-57.
double expOfMinus(double x)
{
    constexpr double kOverFactorial[] = {
        1.6059043836821613e-10, 2.08767569878681e-09, 2.505210838544172e-08, 2.755731922398589e-07,
        2.7557319223985893e-06, 2.48015873015873e-05, 0.0001984126984126984, 0.001388888888888889,
        0.008333333333333333,   0.041666666666666664, 0.16666666666666666,   0.5}; // 1 / 13!, ... 1 / 2!
    if (!(x < 700.0))
        return 0.0;
    const double n = std::floor(x * 1.4426950408889634 + 0.5);
    const double r = (n * 6.93147180369123816490e-01 - x) + n * 1.90821492927058770002e-10;
    double sum = 0.0;
    for (const double term : kOverFactorial)
        sum = sum * r + term;
    sum = (sum * r + 1.0) * r + 1.0;
    return sum * std::bit_cast<double>(uint64_t(1023 - int64_t(n)) << 52);
}

/// Visits the pixels in the order in which the GPU deals: tiles row by row, in a tile 4 pixels a thread.
template <class Visit>
void forEachPixel(int width, int height, const Visit& visit)
{
    for (int top = 0; top < height; top += 16)
        for (int left = 0; left < width; left += 16)
            for (int y = top; y < std::min(top + 16, height); ++y)
                for (int x = left; x < std::min(left + 16, width); ++x)
                    visit(size_t(y) * size_t(width) + size_t(x));
}

/// The same three roundings as dazzle_budget.comp.glsl.
double toDouble(DazzleCount a)
{
    constexpr double kWord = 4294967296.0;
    const double high = double(uint32_t(a >> 64)) * kWord + double(uint32_t(a >> 32));
    return high * kWord + double(uint32_t(a));
}

double adapt(const DazzleHistory& history, int channel, double frame, const DazzleSettings& settings,
             double deltaTime, bool resetHistory)
{
    const double state = history.adapted[channel];
    const double keep = dazzleKeep(deltaTime, frame > state ? settings.riseTime : settings.fallTime);
    const bool usable = !resetHistory && history.valid == 1 && state >= 0.0 && state < 1e30;
    return usable && keep != 0.0 ? frame + (state - frame) * keep : frame;
}

uint64_t budgetOf(double state, double frame, const DazzleSum& sum, double capacity,
                  const DazzleSettings& settings)
{
    const uint64_t headroom = uint64_t(sum.headroom);
    if (state == frame && settings.a == 1.0f && settings.b == 0.0f)
        return sum.overflow > headroom ? headroom : uint64_t(sum.overflow);
    const double wanted = std::floor(state * dazzleGain(state, settings) * capacity);
    return wanted < toDouble(headroom) ? uint64_t(wanted) : headroom;
}

/// Deals `budget` quanta of one channel to `io` in proportion to headroom.
void deal(std::vector<float>& io, int width, int height, int channel, const DazzleCounter& counter,
          uint64_t budget, uint64_t headroom)
{
    const bool saturated = budget == headroom;
    const DazzleCount numerator = DazzleCount(budget) << 64;
    const DazzleCount share = saturated ? 0 : (numerator + headroom - 1) / headroom;
    const auto dealtBefore = [&](DazzleCount c) { return saturated ? c : (c * share) >> 64; };
    const float quantum = std::ldexp(1.0f, counter.scale().exponent);

    DazzleCount before = 0;
    forEachPixel(width, height, [&](size_t pixel) {
        float& value = io[pixel * 4 + size_t(channel)];
        const DazzleQuanta quanta = counter.count(std::bit_cast<uint32_t>(value));
        const DazzleCount after = before + quanta.headroom;
        const DazzleCount increment = dealtBefore(after) - dealtBefore(before);
        before = after;
        if (quanta.headroom == 0)
            value = float(counter.scale().whiteQuanta) * quantum;
        else if (increment != 0)
            value = float(uint32_t(quanta.all + uint64_t(increment))) * quantum;
    });
}

} // namespace

double dazzleGain(double over, const DazzleSettings& settings)
{
    return double(settings.a) + double(settings.b) * expOfMinus(double(settings.c) * over);
}

std::vector<float> dazzleReference(std::span<const float> rgba, int width, int height,
                                   const DazzleSettings& settings, double deltaTime, bool resetHistory,
                                   DazzleHistory& ioHistory)
{
    std::vector<float> out(rgba.begin(), rgba.end());
    if (out.empty())
        return out;
    const DazzleCounter counter(settings.white);
    const double capacity = double(width) * height * counter.scale().whiteQuanta;
    const double perCapacity = 1.0 / capacity;
    DazzleSums sums;
    addDazzleLight(rgba, counter, sums);
    uint32_t unused = 0;
    for (size_t i = 0; i < out.size(); ++i)
        if (i % 4 != 3)
            out[i] = std::bit_cast<float>(counter.sanitized(std::bit_cast<uint32_t>(out[i]), unused));

    const DazzleHistory old = ioHistory;
    for (int channel = 0; channel < 3; ++channel) {
        const DazzleSum& sum = sums.channels[channel];
        const double frame = toDouble(sum.overflow) * perCapacity;
        const double state = adapt(old, channel, frame, settings, deltaTime, resetHistory);
        const uint64_t budget = budgetOf(state, frame, sum, capacity, settings);
        deal(out, width, height, channel, counter, budget, uint64_t(sum.headroom));
        ioHistory.adapted[channel] = state;
        ioHistory.frameMean[channel] = frame;
    }
    ioHistory.replaced = sums.replaced;
    ioHistory.valid = 1;
    return out;
}

} // namespace fx::render
