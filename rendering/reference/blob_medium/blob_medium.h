/// @file blob_medium.h
/// The gas as a medium: a sum of balls with the quartic kernel, in double precision. What the GPU passes are
/// measured against.
#pragma once

#include "rendering/reference/blob_medium/medium.h"

#include <vector>

namespace fx::render {

/// One ball of medium.
struct Blob
{
    glm::dvec3 center;   ///< [m]
    double radius;       ///< [m] > 0
    double crossSection; ///< [m2] >= 0
    glm::dvec3 source;   ///< [cd/m2] emitted light per optical depth
};

/// Sum of blobs; each emits by its own extinction.
class BlobMedium final : public Medium
{
public:
    explicit BlobMedium(std::vector<Blob> blobs);

    base::Bounds bounds() const override { return bounds_; }
    RaySpan span(const Ray& ray) const override;
    double extinctionAt(const glm::dvec3& position) const override;
    glm::dvec3 sourceAt(const glm::dvec3& position) const override;
    /// Exact: the sum of the blobs' clipped polynomials (formula kernel-optical-depth).
    double opticalDepth(const Ray& ray, double begin, double end) const override;

private:
    std::vector<Blob> blobs_;
    base::Bounds bounds_;
};

/// Light that `medium` sends along `ray` from [begin, end] by composite midpoint steps in optical depth
/// order: the plain, slow and independent answer. [cd/m2]
glm::dvec3 marchEmission(const Medium& medium, const Ray& ray, double begin, double end, int steps);

} // namespace fx::render
