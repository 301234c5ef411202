/// @file shadow_ray.h
/// Computes the attenuation of light by the medium and the triangles of a scene, between a light and a point.
#pragma once

#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/render/opaque_view.h"
#include "rendering/reference/trace/ray_query.h"

#include <cmath>

namespace fx::render {

/// Computes the attenuation along shadow rays. Each thread needs its own object, because rays share scratch
/// memory.
class ShadowRay
{
public:
    /// @param medium, opaque objects that must outlive this one
    ShadowRay(const MediumView& medium, const OpaqueView& opaque)
        : medium_(medium), opaque_(opaque), detailed_(medium, DetailedRay::Wanted::Depth, kDetailTolerance)
    {}

    /// Transmittance of the medium between the ray's origin and `distance` [m], without surfaces.
    double transmittance(const TraceRay& ray, double distance)
    {
        if (medium_.isEmpty())
            return 1.0;
        findHits(medium_.tree(), ray, 0.0, distance, hits_);
        if (!medium_.details().isGiven())
            return std::exp(-opticalDepthOf(medium_, hits_, 0.0, distance));
        detailed_.trace(ray, hits_, 0.0, distance);
        return std::exp(-detailed_.opticalDepth());
    }
    /// Transmittance of medium and surfaces between the ray's origin and `distance` [m]; 0 if a triangle
    /// blocks the ray.
    double visibility(const TraceRay& ray, double distance)
    {
        return opaque_.blocks(ray, distance, hits_) ? 0.0 : transmittance(ray, distance);
    }
    /// [m] Distance to the first triangle, +infinity if there is none.
    double toSurface(const TraceRay& ray) { return opaque_.distance(ray, hits_); }

private:
    /// Tolerance for media with detail. A large value suffices, because each result is a mean over many
    /// shadow rays.
    static constexpr double kDetailTolerance = 0.01;

    const MediumView& medium_;
    const OpaqueView& opaque_;
    DetailedRay detailed_;
    RayHits hits_;
};

} // namespace fx::render
