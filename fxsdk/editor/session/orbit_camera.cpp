#include "fxsdk/editor/session/orbit_camera.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::editor {

namespace {

constexpr double kSteepest = 89.0 * 3.14159265358979 / 180.0; // [rad]
constexpr double kNearest = 0.01;                             // [m]
constexpr double kFarthest = 1e5;                             // [m]

} // namespace

void OrbitCamera::look(const glm::dvec3& position, const glm::dvec3& target)
{
    const glm::dvec3 away = position - target;
    target_ = target;
    distance_ = std::clamp(glm::length(away), kNearest, kFarthest);
    yaw_ = std::atan2(away.x, away.z);
    pitch_ = std::clamp(std::asin(std::clamp(away.y / distance_, -1.0, 1.0)), -kSteepest, kSteepest);
}

void OrbitCamera::orbit(double yaw, double pitch)
{
    yaw_ += yaw;
    pitch_ = std::clamp(pitch_ + pitch, -kSteepest, kSteepest);
}

void OrbitCamera::pan(double right, double up)
{
    const glm::dvec3 upward = glm::cross(this->right(), forward());
    target_ += distance_ * (right * this->right() + up * upward);
}

void OrbitCamera::zoom(double factor)
{
    distance_ = std::clamp(distance_ * factor, kNearest, kFarthest);
}

void OrbitCamera::fly(const glm::dvec3& rightUpForward)
{
    target_ += rightUpForward.x * right() + rightUpForward.y * glm::dvec3(0.0, 1.0, 0.0) +
               rightUpForward.z * forward();
}

glm::dvec3 OrbitCamera::position() const
{
    return target_ - distance_ * forward();
}

glm::dvec3 OrbitCamera::forward() const
{
    return -glm::dvec3(std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_),
                       std::cos(yaw_) * std::cos(pitch_));
}

glm::dvec3 OrbitCamera::right() const
{
    return {std::cos(yaw_), 0.0, -std::sin(yaw_)};
}

} // namespace fx::editor
