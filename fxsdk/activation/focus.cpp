#include "fxsdk/activation/focus.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace fx::activation {

namespace {
constexpr double kGrace = 1.1; ///< of the radius of what is in sight
}

Frustum::Frustum(const glm::dvec3& origin, const glm::mat4& view, const glm::mat4& projection,
                 const Limits& limits)
    : limits_(limits)
{
    const glm::dmat4 toClip = glm::dmat4(projection) * glm::dmat4(view);
    const glm::dvec4 w = glm::row(toClip, 3);
    const glm::dvec4 left = w + glm::row(toClip, 0);
    orthographic_ = std::abs(projection[3][3]) > std::abs(projection[2][3]);
    const glm::dvec4 behind = orthographic_ ? left : w; // nothing is behind an orthographic camera
    const glm::dvec4 sides[5] = {left, w - glm::row(toClip, 0), w + glm::row(toClip, 1),
                                 w - glm::row(toClip, 1), behind};
    for (size_t i = 0; i < planes_.size(); ++i) {
        const glm::dvec3 normal = glm::dvec3(sides[i]) / glm::length(glm::dvec3(sides[i]));
        const double offset = sides[i].w / glm::length(glm::dvec3(sides[i]));
        planes_[i] = {normal, offset - glm::dot(normal, origin)};
    }
    eye_ = origin + glm::dvec3(glm::inverse(glm::dmat4(view))[3]);
    pixelsPerMeter_ = std::abs(double(projection[1][1])) * limits.height * 0.5;
}

double Frustum::pixels(const Ball& ball) const
{
    const double distance = std::max(glm::length(ball.center - eye_) - ball.radius, 0.0);
    const double size = ball.radius * pixelsPerMeter_ / (orthographic_ ? 1.0 : std::max(distance, 1e-9));
    return size < limits_.height ? size : limits_.height; // infinite and not a number: all of it
}

Sight Frustum::judge(const Ball& ball, double sight) const
{
    if (!(ball.radius < std::numeric_limits<double>::infinity()))
        return Sight::Seen;
    for (const glm::dvec4& plane : planes_)
        if (glm::dot(glm::dvec3(plane), ball.center) + plane.w < -(ball.radius + limits_.margin))
            return Sight::Outside;
    const double distance = glm::length(ball.center - eye_) - ball.radius;
    if (distance > std::min(sight, limits_.maxDistance))
        return Sight::TooFar;
    return pixels(ball) < limits_.minPixels ? Sight::TooSmall : Sight::Seen;
}

Sight Frustum::judgeWithHysteresis(const Ball& ball, double sight) const
{
    return judge({ball.center, ball.radius * kGrace}, sight * kGrace);
}

Sight FocusSet::judge(const Ball& ball, double sight, bool isSeen) const
{
    if (frusta_.empty())
        return Sight::Seen;
    Sight best = Sight::Outside;
    for (const Frustum& frustum : frusta_) {
        const Sight here = isSeen ? frustum.judgeWithHysteresis(ball, sight) : frustum.judge(ball, sight);
        if (here == Sight::Seen)
            return here;
        best = std::max(best, here);
    }
    return best;
}

double FocusSet::pixels(const Ball& ball) const
{
    double most = frusta_.empty() ? 1.0 : 0.0;
    for (const Frustum& frustum : frusta_)
        most = std::max(most, frustum.pixels(ball));
    return most;
}

} // namespace fx::activation
