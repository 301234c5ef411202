/// @file blob_path_medium.h
/// Balls with the quartic kernel as the path tracer's medium.
#pragma once

#include "rendering/reference/path/path_medium.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/trace/ball_tree.h"

#include <span>
#include <vector>

namespace fx::render {

/// @formula blob-majorant
/// Upper bound of the extinction between two places where a ray enters or leaves a ball.
///
/// symbol   unit   meaning
///   e_i    1/m    extinction at the center of ball i, 105 s / (32 pi R^3) with cross section s and radius R
///   h_i    m      half the chord of the ray in ball i; c_i [m] the ray parameter nearest to the center
///   d_i    m      distance of the segment [a, b] from c_i along the ray, 0 when c_i is inside
/// @derivation
///   extinction of ball i at t: e_i ((h_i^2 - (t - c_i)^2) / R_i^2)^2                              (1)
///   it falls with |t - c_i|, so its largest value on [a, b] is (1) at distance d_i                (2)
///   majorant = sum of (2) over the balls whose chords contain [a, b]                              (3)
/// @source    [UBT96] eq. (1) for the kernel in (1); (2) and (3) follow from it
/// @deviation none
///   of a group with detail: the most that detail leaves of (3) of its balls, by field-detail          (4)
/// @valid     finite balls
/// @accuracy  a true bound but for rounding, which a factor of 1 + 1e-12 covers, 1 + 1e-5 of (4)
/// @tests     tests/rendering/reference/path/test_path_media.cpp
class BlobPathMedium final : public PathMedium
{
public:
    /// @param eye [m] world position that rays are relative to
    /// @param illuminance [lx] of other lights; much fainter emitters are not sampled directly
    /// @param details of the blobs; none: they are smooth  @param pixel of the picture, for details
    BlobPathMedium(std::span<const MediumBlob> blobs, const glm::dvec3& eye, base::TaskRunner& tasks,
                   double illuminance = 0.0, const MediumDetails& details = {}, const PixelWidth& pixel = {});
    std::unique_ptr<MediumWalk> walk() const override;
    /// Null with detail, whose optical depth has no closed form.
    std::unique_ptr<DepthWalk> depthWalk() const override;

    /// Grows with the illuminance that the glow would have without medium between.
    double emissionChance(const glm::dvec3& position) const override;
    /// Whether any ball glows brightly enough for direct sampling.
    bool shines() const { return !shines_.empty(); }

    /// Samples a ball in proportion to its emission without self-absorption, then a direction that hits it.
    glm::dvec3 emissionDirection(const glm::dvec3& position, const std::array<double, 3>& u) const override;

    /// By cells of a grid: the sum over balls of the largest value that each has in the cell, times the
    /// largest factor of detail.
    double majorant() const override;

    /// One ball, in the order of the tree.
    struct Substance
    {
        double extinction;     ///< [1/m] at the center
        double inverseRadius2; ///< [1/m2]
        glm::dvec3 albedo;     ///< [1]
        glm::dvec3 source;     ///< [cd/m2] emitted light per optical depth
        PhaseFunction phase;
    };
    const BallTree& tree() const { return tree_; }
    const Substance& substance(uint32_t place) const { return substances_[place]; }
    const DetailedMedium& details() const { return details_; }
    bool hasOnePhase() const { return hasOnePhase_; }

    /// [cd/m2] light that a ball emits for each optical depth, summed over the channels
    double power(uint32_t place) const
    {
        const glm::dvec3& source = substances_[place].source;
        return source.x + source.y + source.z;
    }
    /// [1/sr] density, due to one ball, of directions of emissionDirection() from `position` that hit this
    /// ball.
    double emissionDensity(uint32_t place, const glm::dvec3& position) const;

private:
    glm::dvec3 center(uint32_t place) const
    {
        const BallTree::Leaf& leaf = tree_.leaves()[place / BallTree::kWidth];
        const uint32_t k = place % BallTree::kWidth;
        return {leaf.x[k], leaf.y[k], leaf.z[k]};
    }
    double radius(uint32_t place) const
    {
        return tree_.leaves()[place / BallTree::kWidth].radius[place % BallTree::kWidth];
    }
    BallTree tree_;
    std::vector<Substance> substances_;
    DetailedMedium details_;
    bool hasOnePhase_ = true;
    /// Computes the members about emission. @param illuminance [lx]
    void findGlow(std::span<const MediumBlob> blobs, double illuminance);

    glm::dvec3 glowCenter_{0.0};
    double glowRadius2_ = 0.0;   ///< [m2]
    double glowIntensity_ = 0.0; ///< [cd] of all balls, over the illuminance of other lights [m2]
    /// [1] probability that one of the balls up to this place is drawn; empty: no ball emits.
    std::vector<double> shines_;
};

} // namespace fx::render
