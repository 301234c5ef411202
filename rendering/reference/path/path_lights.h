/// @file path_lights.h
/// Lights of the path tracer: directions are drawn towards them; the sky is met by rays that escape.
#pragma once

#include "rendering/frame/scene_light.h"

#include <glm/vec3.hpp>

#include <array>
#include <limits>
#include <memory>
#include <optional>

namespace fx::render {

/// A direction in which a light was looked for.
struct LightSample
{
    glm::dvec3 direction{0.0, 1.0, 0.0};                       ///< unit, towards the light
    double distance = std::numeric_limits<double>::infinity(); ///< [m] beyond it nothing blocks
    /// [lx] luminance over the probability per solid angle: its mean is the illuminance of a surface that
    /// faces the light
    glm::dvec3 illuminance{0.0};
};

/// Where a light is that shines from within the scene.
struct LightPlace
{
    glm::dvec3 center{0.0}; ///< [m]
    double radius = 0.0;    ///< [m] 0: a point
};

/// A source of light that rays do not see. Coordinates are those of the rays. Const calls from any thread.
class PathLight
{
public:
    virtual ~PathLight() = default;
    /// @param u two numbers in [0, 1)
    virtual LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const = 0;

    /// Null for lights that are far away.
    virtual std::optional<LightPlace> place() const { return std::nullopt; }
};

/// A disc in the sky, of equal luminance.
class SunLight final : public PathLight
{
public:
    /// @param direction unit, towards its middle  @param illuminance [lx] on a surface that faces it
    /// @param angularRadius [rad] 0..pi/2; 0: parallel light
    SunLight(const glm::dvec3& direction, const glm::dvec3& illuminance, double angularRadius);
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;

private:
    glm::dvec3 direction_, illuminance_;
    double cosine_; ///< of the angular radius
    double scale_;  ///< [1] so that the mean over the disc gives `illuminance_`
};

/// A ball whose surface has the same luminance everywhere. Inside, its shell is seen in all directions.
class BallPathLight final : public PathLight
{
public:
    /// @param intensity [cd] in every direction  @param radius [m] > 0
    BallPathLight(const glm::dvec3& center, const glm::dvec3& intensity, double radius);
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;
    std::optional<LightPlace> place() const override { return LightPlace{center_, radius_}; }

private:
    glm::dvec3 center_, luminance_;
    double radius_;
};

/// A point that shines within a cone. Between the two angles light falls off smoothly.
class SpotPathLight final : public PathLight
{
public:
    /// @param direction unit, the way the light goes  @param intensity [cd] inside the inner angle
    /// @param inner, outer [rad] half angles, 0 <= inner <= outer <= pi; both pi: a point light
    SpotPathLight(const glm::dvec3& position, const glm::dvec3& direction, const glm::dvec3& intensity,
                  double inner, double outer);
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;
    std::optional<LightPlace> place() const override { return LightPlace{position_, 0.0}; }

private:
    glm::dvec3 position_, direction_, intensity_;
    double cosInner_, cosOuter_;
};

/// A glowing group of particles: as bright as a point, but finite inside its extent, where nothing blocks it.
/// The same model as in the reference renderer and in rendering/lights/light.h.
class GlowPathLight final : public PathLight
{
public:
    /// @param intensity [cd] in every direction  @param radius [m] extent, > 0
    GlowPathLight(const glm::dvec3& center, const glm::dvec3& intensity, double radius)
        : center_(center), intensity_(intensity), radius_(radius)
    {}
    LightSample sample(const glm::dvec3& position, const std::array<double, 2>& u) const override;
    std::optional<LightPlace> place() const override { return LightPlace{center_, radius_}; }

private:
    glm::dvec3 center_, intensity_;
    double radius_;
};

/// A light of a scene. @param eye [m] world position that rays are relative to
std::unique_ptr<PathLight> makePathLight(const SceneLight& light, const glm::dvec3& eye);

/// Light from everywhere that is far away.
class PathSky
{
public:
    virtual ~PathSky() = default;
    /// [cd/m2] @param direction unit, of a ray that escapes
    virtual glm::dvec3 luminance(const glm::dvec3& direction) const = 0;
};

} // namespace fx::render
