/// @file shadow_ray.h
/// What the medium and the triangles of a scene leave of light on its way to a point.
#pragma once

#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/render/opaque_view.h"
#include "rendering/reference/trace/ray_query.h"

#include <cmath>

namespace fx::render {

/// One for each thread: keeps memory from ray to ray.
class ShadowRay
{
public:
    /// @param medium, opaque must outlive this
    ShadowRay(const MediumView& medium, const OpaqueView& opaque)
        : medium_(medium), opaque_(opaque), detailed_(medium, DetailedRay::Wanted::Depth, kDetailTolerance)
    {}

    /// Of the medium alone.
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
    /// Transmittance of the media and surfaces between the ray's origin and `distance`; 0 behind a triangle.
    double visibility(const TraceRay& ray, double distance)
    {
        return opaque_.blocks(ray, distance, hits_) ? 0.0 : transmittance(ray, distance);
    }
    /// [m] to the first triangle, +infinity for none.
    double toSurface(const TraceRay& ray) { return opaque_.distance(ray, hits_); }

private:
    static constexpr double kDetailTolerance = 0.01; ///< many shadow rays make one value

    const MediumView& medium_;
    const OpaqueView& opaque_;
    DetailedRay detailed_;
    RayHits hits_;
};

} // namespace fx::render
