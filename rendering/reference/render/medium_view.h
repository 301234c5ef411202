/// @file medium_view.h
/// The medium of one picture: a tree of its blobs, and the integration of 16 rays at once.
#pragma once

#include "rendering/reference/integral/ray_packet.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/trace/tile_walk.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace fx::render {

/// Kinds of light of the blobs. An integration computes one kind.
enum class MediumSource : uint8_t
{
    Light,    ///< [cd/m2] emitted light
    Coverage, ///< opacities of fire, smoke and dust instead of red, green and blue
    Fire,     ///< [cd/m2] light scattered by blobs of the layer fire, see setScattered()
    Smoke,
    Dust
};

/// The blobs of a medium relative to an eye. Threads: any thread may call const functions after build().
class MediumView
{
public:
    /// @param details detail of the blobs; empty: blobs are smooth
    /// @param pixel width of a pixel of the picture, for the detail
    /// @param hasTracks true: prepares data for track()
    void build(std::span<const MediumBlob> blobs, const glm::dvec3& eye, base::TaskRunner& tasks,
               const MediumDetails& details = {}, const PixelWidth& pixel = {}, bool hasTracks = false);

    const BallTree& tree() const { return tree_; }
    /// The blob at a place, relative to the eye. A place is an index in the order of the tree.
    const BallBlob<double>& blob(uint32_t place) const { return blobs_[place]; }
    const std::array<double, 3>& coverage(uint32_t place) const { return coverage_[isUniform_ ? 0 : place]; }
    /// Instance and velocity of a blob.
    struct Track
    {
        glm::dvec3 velocity; ///< [m/s] velocity in the world
        uint64_t instance;
    };
    const Track& track(uint32_t place) const { return tracks_[place]; }
    /// Scattering properties of a blob.
    struct Scattering
    {
        glm::vec3 albedo; ///< [1]
        float anisotropy; ///< [1] mean cosine g of the Henyey-Greenstein phase function
        base::MediaLayer layer;
    };
    const Scattering& scattering(uint32_t place) const { return scattering_[place]; }
    const DetailedMedium& details() const { return details_; }
    const glm::vec3& scattered(uint32_t place) const { return scattered_[place]; } ///< see setScattered()
    /// Sets the light that each blob scatters, by place [cd/m2 per optical depth]; empty: blobs scatter no
    /// light.
    void setScattered(std::vector<glm::vec3> light);
    /// True if blobs of a layer scatter light.
    bool scatters(base::MediaLayer layer) const { return scatters_[size_t(layer)]; }
    std::array<double, 3> source(MediumSource source, uint32_t place) const;
    bool isEmpty() const { return count_ == 0; }
    /// True if all blobs have the same layers, so that coverage needs no separate integration.
    bool isUniform() const { return isUniform_; }
    /// Opacities of fire, smoke and dust that all blobs share; valid if isUniform() is true.
    glm::dvec3 coverage() const { return {coverage_[0][0], coverage_[0][1], coverage_[0][2]}; }

private:
    BallTree tree_;
    size_t count_ = 0;
    std::unique_ptr<BallBlob<double>[]> blobs_;
    /// Opacities of the layers by place. If isUniform_ is true, there is one entry for all blobs.
    std::vector<std::array<double, 3>> coverage_;
    std::unique_ptr<Scattering[]> scattering_;
    std::vector<glm::vec3> scattered_;
    std::vector<Track> tracks_; ///< empty if `hasTracks` was false
    DetailedMedium details_;
    std::array<bool, 3> scatters_{};
    bool isUniform_ = true;
};

/// Up to 16 rays through a block of pixels. Distances are ray parameters [m].
struct RayBundle
{
    uint32_t count = 0;
    std::array<TraceRay, kPacketRays> ray;
    std::array<double, kPacketRays> begin;
    std::array<double, kPacketRays> end;
};

/// Light of the medium, without the background.
struct BundleLight
{
    std::array<glm::dvec3, kPacketRays> radiance;
    std::array<double, kPacketRays> opticalDepth;
    std::array<double, kPacketRays> transmittance;
};

/// Integrates bundles of rays. Each thread needs its own object.
class BundleIntegrator
{
public:
    virtual ~BundleIntegrator() = default;
    /// Finds the candidates that the rays of the bundle meet. Candidates are places in ascending order. The
    /// next integrate() uses the result.
    /// @return number of ray-blob hits
    virtual uint64_t meet(const MediumView& medium, const RayBundle& rays,
                          std::span<const uint32_t> candidates) = 0;
    virtual void integrate(MediumSource source, BundleLight& out) = 0;
};

/// @param isSingle true: use float instead of double; ray parameters are then measured from a point near the
///         first blob, because of the precision of float
std::unique_ptr<BundleIntegrator> makeBundleIntegrator(const IntegralSettings& settings, bool isSingle);

} // namespace fx::render
