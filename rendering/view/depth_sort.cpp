#include "rendering/view/depth_sort.h"

#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace fx::render {

namespace {

/// Unsigned integer whose rising order is the falling order of the float.
uint32_t fallingKey(float distance)
{
    const uint32_t bits = std::bit_cast<uint32_t>(distance);
    const uint32_t rising = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
    return ~rising;
}

} // namespace

std::span<const uint32_t> DepthSort::farthestFirst(std::span<const float> distances)
{
    const size_t count = distances.size();
    keys_.resize(count);
    order_.resize(count);
    scratch_.resize(count);
    for (size_t i = 0; i < count; ++i)
        keys_[i] = fallingKey(distances[i]);
    std::iota(order_.begin(), order_.end(), 0u);

    for (uint32_t shift = 0; shift < 32; shift += 8) {
        std::array<uint32_t, 256> offset{};
        for (size_t i = 0; i < count; ++i)
            ++offset[keys_[i] >> shift & 0xFF];
        uint32_t sum = 0;
        for (uint32_t& o : offset)
            sum = std::exchange(o, sum) + sum;
        for (const uint32_t index : order_)
            scratch_[offset[keys_[index] >> shift & 0xFF]++] = index;
        order_.swap(scratch_);
    }
    return order_;
}

} // namespace fx::render
