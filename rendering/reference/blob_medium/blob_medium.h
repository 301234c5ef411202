/// @file blob_medium.h
/// Reference medium: a sum of balls with the quartic kernel, in double precision. GPU passes are compared
/// with it.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

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

/// One ball of medium.
struct Blob
{
    glm::dvec3 center;   ///< [m]
    double radius;       ///< [m] > 0
    double crossSection; ///< [m2] >= 0
    glm::dvec3 source;   ///< [cd/m2] emitted light per optical depth
};

/// Sum of blobs; each emits by its own extinction. Const calls from any thread.
class BlobMedium
{
public:
    explicit BlobMedium(std::vector<Blob> blobs);

    /// Interval of `ray` outside of which there is no medium.
    RaySpan span(const Ray& ray) const;
    double extinctionAt(const glm::dvec3& position) const; ///< [1/m] >= 0
    glm::dvec3 sourceAt(const glm::dvec3& position) const; ///< [cd/m2] emitted light per optical depth
    /// [1] >= 0. Exact: the sum of the blobs' clipped polynomials (formula kernel-optical-depth).
    double opticalDepth(const Ray& ray, double begin, double end) const;

private:
    std::vector<Blob> blobs_;
};

/// Light that `medium` sends along `ray` from [begin, end] by composite midpoint steps in optical depth
/// order: the plain, slow and independent answer. [cd/m2]
glm::dvec3 marchEmission(const BlobMedium& medium, const Ray& ray, double begin, double end, int steps);

} // namespace fx::render
