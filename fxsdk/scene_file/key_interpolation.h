/// @file key_interpolation.h
/// Smooth interpolation between keys, for the motion of cameras and instances.
#pragma once

#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace fx::scene_file {

/// Derivative with respect to time at key `i`, for both adjacent segments; 0 at the first and the last key.
template <class Key>
glm::dvec3 tangentAt(const std::vector<Key>& keys, size_t i, glm::dvec3 Key::*member)
{
    if (i == 0 || i + 1 == keys.size())
        return glm::dvec3(0.0);
    return (keys[i + 1].*member - keys[i - 1].*member) / (keys[i + 1].time - keys[i - 1].time);
}

/// Cubic Hermite interpolation with Catmull-Rom tangents for nonuniform times. The result is constant before
/// the first key and after the last key.
///
/// symbol        meaning
///   p1, p2      values at the ends of the segment, at times t1 < t2
///   p0, p3      values of the neighbors, at times t0 < t1 and t3 > t2; absent at the ends of the path
///   s           (t - t1) / (t2 - t1), in [0, 1]
/// Tangents: m1 = (p2 - p0) / (t2 - t0), m2 = (p3 - p1) / (t3 - t1). So the first derivative is continuous.
/// At the ends of the path, tangents are 0, so that motion starts and stops gently.
/// @param keys at least one key, with increasing `time`
template <class Key>
glm::dvec3 smoothAt(const std::vector<Key>& keys, double time, glm::dvec3 Key::*member)
{
    if (!(time > keys.front().time))
        return keys.front().*member;
    if (time >= keys.back().time)
        return keys.back().*member;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double t, const Key& key) { return t < key.time; });
    const size_t i = size_t(after - keys.begin()) - 1;
    const double length = keys[i + 1].time - keys[i].time;
    const double s = (time - keys[i].time) / length;
    const double s2 = s * s;
    const double s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * (keys[i].*member) +
           (s3 - 2 * s2 + s) * length * tangentAt(keys, i, member) +
           (3 * s2 - 2 * s3) * (keys[i + 1].*member) + (s3 - s2) * length * tangentAt(keys, i + 1, member);
}

} // namespace fx::scene_file
