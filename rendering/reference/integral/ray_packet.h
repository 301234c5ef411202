/// @file ray_packet.h
/// Computes the light along 16 neighboring rays at once. With every instruction set, the results have the
/// same bits as the results of RayIntegrator.
///
/// To integrate a tile of 4 x 4 pixels, first find the blobs that rays of the tile may meet, in the order of
/// their ids. Then call packet.clear(), meetBlobs() and integrate().
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

/// A ball of medium in space. Positions are relative to an origin that the caller chooses, near enough to the
/// camera or the medium for the precision of float.
template <class T>
struct BallBlob
{
    T center[3];  ///< [m]
    T radius;     ///< [m] > 0
    T extinction; ///< [1/m] extinction at the center
    T source[3];  ///< [cd/m2] emission times (1 - albedo)
};

/// The rays of a packet. Lane i of each array belongs to ray i. Unused lanes must repeat a used lane.
template <class T>
struct alignas(64) PacketRays
{
    T origin[3][kPacketRays];    ///< [m]
    T direction[3][kPacketRays]; ///< unit vector
    T nearest[kPacketRays];      ///< [m] beginning of the visible part of the ray, see RayWindow
    T farthest[kPacketRays];
    T background[3][kPacketRays];
};

/// The blobs of a packet. Blob k has the elements [k * kPacketRays, (k + 1) * kPacketRays) of the lane
/// arrays. All numbers must be finite.
template <class T>
struct RayPacket
{
    std::vector<T> center; ///< [m] for each ray: RayBlob::center
    std::vector<T> chord2; ///< [m2] for each ray: RayBlob::chord2, which is <= 0 if the ray misses the blob
    /// Properties of a blob that all rays share.
    struct Shared
    {
        T radius;
        T extinction;
        T source[3];
        uint32_t id;
    };
    std::vector<Shared> shared; ///< blobs, sorted by increasing id

    void clear();
    /// Adds a blob and returns its index. Its lanes are initially zero, which means that all rays miss the
    /// blob.
    size_t add(const Shared& blob);
};

/// Normalizes a direction, for PacketRays.
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

/// Appends the balls that at least one ray meets to `packet`, in the order of `candidates`. A candidate is an
/// index in `balls`, which becomes the id of the blob. Ray parameters are measured from the origins of rays.
/// See formula ray-ball-approach.
/// @return number of ray-blob hits
template <class T>
uint64_t meetBlobs(const PacketRays<T>& rays, std::span<const BallBlob<T>> balls,
                   std::span<const uint32_t> candidates, RayPacket<T>& packet);

/// Integrates packets of rays. Memory is reused for the next packet. Each thread needs its own object. Calls
/// change the floating-point mode and restore it at the end.
template <class T>
class PacketIntegrator
{
public:
    explicit PacketIntegrator(const IntegralSettings& settings);
    ~PacketIntegrator();
    PacketIntegrator(PacketIntegrator&&) noexcept;
    PacketIntegrator& operator=(PacketIntegrator&&) noexcept;

    /// Computes the light of all rays of a packet. Reads only the members nearest, farthest and background of
    /// `rays`; meetBlobs() has already used origin and direction.
    void integrate(const PacketRays<T>& rays, const RayPacket<T>& packet, PacketLight<T>& outLight);

    /// Turns the counters of work on or off; they are off by default. Counting costs a few percent of the
    /// time.
    void countWork(bool isOn);
    const RayWork& work() const;
    void clearWork();

    class Machine;

private:
    std::unique_ptr<Machine> machine_;
};

} // namespace fx::render
