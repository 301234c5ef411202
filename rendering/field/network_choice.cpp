#include "rendering/field/network_choice.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kBallVariance =
    1.0 / 9.0; ///< [1] of the quartic kernel along an axis, over the radius squared
constexpr double kEllipsoidVariance = 0.2; ///< likewise, of an even ellipsoid over a semi-axis squared

double diameterIn(const MediumMoments& medium, double pixel)
{
    const glm::dvec3 axes = medium.semiAxes();
    return 2.0 * std::max({axes.x, axes.y, axes.z}) / std::max(pixel, 1e-30);
}

} // namespace

void MediumMoments::add(const glm::dvec3& center, double radius, double crossSection,
                        const glm::dvec3& albedo)
{
    crossSection_ += crossSection;
    first_ += crossSection * center;
    second_ += crossSection * (center * center + kBallVariance * radius * radius);
    albedo_ += crossSection * albedo;
}

void MediumMoments::add(const MediumMoments& other)
{
    crossSection_ += other.crossSection_;
    first_ += other.first_;
    second_ += other.second_;
    albedo_ += other.albedo_;
}

glm::dvec3 MediumMoments::semiAxes() const
{
    if (isEmpty())
        return glm::dvec3(0.0);
    const glm::dvec3 mean = center();
    const glm::dvec3 variance = glm::max(second_ / crossSection_ - mean * mean, glm::dvec3(0.0));
    return glm::sqrt(variance / kEllipsoidVariance);
}

double MediumMoments::opticalDepth() const
{
    const glm::dvec3 a = semiAxes();
    const double area = std::numbers::pi * (a.x * a.y + a.y * a.z + a.z * a.x) / 3.0;
    return area > 0.0 ? crossSection_ / area : 0.0;
}

double MediumMoments::albedo() const
{
    return isEmpty() ? 0.0 : std::max({albedo_.x, albedo_.y, albedo_.z}) / crossSection_;
}

NetworkUse networkUse(const MediumMoments& medium, double pixel, bool had)
{
    const double share = had ? kKeptNetworkShare : 1.0;
    if (medium.opticalDepth() < share * kLeastNetworkDepth)
        return NetworkUse::Thin;
    if (medium.albedo() < share * kLeastNetworkAlbedo)
        return NetworkUse::Dark;
    return diameterIn(medium, pixel) < share * kLeastNetworkPixels ? NetworkUse::Small : NetworkUse::Network;
}

std::string textOf(NetworkUse use, const MediumMoments& medium, double pixel)
{
    char text[96];
    switch (use) {
    case NetworkUse::Thin:
        std::snprintf(text, sizeof text, "optical depth %.2g is below %g", medium.opticalDepth(),
                      kLeastNetworkDepth);
        break;
    case NetworkUse::Dark:
        std::snprintf(text, sizeof text, "albedo %.2g is below %g", medium.albedo(), kLeastNetworkAlbedo);
        break;
    case NetworkUse::Small:
        std::snprintf(text, sizeof text, "%.0f pixels across are fewer than %g", diameterIn(medium, pixel),
                      kLeastNetworkPixels);
        break;
    case NetworkUse::Network:
        std::snprintf(text, sizeof text, "optical depth %.2g, albedo %.2g, %.0f pixels across",
                      medium.opticalDepth(), medium.albedo(), diameterIn(medium, pixel));
        break;
    }
    return text;
}

} // namespace fx::render
