/// @file focus.h
/// View frusta of the host's cameras, and visibility tests of bounding spheres.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::activation {

/// Bounding sphere of an instance.
struct Ball
{
    glm::dvec3 center{0.0}; ///< [m] world
    double radius = 0;      ///< [m] infinite when unknown
};

/// Whether an instance is in sight, or the reason why it is not in sight.
enum class Sight : uint8_t
{
    Seen,
    Outside,  ///< outside of every frustum
    TooFar,   ///< farther away than the maximum distance of the instance or of the camera
    TooSmall, ///< smaller than Limits::minPixels
};

/// One camera, in world coordinates.
class Frustum
{
public:
    struct Limits
    {
        double maxDistance = std::numeric_limits<double>::infinity(); ///< [m] largest distance from the eye
        double margin = 0;    ///< [m] distance by which the frustum is widened
        double minPixels = 0; ///< [pixel] smallest radius on the picture of a visible instance
        double height = 1080; ///< [pixel] height of the picture
    };
    /// Creates the frustum of a camera with a projection that is not degenerate.
    /// @param origin [m] world position that the matrices are relative to
    Frustum(const glm::dvec3& origin, const glm::mat4& view, const glm::mat4& projection,
            const Limits& limits);

    /// Tests whether a ball is in sight.
    /// @param sight [m] largest distance at which the ball is seen
    Sight judge(const Ball& ball, double sight) const;
    /// Tests whether a ball that was in sight is still in sight. The radius and `sight` are enlarged by a
    /// tenth (hysteresis), which avoids flickering at the boundary of the frustum.
    Sight judgeWithHysteresis(const Ball& ball, double sight) const;
    /// [pixel] radius of the ball on the picture, at most its height.
    double pixels(const Ball& ball) const;

private:
    /// planes: left, right, bottom, top, behind; the distance of a point p from a plane is dot(xyz, p) + w
    std::array<glm::dvec4, 5> planes_;
    glm::dvec3 eye_;
    /// [pixel/m] scale of the picture; perspective: at a distance of 1 m; orthographic: at any distance
    double pixelsPerMeter_;
    bool orthographic_;
    Limits limits_;
};

/// The frusta of all cameras. Without cameras every instance is in sight.
class FocusSet
{
public:
    explicit FocusSet(std::pmr::memory_resource* memory) : frusta_(memory) {}

    void reserve(size_t count) { frusta_.reserve(count); }
    void clear() { frusta_.clear(); }
    void add(const Frustum& frustum) { frusta_.push_back(frustum); }
    bool everything() const { return frusta_.empty(); }

    /// Tests whether a ball is in sight of any camera. Returns Seen if a camera sees the ball. Otherwise
    /// returns the largest value of Sight over all cameras.
    /// @param isSeen whether the ball was in sight before
    Sight judge(const Ball& ball, double sight, bool isSeen) const;
    /// [pixel] Largest radius of the ball on the picture of any camera; 1 without cameras.
    double pixels(const Ball& ball) const;

private:
    std::pmr::vector<Frustum> frusta_;
};

} // namespace fx::activation
