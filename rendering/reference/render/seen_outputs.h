/// @file seen_outputs.h
/// Computes the outputs of a ray (view_output): instance and motion of the visible medium, and the distance
/// at which the medium begins.
#pragma once

#include "rendering/reference/render/detailed_ray.h"
#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/render/reference_camera.h"
#include "rendering/reference/trace/ray_hits.h"

#include <glm/vec2.hpp>

#include <array>
#include <limits>
#include <vector>

namespace fx::render {

/// The previous frame, relative to which motion is measured.
struct ReferencePast
{
    ReferenceCamera camera;
    double seconds = 0.0; ///< [s] >= 0, time since the previous frame
};

/// Contribution of an instance to one ray.
struct InstanceShare
{
    uint64_t instance;
    double share; ///< [1] part of the ray's opacity that the instance causes
};

/// Adds `share` to the entry of `instance`, or appends a new entry.
void addShare(std::vector<InstanceShare>& io, uint64_t instance, double share);

/// Computes the outputs of rays, as defined in docs/howto/outputs.md.
///
/// A ray is divided into steps. In step k, d_k is the optical depth of a ball, D_k the optical depth of all
/// balls, and T_k the transmittance up to the step. The share of the ball in the visible opacity is
///     sum over k of T_k (1 - exp(-D_k)) d_k / D_k,
/// which is exact if the mixture of balls is constant within each step. Each thread needs its own object.
class SeenOutputs
{
public:
    /// [1] Optical depth at which a medium begins to be visible. The first depth is the distance at which the
    /// medium reaches this optical depth.
    static constexpr double kSeenDepth = 0.01;
    static constexpr int kSteps = 256;

    struct Seen
    {
        double first = std::numeric_limits<double>::infinity(); ///< [m] first depth
        glm::dvec2 motion{0.0}; ///< [pixel] motion to the right and upwards, times `share`
        double share = 0.0;     ///< [1] opacity of the ray
    };

    /// @param eye [m] position of the eye of the picture
    /// @param width, height [pixel] size of the picture
    SeenOutputs(const MediumView& medium, const glm::dvec3& eye, const ReferencePast& past, int width,
                int height)
        : medium_(medium), past_(past), moved_(eye - past.camera.eye), width_(width), height_(height)
    {}

    /// Computes the outputs of a ray.
    /// @param hits blobs that the ray meets between its parameters `begin` and `end`
    /// @param detailed object that has traced the same ray; null: blobs are smooth
    /// @param window [pixel] position of the ray in the picture, to the right and upwards
    /// @param ioShares visible shares by instance; the shares of the ray are added
    Seen along(const TraceRay& ray, const RayHits& hits, double begin, double end, DetailedRay* detailed,
               const glm::dvec2& window, std::vector<InstanceShare>& ioShares);

private:
    double depthTo(double place) const;
    double firstDepth() const;
    void fillSteps();
    void weigh();
    /// [pixel] Window position in the previous frame of a point that is relative to the previous eye.
    glm::dvec2 windowBefore(const glm::dvec3& place) const;

    const MediumView& medium_;
    const ReferencePast& past_;
    glm::dvec3 moved_; ///< [m] motion of the eye since the previous frame
    int width_, height_;
    std::vector<BlobChord> chords_;
    std::vector<double> depths_;  ///< [1] optical depth of each hit in each step
    std::vector<double> shares_;  ///< [1] visible share of each hit
    std::vector<double> moments_; ///< [m] mean distance of each hit times its visible share
    DetailedRay* detailed_ = nullptr;
    double begin_ = 0.0, end_ = 0.0, whole_ = 0.0;
};

} // namespace fx::render
