/// @file blob_medium.h
/// Reference medium: a sum of balls with the quartic kernel, in double precision. It serves to check results
/// of GPU passes.
#pragma once

#include <glm/vec3.hpp>

#include <vector>

namespace fx::render {

/// A range of the ray parameter [m].
struct RaySpan
{
    double begin;
    double end; ///< [m] end of the range; if it is <= begin, the ray misses
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

    /// Range of ray parameters outside of which there is no medium on `ray`.
    RaySpan span(const Ray& ray) const;
    double extinctionAt(const glm::dvec3& position) const; ///< [1/m] >= 0
    /// [cd/m2] Emitted light per optical depth at a point.
    glm::dvec3 sourceAt(const glm::dvec3& position) const;
    /// [1] >= 0. Optical depth between the ray parameters `begin` and `end` [m]. It is exact: a sum of
    /// clipped polynomials (formula kernel-optical-depth).
    double opticalDepth(const Ray& ray, double begin, double end) const;

private:
    std::vector<Blob> blobs_;
};

/// [cd/m2] Light that `medium` emits towards the origin of `ray` from the range [begin, end], by `steps`
/// midpoint steps. This is a simple, slow and independent reference.
glm::dvec3 marchEmission(const BlobMedium& medium, const Ray& ray, double begin, double end, int steps);

} // namespace fx::render
