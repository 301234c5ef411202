/// @file detailed_ray.h
/// Computes light and optical depth along a ray through fields with detail, for which there is no closed
/// form.
#pragma once

#include "rendering/reference/render/chord_depth.h"

#include <array>
#include <vector>

namespace fx::render {

/// @formula detailed-ray-integral
/// Light and optical depth along a ray by adaptive quadrature of the detailed field.
///
/// symbol   unit     meaning
///   t        m        ray parameter; L the length of the ray in the medium
///   k(t)     1/m      extinction: sum over groups of the eroded extinction
///   j(t)     cd/m3    emission
///   D, T     1        optical depth from the beginning, transmittance exp(-D)
///   a, b     m        ends of a piece; m its midpoint
///   J        cd/m2    light of the whole ray, estimated from the first pieces
///   e        1        tolerance
/// @derivation
///   S(f) = (b - a)/6 (f(a) + 4 f(m) + f(b)) is Simpson's rule; S' is the sum of S for both halves        (1)
///   A piece is halved until, for k and for each channel of j,
///       max(T(a), 1/1000) |S'(k) - S(k)| <= q e, T(a) |S'(j) - S(j)| <= q e J, q^2 = (b - a)/L        (2)
///   and until its halves have an optical depth of at most 1/2, so that S(T j) is accurate. If errors of
///   pieces are independent, as at kinks of the noise, (2) limits the total error to e.                 (3)
///   Between three points, k is approximated by the parabola through them:
///       D(m) - D(a) = (b - a)/24 (5 k(a) + 8 k(m) - k(b))                                               (4)
///   The first pieces are at most as long as half of the shortest chord at their position, and as an eighth
///   of the largest lumps.
/// @source    textbook; field-detail for k
/// @deviation kinks of the noise are not located: a piece with a kink is halved until (2) holds
/// @valid     any number of balls
/// @accuracy  root mean square error over rays: T at most e, light e J, D e / max(T, 1/1000)
/// @tests     tests/rendering/reference/render/test_detailed_ray.cpp
///
/// Each thread needs its own object.
class DetailedRay
{
public:
    enum class Wanted : uint8_t
    {
        Depth, ///< the optical depth only
        Light  ///< optical depth, light, coverage and distance
    };
    /// @param medium medium, which must be built and must outlive the object
    DetailedRay(const MediumView& medium, Wanted wanted, double tolerance);

    /// Integrates a ray. The functions from opticalDepth() to distance() return the results.
    /// @param hits all blobs of the medium that the ray meets between its parameters `begin` and `end`
    void trace(const TraceRay& ray, const RayHits& hits, double begin, double end);

    double opticalDepth() const { return depth_; }
    double opticalDepth(double from, double to) const { return depthTo(to) - depthTo(from); }
    const glm::dvec3& light() const { return sent_.light; }       ///< [cd/m2] emitted light
    const glm::dvec3& coverage() const { return sent_.coverage; } ///< [1] opacities of fire, smoke and dust
    /// [cd/m2] Light scattered by blobs of a layer, see blob_light.h.
    const glm::dvec3& scattered(base::MediaLayer layer) const { return sent_.scattered[size_t(layer)]; }
    /// [m] mean distance of the visible medium, +infinity without medium: formula seen-depth (1).
    double distance() const;

    /// Evaluates the detail at a ray parameter. The results are available from share().
    void look(double parameter);
    /// [1] Eroded extinction of a blob divided by its smooth extinction, at the parameter passed to look().
    /// @param hit index in `hits`
    double share(size_t hit) const { return mix_.share(hits_->place[hit]); }
    /// [1] Albedo of a blob at that parameter. @param albedo of the blob, unless it stands for a volume
    glm::dvec3 albedo(size_t hit, const glm::dvec3& albedo) const
    {
        return mix_.albedo(hits_->place[hit], albedo);
    }

private:
    /// Light that reaches the eye: per meter of the ray, or from the whole ray.
    struct Sent
    {
        glm::dvec3 light{0.0}, coverage{0.0};
        std::array<glm::dvec3, 3> scattered{};
        double moment = 0.0; ///< distance times visible extinction
        double seen = 0.0;   ///< visible extinction

        void add(const Sent& other, double weight);
    };
    struct Sample
    {
        double t = 0.0;
        double extinction = 0.0; ///< [1/m]
        Sent sent;
    };
    /// Half of a piece of the ray for which equations (2) and (3) hold.
    struct Piece
    {
        double begin, end;       ///< [m]
        double first, mid, last; ///< [1/m] extinction
        double before;           ///< [1] optical depth up to `begin`
    };
    struct Span
    {
        double begin, end;
    };

    Span extent(double begin, double end) const;
    double step(double t, double end) const;
    Sample at(double t);
    void refine(const Sample& a, const Sample& m, const Sample& b, int level);
    void close(const Sample& a, const Sample& m, const Sample& b);
    double depthTo(double t) const;

    const MediumView& medium_;
    Wanted wanted_;
    double tolerance_;
    DetailMix mix_;
    TraceRay ray_{};
    const RayHits* hits_ = nullptr;
    std::vector<BlobChord> chords_;
    std::vector<Sample> samples_; ///< samples at the ends and midpoints of the first pieces
    std::vector<Piece> pieces_;
    double perLength_ = 0.0; ///< [1/m] 1 / L
    double brightest_ = 0.0; ///< [cd/m2] symbol J of the formula
    double depth_ = 0.0;
    Sent sent_;
};

} // namespace fx::render
