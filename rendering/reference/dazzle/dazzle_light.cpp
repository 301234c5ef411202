#include "rendering/reference/dazzle/dazzle_light.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace fx::render {

namespace {

constexpr uint32_t kInfinityBits = 0x7F800000u;

} // namespace

DazzleCounter::DazzleCounter(float white)
    : scale_(dazzleScale(white)), quantaPerUnit_(std::ldexp(1.0, -scale_.exponent)),
      largest_(std::bit_cast<uint32_t>(white * kDazzleLargest)),
      infinity_(std::bit_cast<uint32_t>(std::min(65504.0f, white * kDazzleLargest)))
{}

uint32_t DazzleCounter::sanitized(uint32_t bits, uint32_t& ioReplaced) const
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

DazzleQuanta DazzleCounter::count(uint32_t bits) const
{
    const uint64_t all = uint64_t(double(std::bit_cast<float>(bits)) * quantaPerUnit_);
    const uint64_t white = scale_.whiteQuanta;
    return {all > white ? all - white : 0, all < white ? white - all : 0, all};
}

void addDazzleLight(std::span<const float> rgba, const DazzleCounter& counter, DazzleSums& ioSums)
{
    for (size_t i = 0; i + 3 < rgba.size(); i += 4)
        for (size_t channel = 0; channel < 3; ++channel) {
            const uint32_t bits = std::bit_cast<uint32_t>(rgba[i + channel]);
            const DazzleQuanta quanta = counter.count(counter.sanitized(bits, ioSums.replaced));
            ioSums.channels[channel].overflow += quanta.overflow;
            ioSums.channels[channel].headroom += quanta.headroom;
        }
}

} // namespace fx::render
