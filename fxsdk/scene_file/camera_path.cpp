#include "fxsdk/scene_file/camera_path.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace fx::scene_file {

namespace {

/// Cubic Hermite with Catmull-Rom tangents for uneven times.
///
/// symbol        meaning
///   p1, p2      values at the ends of the segment, at times t1 < t2
///   p0, p3      values of the neighbors, at times t0 <= t1 and t3 >= t2; equal times mean "none": the end
///   rests s           (t - t1) / (t2 - t1), in [0, 1]
/// tangents: m1 = (p2 - p0) / (t2 - t0), m2 = (p3 - p1) / (t3 - t1), the same on both sides of a key, so the
/// first derivative is continuous; 0 at the ends of the path, so that the camera starts and stops gently.
glm::dvec3 hermite(const glm::dvec3& p1, const glm::dvec3& p2, const glm::dvec3& m1, const glm::dvec3& m2,
                   double length, double s)
{
    const double s2 = s * s;
    const double s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * p1 + (s3 - 2 * s2 + s) * length * m1 + (3 * s2 - 2 * s3) * p2 +
           (s3 - s2) * length * m2;
}

using Member = glm::dvec3 CameraKey::*;

glm::dvec3 tangent(const std::vector<CameraKey>& keys, size_t i, Member member)
{
    if (i == 0 || i + 1 == keys.size())
        return glm::dvec3(0.0);
    return (keys[i + 1].*member - keys[i - 1].*member) / (keys[i + 1].time - keys[i - 1].time);
}

glm::dvec3 interpolate(const std::vector<CameraKey>& keys, size_t i, double time, Member member)
{
    const double length = keys[i + 1].time - keys[i].time;
    return hermite(keys[i].*member, keys[i + 1].*member, tangent(keys, i, member),
                   tangent(keys, i + 1, member), length, (time - keys[i].time) / length);
}

} // namespace

CameraPose CameraPath::at(double time) const
{
    if (keys.empty())
        return {position, target};
    if (!(time > keys.front().time))
        return {keys.front().position, keys.front().target};
    if (time >= keys.back().time)
        return {keys.back().position, keys.back().target};
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double t, const CameraKey& key) { return t < key.time; });
    const size_t i = size_t(after - keys.begin()) - 1;
    return {interpolate(keys, i, time, &CameraKey::position), interpolate(keys, i, time, &CameraKey::target)};
}

glm::mat4 CameraPath::viewRotation(double time) const
{
    const CameraPose pose = at(time);
    const glm::vec3 forward(glm::normalize(pose.target - pose.position));
    return glm::lookAt(glm::vec3(0.0f), forward, up);
}

glm::mat4 CameraPath::projection(float aspect) const
{
    constexpr float kOrthographicFar = 10'000.0f;
    if (orthographicHeight > 0) {
        const float halfHeight = 0.5f * orthographicHeight;
        return glm::ortho(-aspect * halfHeight, aspect * halfHeight, -halfHeight, halfHeight, nearPlane,
                          kOrthographicFar);
    }
    return glm::infinitePerspective(glm::radians(fovYDegrees), aspect, nearPlane);
}

} // namespace fx::scene_file
