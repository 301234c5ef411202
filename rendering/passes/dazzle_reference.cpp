#include "rendering/passes/dazzle_reference.h"

#include "shaders/formulas/formula.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace fx::render {

namespace {

__extension__ typedef unsigned __int128 uint128;

constexpr uint32_t kInfinityBits = 0x7F800000u;

/// The light of one channel value.
struct Quanta
{
    uint64_t overflow;
    uint64_t headroom;
    uint64_t all;
};

class Counter
{
public:
    explicit Counter(float white)
        : scale_(dazzleScale(white)), largest_(std::bit_cast<uint32_t>(white * kDazzleLargest)),
          infinity_(std::bit_cast<uint32_t>(std::min(65504.0f, white * kDazzleLargest)))
    {}

    uint32_t sanitized(uint32_t bits, uint32_t& ioReplaced) const
    {
        const uint32_t magnitude = bits & 0x7FFFFFFFu;
        uint32_t result = bits;
        if (magnitude > kInfinityBits || bits > 0x80000000u)
            result = 0;
        else if (magnitude == kInfinityBits)
            result = infinity_;
        else if (magnitude > largest_)
            result = largest_;
        ioReplaced += result != bits ? 1 : 0;
        return result;
    }

    /// Whole quanta of a sanitized value: scaling by a power of two is exact in double.
    Quanta count(uint32_t bits) const
    {
        const double scaled = std::ldexp(double(std::bit_cast<float>(bits)), -scale_.exponent);
        const uint64_t all = uint64_t(scaled);
        const uint64_t white = scale_.whiteQuanta;
        return {all > white ? all - white : 0, all < white ? white - all : 0, all};
    }

    const DazzleScale& scale() const { return scale_; }

private:
    DazzleScale scale_;
    uint32_t largest_;
    uint32_t infinity_;
};

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
double toDouble(uint128 a)
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

uint64_t budgetOf(double state, double frame, uint128 overflow, uint64_t headroom, double capacity,
                  const DazzleSettings& settings)
{
    if (state == frame && settings.a == 1.0f && settings.b == 0.0f)
        return overflow > headroom ? headroom : uint64_t(overflow);
    const float gain = formula::fxSensorGain(float(state), settings.a, settings.b, settings.c);
    const double wanted = std::floor(state * double(gain) * capacity);
    return wanted < toDouble(headroom) ? uint64_t(wanted) : headroom;
}

/// Deals `budget` quanta of one channel to `io` in proportion to headroom.
void deal(std::vector<float>& io, int width, int height, int channel, const Counter& counter, uint64_t budget,
          uint64_t headroom)
{
    const bool saturated = budget == headroom;
    const uint128 numerator = uint128(budget) << 64;
    const uint128 share = saturated ? 0 : (numerator + headroom - 1) / headroom;
    const auto dealtBefore = [&](uint128 c) { return saturated ? c : (c * share) >> 64; };

    uint128 before = 0;
    forEachPixel(width, height, [&](size_t pixel) {
        float& value = io[pixel * 4 + size_t(channel)];
        const Quanta quanta = counter.count(std::bit_cast<uint32_t>(value));
        const uint128 after = before + quanta.headroom;
        const uint128 increment = dealtBefore(after) - dealtBefore(before);
        before = after;
        if (quanta.headroom == 0)
            value = std::ldexp(float(counter.scale().whiteQuanta), counter.scale().exponent);
        else if (increment != 0)
            value = std::ldexp(float(uint32_t(quanta.all + uint64_t(increment))), counter.scale().exponent);
    });
}

} // namespace

std::vector<float> dazzleReference(std::span<const float> rgba, int width, int height,
                                   const DazzleSettings& settings, double deltaTime, bool resetHistory,
                                   DazzleHistory& ioHistory)
{
    std::vector<float> out(rgba.begin(), rgba.end());
    if (out.empty())
        return out;
    const Counter counter(settings.white);
    const double capacity = double(width) * height * counter.scale().whiteQuanta;
    const double perCapacity = 1.0 / capacity;
    const DazzleHistory old = ioHistory;
    ioHistory.replaced = 0;
    ioHistory.valid = 1;

    for (int channel = 0; channel < 3; ++channel) {
        uint128 overflow = 0;
        uint64_t headroom = 0;
        for (size_t i = size_t(channel); i < out.size(); i += 4) {
            const uint32_t bits = counter.sanitized(std::bit_cast<uint32_t>(out[i]), ioHistory.replaced);
            out[i] = std::bit_cast<float>(bits);
            const Quanta quanta = counter.count(bits);
            overflow += quanta.overflow;
            headroom += quanta.headroom;
        }
        const double frame = toDouble(overflow) * perCapacity;
        const double state = adapt(old, channel, frame, settings, deltaTime, resetHistory);
        const uint64_t budget = budgetOf(state, frame, overflow, headroom, capacity, settings);
        deal(out, width, height, channel, counter, budget, headroom);
        ioHistory.adapted[channel] = state;
        ioHistory.frameMean[channel] = frame;
    }
    return out;
}

} // namespace fx::render
