/// @file view_projection.h
/// Where places of the world are in the picture, and which ray belongs to a place of the picture.
#pragma once

#include "fxsdk/editor/session/orbit_camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <utility>

namespace fx::editor {

class ViewProjection
{
public:
    /// @param low, size [pixel] rectangle of the picture; y points down
    ViewProjection(const OrbitCamera& camera, const glm::dvec2& low, const glm::dvec2& size);

    /// Place [pixel] of a position [m]; nothing if it is not in front of the camera.
    std::optional<glm::dvec2> project(const glm::dvec3& position) const;
    /// Both ends of the part of a line [m] that is in front of the camera.
    std::optional<std::pair<glm::dvec2, glm::dvec2>> project(const glm::dvec3& a, const glm::dvec3& b) const;
    /// Unit vector from the eye through a place [pixel].
    glm::dvec3 rayThrough(const glm::dvec2& place) const;
    /// Where the ray through a place meets the plane through `position` that is parallel to the picture.
    glm::dvec3 inPlaneOf(const glm::dvec3& position, const glm::dvec2& place) const;
    /// Point of the line `from + s * along` that is nearest to the ray through a place. @return s; nothing
    /// where the line is seen end on
    std::optional<double> alongLine(const glm::dvec3& from, const glm::dvec3& along,
                                    const glm::dvec2& place) const;
    /// [pixel/m] at a position in front of the camera.
    double scaleAt(const glm::dvec3& position) const;

    const glm::dvec3& eye() const { return eye_; }
    const glm::dvec3& right() const { return right_; }
    const glm::dvec3& up() const { return up_; }
    const glm::dvec3& forward() const { return forward_; }

private:
    glm::dvec3 eye_, right_, up_, forward_;
    glm::dvec2 middle_; ///< [pixel]
    double focal_;      ///< [pixel]
};

} // namespace fx::editor
