// The text of the integral with SIMD vectors for numbers.
#include "rendering/reference/integral/packet_job.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rendering/reference/integral/packet_integral.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/precision_dispatch.h"
#include "rendering/reference/integral/group_scratch.h"
#include "rendering/reference/integral/pack-inl.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace fx::render::integral::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR
// The order is that of use.
// clang-format off
#include "rendering/reference/integral/blob_sums.inl"
#include "rendering/reference/integral/interval_walk.inl"
#include "rendering/reference/integral/moments.inl"
#include "rendering/reference/integral/part_rules.inl"
#include "rendering/reference/integral/interval_rules.inl"
#include "rendering/reference/integral/ray_rules.inl"
// clang-format on
#endif

#if HWY_TARGET != HWY_SCALAR
/// Leaves out what all rays of a group miss: with small blobs that is a good part of the packet.
/// @return the blobs of the group, those of `io`
template <class V, class T>
const typename RayPacket<T>::Shared* keepMet(const PacketJob<T>& job, GroupInput<T>& io)
{
    constexpr uint32_t kWidth = Lanes<V>::kWidth;
    const auto* const shared = job.packet.shared.data();
    if constexpr (kWidth == kPacketRays)
        return shared;
    const V zero = Lanes<V>::all(T(0));
    T* const center = job.met.center.room(size_t(io.count) * kWidth);
    T* const chord2 = job.met.chord2.room(size_t(io.count) * kWidth);
    job.met.shared.resize(io.count);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < io.count; ++i) {
        const V chord = Lanes<V>::load(io.chord2 + size_t(i) * io.stride);
        Lanes<V>::store(chord2 + size_t(kept) * kWidth, chord);
        Lanes<V>::store(center + size_t(kept) * kWidth, Lanes<V>::load(io.center + size_t(i) * io.stride));
        job.met.shared[kept] = shared[i];
        kept += anyLess(zero, chord) ? 1u : 0u;
    }
    io.count = kept;
    io.stride = kWidth;
    io.center = center;
    io.chord2 = chord2;
    return job.met.shared.data();
}
#endif

/// All groups of a packet, as many rays at once as the instruction set has lanes.
template <class T>
void integratePacket(const PacketJob<T>& job)
{
#if HWY_TARGET == HWY_SCALAR
    integrateOneByOne(job);
#else
    using V = Pack<T>;
    const T largest = largestRadius(job.packet);
    const T brightest = brightestSource(job.packet);
    for (uint32_t lane = 0; lane < kPacketRays; lane += V::kWidth) {
        GroupInput<T> input = inputOf(job, lane, largest, brightest);
        const auto* const shared = keepMet<V>(job, input);
        integrateAny<V>(job.rules, job.scratch, input, shared, job.work, outputOf(job, lane));
    }
#endif
}

/// @formula ray-ball-approach
/// Where a ray comes nearest to the center of a ball, and the square of half its chord.
///
/// symbol   unit   meaning
///   o, d    m, 1   origin and unit direction of the ray
///   c, R    m      center and radius of the ball
///   t       m      ray parameter of the nearest point
///   p       m      vector from that point to the center
///   H       m2     square of half the chord; <= 0 where the ray misses
/// @derivation
///   t = (c - o) . d                                        (1)
///   p = (c - o) - t d                                      (2)
///   H = R^2 - p . p                                        (3)
/// @source    [HAG19] on precise ray-sphere intersection, for taking p instead of |c - o|^2 - t^2
/// @deviation none
/// @valid     |d| = 1 within rounding: an error e of the length changes H by e^2 t^2
/// @accuracy  error of H at most 8 eps (R |c - o| + R^2): that of rounding the place of the ball
/// @tests     tests/rendering/reference/integral/test_ray_packet.cpp
template <class T>
uint64_t meetBallsOf(const MeetJob<T>& job)
{
    using V = Pack<T>;
    uint64_t hits = 0;
    const V zero = Lanes<V>::all(T(0));
    alignas(64) T centers[kPacketRays], chords[kPacketRays];
    for (const uint32_t candidate : job.candidates) {
        const BallBlob<T>& ball = job.balls[candidate];
        const T radius2 = ball.radius * ball.radius;
        uint32_t met = 0;
        for (uint32_t lane = 0; lane < kPacketRays; lane += V::kWidth) {
            V to[3], along[3];
            for (int a = 0; a < 3; ++a) {
                to[a] = Lanes<V>::all(ball.center[a]) - Lanes<V>::load(job.rays.origin[a] + lane);
                along[a] = Lanes<V>::load(job.rays.direction[a] + lane);
            }
            const V t = to[0] * along[0] + to[1] * along[1] + to[2] * along[2]; // (1)
            V distance2 = zero;
            for (int a = 0; a < 3; ++a) {
                const V p = to[a] - t * along[a]; // (2)
                distance2 = distance2 + p * p;
            }
            const V chord2 = Lanes<V>::all(radius2) - distance2; // (3)
            met += countLess(zero, chord2);
            Lanes<V>::store(centers + lane, t);
            Lanes<V>::store(chords + lane, chord2);
        }
        if (met == 0)
            continue;
        hits += met;
        const size_t place = job.packet.add(
            {ball.radius, ball.extinction, {ball.source[0], ball.source[1], ball.source[2]}, candidate});
        std::copy_n(centers, kPacketRays, job.packet.center.data() + place * kPacketRays);
        std::copy_n(chords, kPacketRays, job.packet.chord2.data() + place * kPacketRays);
    }
    return hits;
}

namespace {

FX_KERNEL_INSTANCES(void, integratePacket, PacketJob)
FX_KERNEL_INSTANCES(uint64_t, meetBallsOf, MeetJob)

} // namespace
} // namespace fx::render::integral::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::render::integral {

FX_KERNEL_DISPATCH(void, integrateRays, integratePacket, PacketJob)
FX_KERNEL_DISPATCH(uint64_t, meetRays, meetBallsOf, MeetJob)

} // namespace fx::render::integral
#endif
