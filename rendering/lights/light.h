/// @file light.h
/// What every light can be asked: which light arrives at a point, from where, and how it is shadowed by
/// media.
#pragma once

#include <glm/vec3.hpp>

#include <limits>

namespace fx::render {

/// Light arriving at a point, before anything blocks it.
struct Incidence
{
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; ///< unit, towards the light
    glm::vec3 illuminance{0.0f};           ///< [lx] on a surface that faces the light
    float distance =
        std::numeric_limits<float>::infinity(); ///< [m] to the light: beyond it nothing casts a shadow
};

/// How much of a light gets through media to a point; filled by an extinction grid, light slices, ...
class MediaShadow
{
public:
    virtual ~MediaShadow() = default;
    /// Transmittance [0, 1] from `position` towards `direction`, up to `distance` [m].
    virtual float transmittance(const glm::vec3& position, const glm::vec3& direction,
                                float distance) const = 0;
};

/// A source of light. Positions are relative to the view's eye.
class Light
{
public:
    virtual ~Light() = default;
    virtual Incidence at(const glm::vec3& position) const = 0;
};

/// The sun: parallel light.
class DirectionalLight final : public Light
{
public:
    /// @param direction unit, towards the light  @param illuminance [lx]
    DirectionalLight(const glm::vec3& direction, const glm::vec3& illuminance)
        : incidence_{direction, illuminance, std::numeric_limits<float>::infinity()}
    {}
    Incidence at(const glm::vec3&) const override { return incidence_; }

private:
    Incidence incidence_;
};

/// A glowing ball: intensity over distance squared, finite inside the ball.
class BallLight final : public Light
{
public:
    /// @param intensity [cd]  @param radius [m] > 0
    BallLight(const glm::vec3& center, const glm::vec3& intensity, float radius)
        : center_(center), intensity_(intensity), radius_(radius)
    {}
    Incidence at(const glm::vec3& position) const override;

private:
    glm::vec3 center_;
    glm::vec3 intensity_;
    float radius_;
};

} // namespace fx::render
