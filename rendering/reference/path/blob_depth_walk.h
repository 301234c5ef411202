/// @file blob_depth_walk.h
/// Optical depth through balls with the quartic kernel, and its inverse.
#pragma once

#include "rendering/reference/path/blob_path_medium.h"
#include "rendering/reference/trace/ray_hits.h"

namespace fx::render {

/// @formula blob-depth-inverse
/// Ray parameter at which the optical depth of overlapping balls reaches a given value.
///
/// symbol   unit   meaning
///   s_i      1/m    extinction of ball i at the center of its chord, e_i (h_i^2 / R_i^2)^2 by blob-majorant
///   c_i, h_i m      center of the chord, half its length
///   u        1      (t - c_i) / h_i, limited to -1..1
///   D(t)     1      optical depth from the beginning a to t; T the given optical depth
/// @derivation
///   k(u) = integral of (1 - v^2)^2 from 0 to u = u - 2 u^3 / 3 + u^5 / 5                            (1)
///   D(t) = sum of s_i h_i (k(u(t)) - k(u(a)))                                                     (2)
///   D'(t) = sum of s_i (1 - u^2)^2 >= 0                                                           (3)
///   t <- t - (D(t) - T) / D'(t), or the center of the bracket if this t is outside of it          (4)
/// @source    [UBT96] eq. (1) for the kernel; (1) to (4) follow from it: Newton's iteration on a monotone
///            function, within a bracket
/// @deviation none
/// @valid     0 <= T <= D(end)
/// @accuracy  |D(t) - T| <= 1e-12 (1 + T), or the bracket has no number between its ends
/// @tests     tests/rendering/reference/path/test_path_depth.cpp
class BlobDepthWalk final : public DepthWalk
{
public:
    explicit BlobDepthWalk(const BlobPathMedium& medium) : medium_(medium) {}

    void start(const TraceRay& ray, double begin, double end) override;
    double depth() const override { return depth_; }
    double depthTo(double parameter) const override;
    double parameterAt(double depth) const override;
    MediumPoint at(double parameter, double choice) const override;
    std::pair<double, double> extent() const override { return {begin_, end_}; }
    double emitted() const override { return emitted_; }
    double emissionParameter(double u) const override;
    double emissionDensity() const override;

private:
    /// Computes the members that concern emission. All other members must have been computed.
    void findEmission(double begin, double end);

    struct Chord
    {
        double middle, inverseHalf; ///< [m] center of the chord; [1/m] inverse of half its length
        double peak;                ///< [1/m] symbol s_i of the formula
        double weight;              ///< [1] s_i h_i
    };
    /// [1/m] Extinction of a chord's ball at a ray parameter.
    static double extinctionOf(const Chord& chord, double parameter);

    const BlobPathMedium& medium_;
    RayHits hits_;
    std::vector<Chord> chords_;      ///< one chord for each of `hits_`
    double begin_ = 0.0, end_ = 0.0; ///< [m] ends of that part of the ray in which there is medium
    double before_ = 0.0;            ///< [1] sum of s_i h_i k(u(a)) in equation (2)
    double depth_ = 0.0;
    double emitted_ = 0.0;
    /// [cd/m2] By hit: emission of the ball; empty if the medium emits nothing.
    std::vector<double> emittedBy_;
    glm::dvec3 origin_{0.0};                         ///< [m] origin of the ray
    double emissionBegin_ = 0.0, emissionEnd_ = 0.0; ///< [m] arguments of the last start()
};

} // namespace fx::render
