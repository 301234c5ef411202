/// @file accuracy_cases.h
/// Test cases to compare schemes of the ray integral, and their errors. Callers that need times measure
/// integrate().
#pragma once

#include "rendering/reference/integral/integral_scheme.h"
#include "rendering/reference/integral/ray_packet.h"
#include "rendering/reference/integral/ray_records.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fx::render {

/// Distribution of relative errors, and the work of the computation.
struct IntegralError
{
    double median = 0.0;
    double p99 = 0.0;
    double largest = 0.0;
    size_t values = 0;
    RayWork work;
};

/// A picture of blobs, as packets of 4 x 4 pixels for PacketIntegrator.
template <class T>
class PacketPicture
{
public:
    PacketPicture(std::vector<PacketRays<T>> rays, std::vector<RayPacket<T>> packets)
        : rays_(std::move(rays)), packets_(std::move(packets))
    {}
    size_t packets() const { return packets_.size(); }
    const PacketRays<T>& rays(size_t i) const { return rays_[i]; }
    const RayPacket<T>& packet(size_t i) const { return packets_[i]; }
    uint64_t hits() const;

    /// Integrates all rays of the packets [begin, end). @param outLights one for each packet of the picture
    void integrate(PacketIntegrator<T>& integrator, size_t begin, size_t end,
                   PacketLight<T>* outLights) const;

private:
    std::vector<PacketRays<T>> rays_;
    std::vector<RayPacket<T>> packets_;
};

/// A picture of 270 blobs of radius 0.3 m with random emission. Their centers are uniformly distributed in a
/// ball of radius 1 m, whose diameter fills the width of the picture. Rays are parallel.
/// @param opticalDepth [1] optical depth of the ray through the center
/// @param width, height in pixels, multiples of 4
/// @param every only each packet number k * every of the picture is used
template <class T>
PacketPicture<T> ballOfBlobs(double opticalDepth, uint32_t width, uint32_t height, uint32_t every = 1);

/// Reference light [cd/m2] of each ray of a picture, by reference_integral.h.
std::vector<std::array<double, 3>> referenceLight(const PacketPicture<double>& picture,
                                                  const IntegralSettings& settings);

/// Errors of all channels of all rays whose light exceeds 1e-6 times that of the brightest ray.
template <class T>
IntegralError integralError(const PacketPicture<T>& picture, const IntegralSettings& settings,
                            const std::vector<std::array<double, 3>>& reference);

/// Error of a test where all blobs emit 1, so that the exact light is 1 - e^-tau.
struct FurnaceError
{
    double largest = 0.0; ///< |I / (1 - e^-tau) - 1|
    double excess = 0.0;  ///< largest I / (1 - e^-tau) - 1: energy gain
    double atDepth = 0.0; ///< optical depth of the largest error
    uint32_t atBlobs = 0; ///< number of blobs of the largest error
};

/// Tests optical depths 10^-3 to 10^5, 25 per decade, through 1 to 64 overlapping blobs.
template <class T>
FurnaceError furnaceError(const IntegralSettings& settings);

} // namespace fx::render
