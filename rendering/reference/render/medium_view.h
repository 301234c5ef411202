/// @file medium_view.h
/// The medium of one picture: the tree over its blobs, and the light of 16 rays at once.
#pragma once

#include "rendering/reference/integral/ray_packet.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/trace/tile_walk.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace fx::render {

/// Source light of blobs in one integration. Columns in the order of the tree.
enum class MediumSource : uint8_t
{
    Light,    ///< [cd/m2] emitted light
    Coverage, ///< 1 for what is counted as fire, smoke, dust in place of red, green, blue
    Fire,     ///< [cd/m2] light scattered by blobs of this layer, see setScattered()
    Smoke,
    Dust
};

/// Blobs relative to an eye. Read by any number of threads after build().
class MediumView
{
public:
    /// @param details of the blobs; none: they are smooth  @param pixel of the picture, for details
    /// @param hasTracks track() is going to be asked
    void build(std::span<const MediumBlob> blobs, const glm::dvec3& eye, base::TaskRunner& tasks,
               const MediumDetails& details = {}, const PixelWidth& pixel = {}, bool hasTracks = false);

    const BallTree& tree() const { return tree_; }
    /// Of the blob at a place of the tree's order, relative to the eye.
    const BallBlob<double>& blob(uint32_t place) const { return blobs_[place]; }
    const std::array<double, 3>& coverage(uint32_t place) const { return coverage_[isUniform_ ? 0 : place]; }
    /// Whose a blob is, and how it moves.
    struct Track
    {
        glm::dvec3 velocity; ///< [m/s] world
        uint64_t instance;
    };
    const Track& track(uint32_t place) const { return tracks_[place]; }
    /// How a blob scatters.
    struct Scattering
    {
        glm::vec3 albedo; ///< [1]
        float anisotropy; ///< [1] Henyey-Greenstein g
        base::MediaLayer layer;
    };
    const Scattering& scattering(uint32_t place) const { return scattering_[place]; }
    const DetailedMedium& details() const { return details_; }
    const glm::vec3& scattered(uint32_t place) const { return scattered_[place]; } ///< of setScattered()
    /// Light that blobs scatter [cd/m2 per optical depth], by their places; empty: none.
    void setScattered(std::vector<glm::vec3> light);
    /// Whether blobs of a layer scatter light.
    bool scatters(base::MediaLayer layer) const { return scatters_[size_t(layer)]; }
    std::array<double, 3> source(MediumSource source, uint32_t place) const;
    bool isEmpty() const { return count_ == 0; }
    /// Whether all blobs count alike, so that coverage needs no integration of its own.
    bool isUniform() const { return isUniform_; }
    glm::dvec3 coverage() const { return {coverage_[0][0], coverage_[0][1], coverage_[0][2]}; } ///< then

private:
    BallTree tree_;
    size_t count_ = 0;
    std::unique_ptr<BallBlob<double>[]> blobs_;
    std::vector<std::array<double, 3>> coverage_; ///< one for all when they are alike
    std::unique_ptr<Scattering[]> scattering_;
    std::vector<glm::vec3> scattered_;
    std::vector<Track> tracks_; ///< none unless they were wanted
    DetailedMedium details_;
    std::array<bool, 3> scatters_{};
    bool isUniform_ = true;
};

/// Up to 16 rays of a block of pixels. Distances are ray parameters [m].
struct RayBundle
{
    uint32_t count = 0;
    std::array<TraceRay, kPacketRays> ray;
    std::array<double, kPacketRays> begin;
    std::array<double, kPacketRays> end;
};

/// Light of the medium alone, without what stands behind it.
struct BundleLight
{
    std::array<glm::dvec3, kPacketRays> radiance;
    std::array<double, kPacketRays> opticalDepth;
    std::array<double, kPacketRays> transmittance;
};

/// Integrates bundles. One for each thread.
class BundleIntegrator
{
public:
    virtual ~BundleIntegrator() = default;
    /// Finds the blobs that the bundle meets among the places `candidates` (rising); they serve the following
    /// calls.
    /// @return ray-blob hits
    virtual uint64_t meet(const MediumView& medium, const RayBundle& rays,
                          std::span<const uint32_t> candidates) = 0;
    virtual void integrate(MediumSource source, BundleLight& out) = 0;
};

/// @param isSingle float instead of double. Ray parameters are then counted from near the first blob, where
/// float
///   resolves them
std::unique_ptr<BundleIntegrator> makeBundleIntegrator(const IntegralSettings& settings, bool isSingle);

} // namespace fx::render
