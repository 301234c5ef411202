/// @file dazzle_pictures.h
/// Common code of the cases about glare: pictures of one channel, the glare, and a naive implementation.
#pragma once

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "rendering/reference/dazzle/dazzle_reference.h"

#include <vector>

namespace fx::cli {

inline constexpr double kQuanta = 16777216.0; ///< number of quanta of the value white

/// A picture of one channel; 5 % of the pixels are above white.
inline std::vector<float> randomPicture(size_t pixels, uint64_t seed)
{
    SweepRandom random(seed);
    std::vector<float> values(pixels);
    for (float& v : values)
        v = random.next() < 0.05 ? float(random.between(1.0, 4.0)) : float(random.between(0.0, 0.9));
    return values;
}

inline std::vector<float> dazzled(const std::vector<float>& values, int width,
                                  uint32_t* outReplaced = nullptr)
{
    std::vector<float> rgba;
    for (const float v : values)
        rgba.insert(rgba.end(), {v, v, v, 1.0f});
    render::DazzleHistory history{};
    const std::vector<float> out =
        render::dazzleReference(rgba, width, width > 0 ? int(values.size()) / width : 0,
                                {.white = 1.0f, .a = 1.0f}, 0.0, true, history);
    if (outReplaced)
        *outReplaced = history.replaced;
    std::vector<float> red;
    for (size_t i = 0; i < out.size(); i += 4)
        red.push_back(out[i]);
    return red;
}

/// Naive implementation: sums in T. The overflow fills the same fraction of the range up to white in every
/// pixel. Values are not checked.
template <class T>
std::vector<T> plain(const std::vector<float>& values)
{
    T over = 0, room = 0;
    for (const float v : values) {
        over += T(v) > T(1) ? T(v) - T(1) : T(0);
        room += T(v) > T(1) ? T(0) : T(1) - T(v);
    }
    std::vector<T> out;
    for (const float v : values)
        out.push_back(T(v) > T(1) ? T(1) : T(v) + (T(1) - T(v)) * (over / room));
    return out;
}

} // namespace fx::cli
