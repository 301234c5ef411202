/// @file blob_medium.h
/// Reference medium: a sum of balls with the quartic kernel, in double precision. Tests compare results of
/// GPU passes with this medium.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace fx::render {

/// A range of the ray parameter [m].
struct RaySpan
{
    double begin;
    double end; ///< [m] end of the range; if end <= begin, the ray misses the medium
};

struct Ray
{
    glm::dvec3 origin;    ///< [m]
    glm::dvec3 direction; ///< unit vector
};

/// One ball of medium.
struct Blob
{
    glm::dvec3 center;   ///< [m]
    double radius;       ///< [m] > 0
    double crossSection; ///< [m2] >= 0
    glm::dvec3 source;   ///< [cd/m2] emitted light per optical depth
};

/// A medium that is a sum of blobs. Each blob emits in proportion to its own extinction. Threads: any thread
/// may call const functions.
class BlobMedium
{
public:
    explicit BlobMedium(std::vector<Blob> blobs);

    /// Returns a range of ray parameters that contains all medium on `ray`.
    RaySpan span(const Ray& ray) const;
    double extinctionAt(const glm::dvec3& position) const; ///< [1/m] >= 0
    /// [cd/m2] Emitted light per optical depth at a point.
    glm::dvec3 sourceAt(const glm::dvec3& position) const;
    /// [1] Optical depth between the ray parameters `begin` and `end` [m], >= 0. The result is exact: a sum
    /// of clipped polynomials (formula kernel-optical-depth).
    double opticalDepth(const Ray& ray, double begin, double end) const;

private:
    std::vector<Blob> blobs_;
};

/// [cd/m2] Light that `medium` emits towards the origin of `ray` from the range [begin, end] [m]. The
/// integral is computed by `steps` midpoint steps. The code is a simple, slow and independent reference
/// implementation.
glm::dvec3 marchEmission(const BlobMedium& medium, const Ray& ray, double begin, double end, int steps);

} // namespace fx::render
