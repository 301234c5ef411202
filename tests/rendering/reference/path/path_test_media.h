/// @file path_test_media.h
/// Media for tests of the path tracer.
#pragma once

#include "rendering/reference/path/blob_path_medium.h"
#include "rendering/reference/path/homogeneous_medium.h"

#include "foundation/random/philox.h"

#include <vector>

namespace fx::render {

/// Overlapping balls of different sizes, within 2 m from the origin.
inline std::vector<MediumBlob> someBlobs(uint32_t count, double crossSection, const glm::dvec3& albedo,
                                         double g = 0.0)
{
    std::vector<MediumBlob> blobs;
    for (uint32_t i = 0; i < count; ++i) {
        const auto a = base::randomUnit4(77, 0, i, base::RandomPurpose::Position);
        MediumBlob blob;
        blob.center = {2.4 * (a[0] - 0.5), 2.4 * (a[1] - 0.5), 2.4 * (a[2] - 0.5)};
        blob.radius = 0.15 + 0.45 * a[3];
        blob.crossSection = crossSection * (0.5 + a[0]);
        blob.albedo = albedo;
        blob.anisotropy = g;
        blobs.push_back(blob);
    }
    return blobs;
}

/// Properties of a grey medium.
inline MediumPoint substance(double extinction, double albedo,
                             const PhaseFunction& phase = PhaseFunction::isotropic())
{
    MediumPoint point;
    point.extinction = glm::dvec3(extinction);
    point.scattering = glm::dvec3(albedo * extinction);
    point.phase = phase;
    return point;
}

} // namespace fx::render
