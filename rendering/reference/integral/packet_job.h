/// @file packet_job.h
/// Interface to the code of the integral that is compiled for each instruction set.
#pragma once

#include "rendering/reference/integral/group_scratch.h"
#include "rendering/reference/integral/ray_packet.h"

namespace fx::render::integral {

/// The blobs of a packet that a group of its rays meets. The memory is reused for the next group.
template <class T>
struct MetBlobs
{
    LineArray<T> center, chord2;
    std::vector<typename RayPacket<T>::Shared> shared;
};

template <class T>
struct PacketJob
{
    const GroupRules<T>& rules;
    GroupScratch<T>& scratch;
    MetBlobs<T>& met;
    const PacketRays<T>& rays;
    const RayPacket<T>& packet;
    RayWork* work; ///< counters of the work; null: work is not counted
    PacketLight<T>& light;
};

template <class T>
T largestRadius(const RayPacket<T>& packet)
{
    T largest = T(0);
    for (const typename RayPacket<T>::Shared& blob : packet.shared)
        largest = largest < blob.radius ? blob.radius : largest;
    return largest;
}

template <class T>
T brightestSource(const RayPacket<T>& packet)
{
    T brightest = T(0);
    for (const typename RayPacket<T>::Shared& blob : packet.shared)
        for (const T source : blob.source)
            brightest = brightest < source ? source : brightest;
    return brightest;
}

/// The input for the group of rays that begins at lane number `lane` of the packet.
template <class T>
GroupInput<T> inputOf(const PacketJob<T>& job, uint32_t lane, T largest, T brightest)
{
    const PacketRays<T>& rays = job.rays;
    return {uint32_t(job.packet.shared.size()),
            kPacketRays,
            largest,
            brightest,
            job.packet.center.data() + lane,
            job.packet.chord2.data() + lane,
            rays.nearest + lane,
            rays.farthest + lane,
            {rays.background[0] + lane, rays.background[1] + lane, rays.background[2] + lane}};
}
template <class T>
GroupOutput<T> outputOf(const PacketJob<T>& job, uint32_t lane)
{
    PacketLight<T>& light = job.light;
    return {{light.radiance[0] + lane, light.radiance[1] + lane, light.radiance[2] + lane},
            light.opticalDepth + lane,
            light.transmittance + lane,
            light.flags + lane};
}

template <class T>
struct MeetJob
{
    const PacketRays<T>& rays;
    std::span<const BallBlob<T>> balls;
    std::span<const uint32_t> candidates;
    RayPacket<T>& packet;
};

// These use the best available instruction set, see foundation/simd/instruction_set.h.
template <class T>
void integrateRays(const PacketJob<T>& job);
template <class T>
uint64_t meetRays(const MeetJob<T>& job);
/// Implementation for processors without SIMD, with the code of RayIntegrator.
template <class T>
void integrateOneByOne(const PacketJob<T>& job);

} // namespace fx::render::integral
