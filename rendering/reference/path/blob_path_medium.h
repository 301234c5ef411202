/// @file blob_path_medium.h
/// A medium of balls with the quartic kernel, for the path tracer.
#pragma once

#include "rendering/reference/path/path_medium.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/trace/ball_tree.h"

#include <span>
#include <vector>

namespace fx::render {

/// @formula blob-majorant
/// Upper bound of the extinction on a segment of a ray between two points where it enters or leaves a ball.
///
/// symbol   unit   meaning
///   e_i    1/m    extinction at the center of ball i, 105 s / (32 pi R^3) with cross section s and radius R
///   h_i    m      half the chord of the ray in ball i; c_i [m] ray parameter of the chord's center
///   d_i    m      distance of the segment [a, b] from c_i along the ray, 0 if c_i is inside
/// @derivation
///   extinction of ball i at t: e_i ((h_i^2 - (t - c_i)^2) / R_i^2)^2                              (1)
///   it decreases with |t - c_i|, so its largest value on [a, b] is (1) at the distance d_i        (2)
///   majorant = sum of (2) over the balls whose chords contain [a, b]                              (3)
/// @source    [UBT96] eq. (1) for the kernel in (1); (2) and (3) follow from it
/// @deviation with detail, a group contributes the largest eroded extinction, by field-detail, for a smooth
///            extinction (3) of its balls (4)
/// @valid     finite balls
/// @accuracy  an upper bound; for rounding it is multiplied by 1 + 1e-12, or 1 + 1e-5 with (4)
/// @tests     tests/rendering/reference/path/test_path_media.cpp
class BlobPathMedium final : public PathMedium
{
public:
    /// @param eye [m] world position to which rays are relative
    /// @param illuminance [lx] illuminance by other lights; emitters that are much fainter are not sampled
    ///         directly
    /// @param details detail of the blobs; empty: blobs are smooth
    /// @param pixel width of a pixel of the picture, by which detail is limited
    BlobPathMedium(std::span<const MediumBlob> blobs, const glm::dvec3& eye, base::TaskRunner& tasks,
                   double illuminance = 0.0, const MediumDetails& details = {}, const PixelWidth& pixel = {});
    std::unique_ptr<MediumWalk> walk() const override;
    /// Null if there is detail, because the optical depth has then no closed form.
    std::unique_ptr<DepthWalk> depthWalk() const override;

    /// Probability of sampling an emitting ball. The probability increases with the illuminance by the
    /// emitting balls, computed without attenuation.
    double emissionChance(const glm::dvec3& position) const override;
    /// True if at least one ball emits enough light for direct sampling.
    bool shines() const { return !shines_.empty(); }

    /// Samples a ball in proportion to its emission without self-absorption, then a direction that hits the
    /// ball.
    glm::dvec3 emissionDirection(const glm::dvec3& position, const std::array<double, 3>& u) const override;

    /// Upper bound of the extinction: the largest value over the cells of a grid. The value of a cell is the
    /// sum over balls of the ball's largest extinction in the cell, times the largest factor of detail.
    double majorant() const override;

    /// Optical properties of one ball. Balls are in the order of the tree.
    struct Substance
    {
        double extinction;     ///< [1/m] extinction at the center
        double inverseRadius2; ///< [1/m2]
        glm::dvec3 albedo;     ///< [1]
        glm::dvec3 source;     ///< [cd/m2] emitted light per optical depth
        PhaseFunction phase;
    };
    const BallTree& tree() const { return tree_; }
    const Substance& substance(uint32_t place) const { return substances_[place]; }
    const DetailedMedium& details() const { return details_; }
    bool hasOnePhase() const { return hasOnePhase_; }

    /// [cd/m2] Light that a ball emits per optical depth, summed over the channels.
    double power(uint32_t place) const
    {
        const glm::dvec3& source = substances_[place].source;
        return source.x + source.y + source.z;
    }
    /// [1/sr] Probability density with which emissionDirection() at `position` samples the ball and a
    /// direction that hits the ball.
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
    /// Computes the members that concern emission.
    /// @param illuminance [lx] illuminance by other lights
    void findGlow(std::span<const MediumBlob> blobs, double illuminance);

    glm::dvec3 glowCenter_{0.0};
    double glowRadius2_ = 0.0; ///< [m2]
    /// [m2] intensity [cd] of all balls divided by the illuminance [lx] by other lights
    double glowIntensity_ = 0.0;
    /// [1] Cumulative probability of sampling each ball; empty: no ball emits.
    std::vector<double> shines_;
};

} // namespace fx::render
