#include "rendering/reference/path/path_lights.h"

#include "rendering/reference/path/path_phase.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAllDirections = -2.0; ///< a cosine below all

} // namespace

SunLight::SunLight(const glm::dvec3& direction, const glm::dvec3& illuminance, double angularRadius)
    : direction_(direction), illuminance_(illuminance), cosine_(std::cos(angularRadius)),
      scale_(2.0 /
             (1.0 +
              cosine_)) // the disc as a surface sees it that faces its middle: mean cosine (1 + cosine) / 2
{}

LightSample SunLight::sample(const glm::dvec3&, const std::array<double, 2>& u) const
{
    LightSample sample;
    const double cosine = 1.0 - u[0] * (1.0 - cosine_);
    sample.direction = cosine < 1.0 ? PhaseFunction::around(direction_, cosine, u[1]) : direction_;
    sample.illuminance = illuminance_ * scale_;
    return sample;
}

BallPathLight::BallPathLight(const glm::dvec3& center, const glm::dvec3& intensity, double radius)
    : center_(center), luminance_(intensity / (kPi * radius * radius)), radius_(radius)
{}

LightSample BallPathLight::sample(const glm::dvec3& position, const std::array<double, 2>& u) const
{
    LightSample sample;
    const glm::dvec3 toCenter = center_ - position;
    const double distance2 = glm::dot(toCenter, toCenter);
    const double outside2 = distance2 - radius_ * radius_;
    if (outside2 <= 0.0) {
        sample.direction = PhaseFunction::around({0.0, 1.0, 0.0}, 1.0 - 2.0 * u[0], u[1]);
        const double along = glm::dot(toCenter, sample.direction);
        sample.distance = along + std::sqrt(std::max(0.0, along * along - outside2));
        sample.illuminance = luminance_ * (4.0 * kPi);
        return sample;
    }
    const double sine2 = radius_ * radius_ / distance2;
    const double oneLessCosine =
        sine2 / (1.0 + std::sqrt(1.0 - sine2)); // without cancellation for what is far
    sample.direction =
        PhaseFunction::around(toCenter / std::sqrt(distance2), 1.0 - u[0] * oneLessCosine, u[1]);
    const double along = glm::dot(toCenter, sample.direction);
    sample.distance = along - std::sqrt(std::max(0.0, along * along - outside2));
    sample.illuminance = luminance_ * (2.0 * kPi * oneLessCosine);
    return sample;
}

LightSample GlowPathLight::sample(const glm::dvec3& position, const std::array<double, 2>&) const
{
    LightSample sample;
    const glm::dvec3 toCenter = center_ - position;
    const double distance2 = glm::dot(toCenter, toCenter);
    if (!(distance2 > 0.0))
        return sample;
    const double distance = std::sqrt(distance2);
    sample.direction = toCenter / distance;
    sample.distance = std::max(0.0, distance - radius_);
    sample.illuminance = intensity_ / (distance2 + radius_ * radius_);
    return sample;
}

std::unique_ptr<PathLight> makePathLight(const SceneLight& light, const glm::dvec3& eye)
{
    const glm::dvec3 position = light.position - eye;
    const glm::dvec3 intensity(light.intensity);
    if (light.isBall())
        return std::make_unique<BallPathLight>(position, intensity, double(light.radius));
    return std::make_unique<SpotPathLight>(position, glm::normalize(glm::dvec3(light.direction)), intensity,
                                           double(light.innerAngle),
                                           light.isSpot() ? double(light.outerAngle) : kPi);
}

SpotPathLight::SpotPathLight(const glm::dvec3& position, const glm::dvec3& direction,
                             const glm::dvec3& intensity, double inner, double outer)
    : position_(position), direction_(direction), intensity_(intensity),
      cosInner_(outer < kPi ? std::cos(inner) : kAllDirections),
      cosOuter_(outer < kPi ? std::cos(outer) : kAllDirections)
{}

LightSample SpotPathLight::sample(const glm::dvec3& position, const std::array<double, 2>&) const
{
    LightSample sample;
    const glm::dvec3 toLight = position_ - position;
    const double distance2 = glm::dot(toLight, toLight);
    if (!(distance2 > 0.0))
        return sample;
    sample.distance = std::sqrt(distance2);
    sample.direction = toLight / sample.distance;
    const double cosine = -glm::dot(sample.direction, direction_);
    sample.illuminance = intensity_ * (spotFalloff(cosine, cosInner_, cosOuter_) / distance2);
    return sample;
}

} // namespace fx::render
