/// @file medium.h
/// What every participating medium can be asked, whatever it is made of: blobs, blocks, grids, fog.
#pragma once

#include "foundation/math/geometry.h"

#include <glm/vec3.hpp>

namespace fx::render {

/// Part of a ray, in its own parameter [m].
struct RaySpan
{
    double begin;
    double end; ///< <= begin: the ray misses
};

struct Ray
{
    glm::dvec3 origin;    ///< [m]
    glm::dvec3 direction; ///< unit
};

/// Extinction, source and extent of a medium. Const calls from any thread.
class Medium
{
public:
    virtual ~Medium() = default;

    virtual base::Bounds bounds() const = 0;
    /// Where along `ray` the medium can be; nothing of it lies outside.
    virtual RaySpan span(const Ray& ray) const = 0;
    virtual double extinctionAt(const glm::dvec3& position) const = 0; ///< [1/m] >= 0
    virtual glm::dvec3
    sourceAt(const glm::dvec3& position) const = 0; ///< [cd/m2] emitted light per optical depth
    virtual double opticalDepth(const Ray& ray, double begin, double end) const = 0; ///< [1] >= 0
};

} // namespace fx::render
