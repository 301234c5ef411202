/// @file outputs_truth.h
/// Outputs computed from their definitions in docs/howto/outputs.md: integration with small steps, in double
/// precision, through smooth balls.
#pragma once

#include "rendering/frame/view_types.h"

#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

namespace fx::test {

/// A ball of medium with constant velocity.
struct MovingBall
{
    glm::dvec3 center{0.0};   ///< [m] center at the time of the frame
    double radius = 1.0;      ///< [m]
    double depth = 1.0;       ///< [1] optical depth through the center
    glm::dvec3 velocity{0.0}; ///< [m/s]
    uint64_t instance = 1;

    /// [m2] Integral of the extinction over space. If k is the extinction at the center, depth = k 16/15
    /// radius and crossSection() = k 32 pi / 105 radius^3.
    double crossSection() const { return depth * radius * radius * std::numbers::pi * 2.0 / 7.0; }
    double extinction(const glm::dvec3& place) const
    {
        const double s = 1.0 - glm::dot(place - center, place - center) / (radius * radius);
        return s > 0.0 ? depth / (radius * 16.0 / 15.0) * s * s : 0.0;
    }
};

struct TrueOutputs
{
    double first = std::numeric_limits<double>::infinity(); ///< [m]
    double mean = std::numeric_limits<double>::infinity();  ///< [m]
    double opticalDepth = 0.0;
    glm::dvec2 motion{0.0}; ///< [pixel]
    uint64_t instance = 0;
    /// [1] Difference between the opacity of `instance` and the second-largest opacity of an instance.
    double lead = 0.0;
    double opacity = 0.0;
};

inline glm::dvec2 windowOf(const render::CameraView& camera, const glm::dvec3& place, int width, int height)
{
    const glm::dvec4 clip =
        glm::dmat4(camera.projection) * glm::dmat4(camera.view) * glm::dvec4(place - camera.origin, 1.0);
    return {0.5 * width * (1.0 + clip.x / clip.w), 0.5 * height * (1.0 + clip.y / clip.w)};
}

struct PixelRay
{
    glm::dvec3 origin, direction; ///< [m] world; unit

    PixelRay(const render::CameraView& camera, double x, double y, int width, int height)
    {
        const glm::dmat4 back = glm::inverse(glm::dmat4(camera.projection) * glm::dmat4(camera.view));
        const auto place = [&](double z) {
            const glm::dvec4 p = back * glm::dvec4(2.0 * x / width - 1.0, 2.0 * y / height - 1.0, z, 1.0);
            return glm::dvec3(p) / p.w;
        };
        direction = glm::normalize(place(0.9) - place(-0.9));
        const glm::dvec3 eye = glm::dvec3(glm::inverse(glm::dmat4(camera.view))[3]);
        origin = camera.origin + eye;
    }
};

/// Outputs of a pixel whose center is at the window position (x, y). Rows count from the bottom.
/// @param past camera of the previous frame, `seconds` [s] earlier
inline TrueOutputs trueOutputs(const std::vector<MovingBall>& balls, const render::CameraView& camera,
                               const render::CameraView& past, double seconds, double x, double y, int width,
                               int height, double end = 100.0)
{
    constexpr int kSteps = 4000;
    const PixelRay ray(camera, x, y, width, height);
    double from = end, to = 0.0;
    for (const MovingBall& ball : balls) {
        const double middle = glm::dot(ball.center - ray.origin, ray.direction);
        from = std::min(from, middle - ball.radius);
        to = std::max(to, middle + ball.radius);
    }
    from = std::max(from, 0.0);
    to = std::min(to, end);
    TrueOutputs out;
    std::map<uint64_t, double> shares;
    const double step = (to - from) / kSteps;
    double moment = 0.0;
    glm::dvec2 motion(0.0);
    for (int k = 0; k < kSteps && step > 0.0; ++k) {
        const double t = from + (k + 0.5) * step;
        const glm::dvec3 place = ray.origin + t * ray.direction;
        double depth = 0.0;
        for (const MovingBall& ball : balls)
            depth += ball.extinction(place) * step;
        if (!(depth > 0.0))
            continue;
        const double seen = std::exp(-out.opticalDepth) * -std::expm1(-depth);
        for (const MovingBall& ball : balls) {
            const double share = seen * ball.extinction(place) * step / depth;
            if (share > 0.0) {
                shares[ball.instance] += share;
                motion += share *
                          (glm::dvec2(x, y) - windowOf(past, place - seconds * ball.velocity, width, height));
            }
        }
        moment += seen * t;
        out.opacity += seen;
        if (out.opticalDepth < 0.01 && out.opticalDepth + depth >= 0.01)
            out.first = t + step * ((0.01 - out.opticalDepth) / depth - 0.5);
        out.opticalDepth += depth;
    }
    if (out.opacity > 0.0)
        out.mean = moment / out.opacity;
    if (out.opticalDepth < 0.01)
        return out;
    out.motion = motion / out.opacity;
    double second = 0.0, most = 0.0;
    for (const auto& [instance, share] : shares) {
        second = share > most ? most : std::max(second, share);
        out.instance = share > most ? instance : out.instance;
        most = std::max(most, share);
    }
    out.lead = most - second;
    return out;
}

} // namespace fx::test
