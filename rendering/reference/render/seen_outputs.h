/// @file seen_outputs.h
/// Whose the medium is that a ray sees, how it moves, and where it begins to be seen.
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
    double seconds = 0.0; ///< >= 0 since then
};

/// Contribution of an instance to one ray.
struct InstanceShare
{
    uint64_t instance;
    double share; ///< [1] share of the ray's opacity
};

/// Adds to the share of an instance.
void addShare(std::vector<InstanceShare>& io, uint64_t instance, double share);

/// The outputs are defined in docs/howto/outputs.md.
///
/// A ball that has the optical depth d_k of the whole D_k in step k of a ray has the share
///     sum over k of T_k (1 - exp(-D_k)) d_k / D_k
/// of what is seen, where T_k is the transmittance up to the step: exact where all balls of a step are mixed
/// alike. One for each thread.
class SeenOutputs
{
public:
    static constexpr double kSeenDepth = 0.01; ///< [1] optical depth at which the first depth is measured
    static constexpr int kSteps = 256;

    struct Seen
    {
        double first = std::numeric_limits<double>::infinity(); ///< [m]
        glm::dvec2 motion{0.0};                                 ///< [pixel] right and up, times `share`
        double share = 0.0;                                     ///< [1] opacity
    };

    /// @param eye [m] of the picture  @param width, height of it [pixel]
    SeenOutputs(const MediumView& medium, const glm::dvec3& eye, const ReferencePast& past, int width,
                int height)
        : medium_(medium), past_(past), moved_(eye - past.camera.eye), width_(width), height_(height)
    {}

    /// @param hits blobs that the ray meets between its parameters `begin` and `end`
    /// @param detailed that has traced the same; null: blobs are smooth
    /// @param window position of the ray in the picture [pixel], right and up
    /// @param ioShares gets what is seen of each instance, added to what is there
    Seen along(const TraceRay& ray, const RayHits& hits, double begin, double end, DetailedRay* detailed,
               const glm::dvec2& window, std::vector<InstanceShare>& ioShares);

private:
    double depthTo(double place) const;
    double firstDepth() const;
    void fillSteps();
    void weigh();
    glm::dvec2 windowBefore(const glm::dvec3& place) const; ///< place relative to the eye then

    const MediumView& medium_;
    const ReferencePast& past_;
    glm::dvec3 moved_; ///< [m] way of the eye since then
    int width_, height_;
    std::vector<BlobChord> chords_;
    std::vector<double> depths_;  ///< [1] of each hit in each step
    std::vector<double> shares_;  ///< [1] of each hit
    std::vector<double> moments_; ///< [m] of each hit, times its share
    DetailedRay* detailed_ = nullptr;
    double begin_ = 0.0, end_ = 0.0, whole_ = 0.0;
};

} // namespace fx::render
