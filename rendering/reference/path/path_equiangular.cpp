#include "rendering/reference/path/path_equiangular.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::render {

Equiangular::Equiangular(const TraceRay& ray, const std::pair<double, double>& part, const LightPlace& light)
    : begin_(part.first), end_(part.second)
{
    const glm::dvec3 toLight = light.center - ray.origin;
    const double length = end_ - begin_;
    nearest_ = glm::dot(toLight, ray.direction);
    const double distance = glm::length(toLight - nearest_ * ray.direction);
    across_ = std::max({distance, light.radius, 1e-6 * length});
    from_ = std::atan((begin_ - nearest_) / across_); // (1)
    turn_ = std::atan((end_ - nearest_) / across_) - from_;
    isNear_ = std::hypot(distance, nearest_ - std::clamp(nearest_, begin_, end_)) < length && turn_ > 0.0;
}

double Equiangular::parameter(double u) const
{
    return std::clamp(nearest_ + across_ * std::tan(from_ + u * turn_), begin_, end_); // (2)
}

double Equiangular::density(double parameter) const
{
    const double along = parameter - nearest_;
    return across_ / (turn_ * (across_ * across_ + along * along)); // (3)
}

} // namespace fx::render
