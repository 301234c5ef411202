/// @file path_lights.h
/// Lights of the path tracer. Directions towards lights are sampled. The sky is not sampled: rays that escape
/// hit the sky.
#pragma once

#include "rendering/frame/scene_light.h"

#include <glm/vec3.hpp>

#include <array>
#include <limits>
#include <memory>
#include <optional>

namespace fx::render {

/// A sampled direction towards a light.
struct LightSample
{
    glm::dvec3 direction{0.0, 1.0, 0.0}; ///< unit vector towards the light
    /// [m] distance of the light; objects beyond this distance do not block the light
    double distance = std::numeric_limits<double>::infinity();
    /// [lx] luminance divided by the probability density per solid angle. Its expected value is the
    /// illuminance of a surface perpendicular to the light.
    glm::dvec3 illuminance{0.0};
};

/// Position and size of a light in the scene.
struct LightPlace
{
    glm::dvec3 center{0.0}; ///< [m]
    double radius = 0.0;    ///< [m] radius of the light; 0: a point light
};

/// A light that rays do not hit, so that it must be sampled. The lights and the rays use the same
/// coordinates. Threads: any thread may call const functions.
class PathLight
{
public:
    virtual ~PathLight() = default;
    /// Samples a direction to the light.
    /// @param u two random numbers in [0, 1)
    virtual LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const = 0;

    /// Position of the light; nothing for lights at infinity.
    virtual std::optional<LightPlace> place() const { return std::nullopt; }
};

/// A disc of uniform luminance in the sky.
class SunLight final : public PathLight
{
public:
    /// @param direction unit vector towards the center of the disc
    /// @param illuminance [lx] illuminance of a surface perpendicular to `direction`
    /// @param angularRadius [rad] angular radius of the disc, 0..pi/2; 0: parallel light
    SunLight(const glm::dvec3& direction, const glm::dvec3& illuminance, double angularRadius);
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;

private:
    glm::dvec3 direction_, illuminance_;
    double cosine_; ///< cosine of the angular radius
    double scale_;  ///< [1] factor with which the mean of the samples is `illuminance_`
};

/// A ball with a surface of uniform luminance. From inside, the surface is visible in all directions.
class BallPathLight final : public PathLight
{
public:
    /// @param intensity [cd] intensity in every direction
    /// @param radius [m] > 0
    BallPathLight(const glm::dvec3& center, const glm::dvec3& intensity, double radius);
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;
    std::optional<LightPlace> place() const override { return LightPlace{center_, radius_}; }

private:
    glm::dvec3 center_, luminance_;
    double radius_;
};

/// A point light that emits in a cone. Between the inner and the outer angle its intensity decreases
/// smoothly.
class SpotPathLight final : public PathLight
{
public:
    /// @param direction unit vector, direction in which light travels
    /// @param intensity [cd] intensity inside of the inner angle
    /// @param inner, outer [rad] half angles, 0 <= inner <= outer <= pi; both pi: a point light
    SpotPathLight(const glm::dvec3& position, const glm::dvec3& direction, const glm::dvec3& intensity,
                  double inner, double outer);
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;
    std::optional<LightPlace> place() const override { return LightPlace{position_, 0.0}; }

private:
    glm::dvec3 position_, direction_, intensity_;
    double cosInner_, cosOuter_;
};

/// A glowing group of particles. The illuminance is intensity / (distance^2 + radius^2). Objects within the
/// radius do not block the light. The reference renderer and the lights of views use the same model.
class GlowPathLight final : public PathLight
{
public:
    /// @param intensity [cd] intensity in every direction
    /// @param radius [m] extent of the group, > 0
    GlowPathLight(const glm::dvec3& center, const glm::dvec3& intensity, double radius)
        : center_(center), intensity_(intensity), radius_(radius)
    {}
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;
    std::optional<LightPlace> place() const override { return LightPlace{center_, radius_}; }

private:
    glm::dvec3 center_, intensity_;
    double radius_;
};

/// Converts a light of a scene. @param eye [m] world position to which rays are relative
std::unique_ptr<PathLight> makePathLight(const SceneLight& light, const glm::dvec3& eye);

/// Light from all directions at infinite distance.
class PathSky
{
public:
    virtual ~PathSky() = default;
    /// [cd/m2] Luminance in the direction of a ray that escapes.
    /// @param direction unit vector
    virtual glm::dvec3 luminance(const glm::dvec3& direction) const = 0;
};

} // namespace fx::render
