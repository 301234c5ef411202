/// @file chord_depth.h
/// Computes the optical depth of blobs along a ray, from the chords in RayHits.
#pragma once

#include "rendering/reference/render/medium_view.h"

#include <algorithm>

namespace fx::render {

/// The chord of a ray in a blob. At the parameter nearest + half u, |u| <= 1, extinction is peak (1 - u^2)^2.
struct BlobChord
{
    BlobChord(const BallBlob<double>& blob, const RayHits& hits, size_t i)
        : nearest(hits.nearest[i]), half(hits.nearest[i] - hits.enter[i])
    {
        const double q2 = hits.chordSquare[i] / (blob.radius * blob.radius);
        peak = blob.extinction * q2 * q2;
    }

    /// The value of u at the ray parameter `t`, clamped to -1..1; 1 if the chord has no length due to
    /// rounding.
    double place(double t) const { return half > 0.0 ? std::clamp((t - nearest) / half, -1.0, 1.0) : 1.0; }
    /// Integral of (1 - u^2)^2 from 0 to place(t).
    double bracket(double t) const
    {
        const double u = place(t);
        const double s = u * u;
        return u * (1.0 - s * (2.0 / 3.0 - s * 0.2));
    }
    double opticalDepth(double begin, double end) const
    {
        return peak * half * (bracket(end) - bracket(begin));
    }
    /// [1/m] Extinction at the ray parameter `t`.
    double extinction(double t) const
    {
        const double u = place(t);
        const double s = 1.0 - u * u;
        return peak * s * s;
    }

    double nearest, half, peak;
};

/// Optical depth of all hit blobs between two ray parameters.
inline double opticalDepthOf(const MediumView& medium, const RayHits& hits, double begin, double end)
{
    double sum = 0.0;
    for (size_t i = 0; i < hits.size(); ++i)
        sum += BlobChord(medium.blob(hits.place[i]), hits, i).opticalDepth(begin, end);
    return sum;
}

} // namespace fx::render
