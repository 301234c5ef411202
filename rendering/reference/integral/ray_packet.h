/// @file ray_packet.h
/// The light along 16 neighboring rays at once. Each ray gets the bits that RayIntegrator gives it alone,
/// with every instruction set.
///
/// Meant for a tile of 4 x 4 pixels: find the blobs that the tile can meet, in the order of their ids, then
/// packet.begin(), meetBlobs(), integrate().
#pragma once

#include "foundation/result/status.h"
#include "rendering/reference/integral/integral_scheme.h"
#include "rendering/reference/integral/ray_records.h"

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace fx::render {

constexpr uint32_t kPacketRays = 16;

/// A ball of medium in space. Lengths and places are relative to an origin of the caller's, near the camera
/// or the medium, in which float is good enough.
template <class T>
struct BallBlob
{
    T center[3];  ///< [m]
    T radius;     ///< [m] > 0
    T extinction; ///< [1/m] at the center
    T source[3];  ///< [cd/m2] (1 - albedo) emission
};

/// Lane i of every array is ray i. Unused lanes repeat a used one.
template <class T>
struct alignas(64) PacketRays
{
    T origin[3][kPacketRays];    ///< [m]
    T direction[3][kPacketRays]; ///< unit
    T nearest[kPacketRays];      ///< [m] as in RayWindow
    T farthest[kPacketRays];
    T background[3][kPacketRays];
};

/// The blobs of a packet. Blob k has the places [k * kPacketRays, (k + 1) * kPacketRays) of the lane arrays.
/// Finite numbers are the caller's duty.
template <class T>
struct RayPacket
/// [m] as in RayBlob, one for each ray
{
    std::vector<T> center;
    std::vector<T> chord2; ///< [m2]; <= 0 for rays that miss
    /// Data shared by all rays.
    struct Shared
    {
        T radius;
        T extinction;
        T source[3];
        uint32_t id;
    };
    std::vector<Shared> shared; ///< by increasing id

    void clear();
    /// Adds a blob and returns its place; lanes are zero (missed) until written.
    size_t add(const Shared& blob);
};

/// The direction of a ray, for PacketRays, from one of any length.
/// @return InvalidArgument for zero, an infinity or NaN
base::Result<std::array<double, 3>> unitDirection(const std::array<double, 3>& direction);

template <class T>
struct alignas(64) PacketLight
{
    T radiance[3][kPacketRays];
    T opticalDepth[kPacketRays];
    T transmittance[kPacketRays];
    uint32_t flags[kPacketRays];
};

/// Appends those of `balls` that at least one of the rays meets, in the order of `candidates`, which are
/// places in `balls` and become the ids. Parameters are counted from the rays' origins. Formula
/// ray-ball-approach.
/// @return number of ray-blob hits
template <class T>
uint64_t meetBlobs(const PacketRays<T>& rays, std::span<const BallBlob<T>> balls,
                   std::span<const uint32_t> candidates, RayPacket<T>& packet);

/// Keeps its memory between packets: one for each thread. Sets the floating-point mode while it works.
template <class T>
class PacketIntegrator
{
public:
    explicit PacketIntegrator(const IntegralSettings& settings);
    ~PacketIntegrator();
    PacketIntegrator(PacketIntegrator&&) noexcept;
    PacketIntegrator& operator=(PacketIntegrator&&) noexcept;

    /// Uses nearest, farthest and background of `rays`; origin and direction are meetBlobs' matter.
    void integrate(const PacketRays<T>& rays, const RayPacket<T>& packet, PacketLight<T>& outLight);

    /// Enables counters, which cost a few percent; off by default.
    void countWork(bool isOn);
    const RayWork& work() const;
    void clearWork();

    class Machine;

private:
    std::unique_ptr<Machine> machine_;
};

} // namespace fx::render
