/// @file accuracy_cases.h
/// Set-ups on which the schemes of the ray integral are compared, and their errors. Times are the caller's
/// matter: it measures integrate().
#pragma once

#include "rendering/reference/integral/integral_scheme.h"
#include "rendering/reference/integral/ray_packet.h"
#include "rendering/reference/integral/ray_records.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fx::render {

/// Distribution of relative errors, and the work that was done for them.
struct IntegralError
{
    double median = 0.0;
    double p99 = 0.0;
    double largest = 0.0;
    size_t values = 0;
    RayWork work;
};

/// A picture of blobs, as packets of 4 x 4 pixels that are ready to be integrated.
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

    /// The timed work: integrates every ray of packets [begin, end). @param outLights one for each packet of
    /// the picture
    void integrate(PacketIntegrator<T>& integrator, size_t begin, size_t end,
                   PacketLight<T>* outLights) const;

private:
    std::vector<PacketRays<T>> rays_;
    std::vector<RayPacket<T>> packets_;
};

/// 270 blobs of radius 0.3 m with random emission, centers even in a ball of radius 1 m, of which the
/// diameter fills the width of the picture; parallel rays.
/// @param opticalDepth [1] of the ray through the center
/// @param width, height in pixels, multiples of 4
/// @param every takes each so many-th packet of the picture only
template <class T>
PacketPicture<T> ballOfBlobs(double opticalDepth, uint32_t width, uint32_t height, uint32_t every = 1);

/// The right answers to a picture: one for each ray, by reference_integral.h.
std::vector<std::array<double, 3>> referenceLight(const PacketPicture<double>& picture,
                                                  const IntegralSettings& settings);

/// Errors of all channels of all rays whose light is above 1e-6 of the brightest.
template <class T>
IntegralError integralError(const PacketPicture<T>& picture, const IntegralSettings& settings,
                            const std::vector<std::array<double, 3>>& reference);

/// Blobs that all emit 1: light has to be 1 - e^-tau.
struct FurnaceError
/// |I / (1 - e^-tau) - 1|
{
    double largest = 0.0;
    double excess = 0.0;  ///< I / (1 - e^-tau) - 1: light that was created
    double atDepth = 0.0; ///< optical depth of the largest error
    uint32_t atBlobs = 0;
};

/// Optical depths 10^-3 to 10^5, 25 a decade, through 1 to 64 overlapping blobs.
template <class T>
FurnaceError furnaceError(const IntegralSettings& settings);

} // namespace fx::render
