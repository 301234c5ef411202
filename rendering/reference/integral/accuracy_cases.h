/// @file accuracy_cases.h
/// Test cases and error measures to compare schemes of the ray integral.
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

    /// Integrates all rays of the packets [begin, end). @param outLights light of each packet of the picture
    void integrate(PacketIntegrator<T>& integrator, size_t begin, size_t end,
                   PacketLight<T>* outLights) const;

private:
    std::vector<PacketRays<T>> rays_;
    std::vector<RayPacket<T>> packets_;
};

/// A picture of 270 blobs of radius 0.3 m with random emission. Their centers are uniformly distributed in a
/// ball of radius 1 m, whose diameter fills the width of the picture. Rays are parallel.
/// @param opticalDepth [1] optical depth of the ray through the center
/// @param width, height [pixel] size of the picture, multiples of 4
/// @param every only the packets with the numbers 0, every, 2 every, ... of the picture are used
template <class T>
PacketPicture<T> ballOfBlobs(double opticalDepth, uint32_t width, uint32_t height, uint32_t every = 1);

/// Reference light [cd/m2] of each ray of a picture, computed with reference_integral.h.
std::vector<std::array<double, 3>> referenceLight(const PacketPicture<double>& picture,
                                                  const IntegralSettings& settings);

/// Computes the errors of all color channels. Rays darker than 1e-6 times the brightest ray are omitted.
template <class T>
IntegralError integralError(const PacketPicture<T>& picture, const IntegralSettings& settings,
                            const std::vector<std::array<double, 3>>& reference);

/// Errors of a test in which all blobs have the source 1. The exact light is then 1 - exp(-tau), where tau is
/// the optical depth.
struct FurnaceError
{
    double largest = 0.0; ///< largest |I / (1 - exp(-tau)) - 1|, where I is the computed light
    double excess = 0.0;  ///< largest gain of energy, I / (1 - exp(-tau)) - 1
    double atDepth = 0.0; ///< optical depth at which the error is largest
    uint32_t atBlobs = 0; ///< number of blobs for which the error is largest
};

/// Tests rays of optical depth 10^-3 to 10^5, 25 values per decade, through 1 to 64 overlapping blobs.
template <class T>
FurnaceError furnaceError(const IntegralSettings& settings);

} // namespace fx::render
