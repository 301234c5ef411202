/// @file orbit_camera.h
/// A camera that people move with mouse and keys: orbit, pan, zoom, fly.
#pragma once

#include <glm/vec3.hpp>

namespace fx::editor {

class OrbitCamera
{
public:
    /// Looks from `position` to `target` [m], which differ.
    void look(const glm::dvec3& position, const glm::dvec3& target);

    /// Turns around the target. @param yaw, pitch [rad]; the pitch is limited to 89 degrees from level
    void orbit(double yaw, double pitch);
    /// Moves eye and target in the plane of the picture, in units of the distance between them.
    void pan(double right, double up);
    /// Multiplies the distance to the target. @param factor > 0
    void zoom(double factor);
    /// Moves eye and target along the axes of the camera [m].
    void fly(const glm::dvec3& rightUpForward);

    glm::dvec3 position() const; ///< [m]
    const glm::dvec3& target() const { return target_; }
    double distance() const { return distance_; } ///< [m]
    float fovYDegrees = 50.0f;                    ///< [degree]

private:
    glm::dvec3 forward() const;
    glm::dvec3 right() const;

    glm::dvec3 target_{0.0, 1.0, 0.0};
    double distance_ = 10.0;
    double yaw_ = 0.0;   ///< [rad] 0: the eye is on the side of +z
    double pitch_ = 0.2; ///< [rad] above 0: the eye is above the target
};

} // namespace fx::editor
