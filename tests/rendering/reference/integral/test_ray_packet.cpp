#include "ray_cases.h"
#include "rendering/reference/integral/ray_packet.h"
#include "tests/foundation/every_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace fx::render {
namespace {

using base::InstructionSet;

/// 16 rays that differ: some blobs are missed by some of them, windows cut some.
template <class T>
struct Bundle
{
    PacketRays<T> rays{};
    RayPacket<T> packet;

    Bundle(uint32_t blobs, double opticalDepth, uint64_t seed)
    {
        Draw draw(seed);
        const std::vector<RayBlob<double>> own = randomRay(std::max(1u, blobs), opticalDepth, seed);
        for (uint32_t k = 0; k < blobs; ++k) {
            const RayBlob<double>& b = own[k];
            const size_t place = packet.add(
                {T(b.radius), T(b.extinction), {T(b.source[0]), T(b.source[1]), T(b.source[2])}, b.id});
            for (uint32_t i = 0; i < kPacketRays; ++i) {
                packet.center[place * kPacketRays + i] = T(float(b.center + draw.between(-0.02, 0.02)));
                packet.chord2[place * kPacketRays + i] = T(float(b.chord2 * draw.between(-0.2, 1.0)));
            }
        }
        for (uint32_t i = 0; i < kPacketRays; ++i) {
            rays.nearest[i] = i % 3 == 0 ? T(4) : T(-5);
            rays.farthest[i] = i % 4 == 1 ? T(9) : std::numeric_limits<T>::infinity();
            for (int c = 0; c < 3; ++c)
                rays.background[c][i] = T(float(draw.next()));
        }
    }
    RayLight<T> alone(const IntegralSettings& settings, uint32_t lane) const
    {
        std::vector<RayBlob<T>> blobs;
        for (size_t k = 0; k < packet.shared.size(); ++k) {
            const auto& own = packet.shared[k];
            blobs.push_back({packet.center[k * kPacketRays + lane],
                             packet.chord2[k * kPacketRays + lane],
                             own.radius,
                             own.extinction,
                             {own.source[0], own.source[1], own.source[2]},
                             own.id});
        }
        return integrate<T>(settings, blobs,
                            {rays.nearest[lane],
                             rays.farthest[lane],
                             {rays.background[0][lane], rays.background[1][lane], rays.background[2][lane]}});
    }
};

template <class T>
void expectLanesEqualRays(const IntegralSettings& settings, const Bundle<T>& bundle, const char* name)
{
    PacketLight<T> light;
    PacketIntegrator<T> integrator(settings);
    integrator.integrate(bundle.rays, bundle.packet, light);
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        const RayLight<T> alone = bundle.alone(settings, i);
        for (size_t c = 0; c < 3; ++c)
            ASSERT_EQ(std::memcmp(&light.radiance[c][i], &alone.radiance[c], sizeof(T)), 0)
                << name << " lane " << i << ": " << light.radiance[c][i] << " and " << alone.radiance[c];
        ASSERT_EQ(light.opticalDepth[i], alone.opticalDepth) << name << " lane " << i;
        ASSERT_EQ(light.transmittance[i], alone.transmittance) << name << " lane " << i;
        ASSERT_EQ(light.flags[i], alone.flags) << name << " lane " << i;
    }
}

TEST(RayPacket, givesEveryRayTheBitsItHasAloneWithEveryInstructionSet)
{
    test::everySet([](InstructionSet) {
        for (const uint32_t blobs : {0u, 1u, 5u, 16u, 70u, 300u})
            for (const double depth : {0.3, 8.0, 500.0}) {
                expectLanesEqualRays(settingsOf("gauss-5"), Bundle<float>(blobs, depth, blobs),
                                     "gauss-5 float");
                expectLanesEqualRays(settingsOf("gauss-5"), Bundle<double>(blobs, depth, blobs),
                                     "gauss-5 double");
            }
    });
}

TEST(RayPacket, doesSoForEverySchemeKernelAndModel)
{
    test::everySet([](InstructionSet) {
        for (const char* name : {"paper-1", "paper-4", "simpson-2", "gauss-3", "gauss-8", "gauss-8-cap-0.1",
                                 "positive-8", "march-0.1", "adaptive-0.001"})
            for (const uint32_t degree : {2u, 3u, 4u})
                for (const SourceModel model : {SourceModel::PerBlob, SourceModel::Product}) {
                    expectLanesEqualRays(settingsOf(name, degree, model), Bundle<float>(11, 20.0, 5), name);
                    expectLanesEqualRays(settingsOf(name, degree, model), Bundle<double>(11, 20.0, 5), name);
                }
        expectLanesEqualRays(settingsOf("gauss-5"), Bundle<float>(7, 1e6, 5), "beyond 64 parts");
        expectLanesEqualRays(settingsOf("gauss-5"), Bundle<double>(7, 1e6, 5), "beyond 64 parts");
    });
}

TEST(RayPacket, leavesOutSmallBlobsOnlyInLanesThatMeetThem)
{
    Bundle<float> bundle(9, 2.0, 6);
    bundle.packet.shared[3].radius *= 1e-9f;
    bundle.packet.shared[5].radius *= 1e-3f; // degree 4: near the limit of the ratio
    for (uint32_t i = 0; i < kPacketRays; ++i)
        for (const size_t k : {size_t(3), size_t(5)})
            bundle.packet.chord2[k * kPacketRays + i] *= k == 3 ? 1e-18f : 1e-6f;
    for (const char* name : {"gauss-5", "positive-8", "adaptive-0.001", "march-0.1"})
        for (const uint32_t degree : {2u, 3u, 4u})
            expectLanesEqualRays(settingsOf(name, degree), bundle, name);
    PacketLight<float> light;
    PacketIntegrator<float>(settingsOf("gauss-5")).integrate(bundle.rays, bundle.packet, light);
    uint32_t flagged = 0;
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        const bool isMet = bundle.packet.chord2[3 * kPacketRays + i] > 0.0f;
        EXPECT_EQ((light.flags[i] & kRayTooSmall) != 0u, isMet) << i;
        flagged += isMet ? 1 : 0;
    }
    EXPECT_GT(flagged, 0u);
    EXPECT_LT(flagged, kPacketRays);
}

/// Rays of which some end where others go on, with blobs that touch windows and each other.
template <class T>
Bundle<T> harshBundle(uint64_t seed)
{
    Draw draw(seed);
    const auto blobs = uint32_t(std::pow(10.0, draw.between(0.0, 2.5)));
    Bundle<T> bundle(blobs, std::pow(10.0, draw.between(-6.0, 6.0)), seed);
    const double spread = draw.between(0.0, 12.0), offset = std::pow(10.0, draw.between(-4.0, 0.5));
    for (size_t k = 0; k < bundle.packet.shared.size(); ++k) {
        const double size = std::exp2(-spread * draw.next());
        bundle.packet.shared[k].radius *= T(float(size));
        for (size_t i = k * kPacketRays; i < (k + 1) * kPacketRays; ++i) {
            bundle.packet.center[i] =
                T(float(double(bundle.packet.center[i]) + draw.between(-offset, offset)));
            bundle.packet.chord2[i] *= T(float(size * size));
        }
    }
    return bundle;
}

TEST(RayPacket, doesSoForHarshRaysOfEveryKind)
{
    constexpr const char* kNames[] = {"gauss-5",        "gauss-8",        "gauss-3",    "paper-1",
                                      "paper-4",        "simpson-2",      "positive-8", "march-0.1",
                                      "adaptive-0.001", "gauss-8-cap-0.1"};
    const uint64_t sets = uint64_t(base::instructionSet()) + 1; // each takes its part of the seeds
    test::everySet([&](InstructionSet set) {
        for (uint64_t seed = 1; seed <= 120; ++seed) {
            if (seed % sets != uint64_t(set))
                continue;
            const char* name = kNames[seed % 10];
            const SourceModel model = seed % 3 == 0 ? SourceModel::Product : SourceModel::PerBlob;
            const IntegralSettings settings = settingsOf(name, 2 + uint32_t(seed / 10) % 3, model);
            expectLanesEqualRays(settings, harshBundle<float>(seed), name);
            expectLanesEqualRays(settings, harshBundle<double>(seed), name);
        }
    });
}

TEST(RayPacket, doesSoWhereBlobsTouch)
{
    // By rounding the first blob may reach beyond its end, where the second one has next to nothing;
    // neighboring lanes must not decide whether that counts.
    for (uint64_t seed = 1; seed <= 40; ++seed) {
        Bundle<float> bundle(2, 2.0, seed);
        Draw draw(seed);
        float* center = bundle.packet.center.data();
        float* chord2 = bundle.packet.chord2.data();
        for (uint32_t i = 0; i < kPacketRays; ++i) {
            const auto first = float(draw.between(0.1, 1.0)), second = float(draw.between(0.1, 1.0));
            chord2[i] = first * first;
            chord2[i + kPacketRays] = second * second;
            center[i] = float(draw.between(5.0, 6.0));
            center[i + kPacketRays] = center[i] + std::sqrt(chord2[i]) + std::sqrt(chord2[i + kPacketRays]);
        }
        for (const char* name : {"positive-8", "positive-2", "gauss-5", "paper-4", "march-0.1"})
            expectLanesEqualRays(settingsOf(name), bundle, name);
    }
}

TEST(RayPacket, doesSoForRaysThatMissSmallBlobsFarAway)
{
    // 35000 radii to the eighth are beyond a float.
    for (const uint32_t degree : {2u, 3u, 4u}) {
        Bundle<float> bundle(2, 1.0, 7);
        for (uint32_t i = 0; i < kPacketRays; ++i)
            for (const size_t k : {size_t(0), size_t(1)}) {
                bundle.packet.shared[k].radius = 1e-4f;
                bundle.packet.center[k * kPacketRays + i] = k == 0 ? 2.0f : 12.0f;
                bundle.packet.chord2[k * kPacketRays + i] = (i + k) % 3 == 0 ? 5e-9f : -1e-9f;
            }
        expectLanesEqualRays(settingsOf("gauss-5", degree), bundle, "far");
    }
}

TEST(RayPacket, wouldNotHaveTheBitsOfAScalarWithFusedOperations)
{
    int different = 0;
    for (int i = 0; i < 1000; ++i) {
        const float r = -0.3f + 0.0006f * float(i);
        float sum = integral::kPerFactorial<float>[7];
        for (int k = 6; k >= 0; --k)
            sum = std::fma(sum, r, integral::kPerFactorial<float>[size_t(k)]);
        different += sum != integral::expSeries(r) ? 1 : 0;
    }
    EXPECT_GT(different, 20);
}

TEST(RayPacket, inFloatIsTheDoubleSchemeWithinRounding)
{
    for (const double depth : {0.1, 1.0, 10.0, 100.0})
        for (uint64_t seed = 0; seed < 10; ++seed) {
            const Bundle<float> bundle(12, depth, seed);
            const Bundle<double> same(12, depth, seed);
            PacketLight<float> light;
            PacketLight<double> exact;
            PacketIntegrator<float>(settingsOf("gauss-5")).integrate(bundle.rays, bundle.packet, light);
            PacketIntegrator<double>(settingsOf("gauss-5")).integrate(same.rays, same.packet, exact);
            for (uint32_t i = 0; i < kPacketRays; ++i)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(double(light.radiance[c][i]) / exact.radiance[c][i], 1.0, 1e-5) << depth;
        }
}

TEST(RayPacket, countsTheWorkOfAllItsRays)
{
    const Bundle<float> bundle(20, 2.0, 3);
    PacketIntegrator<float> integrator(settingsOf("gauss-5"));
    PacketLight<float> light;
    integrator.integrate(bundle.rays, bundle.packet, light);
    EXPECT_EQ(integrator.work().rays, 0u); // off unless asked for
    integrator.countWork(true);
    integrator.integrate(bundle.rays, bundle.packet, light);
    RayIntegrator<float> single(settingsOf("gauss-5"));
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        std::vector<RayBlob<float>> blobs;
        for (size_t k = 0; k < bundle.packet.shared.size(); ++k) {
            const auto& own = bundle.packet.shared[k];
            blobs.push_back({bundle.packet.center[k * kPacketRays + i],
                             bundle.packet.chord2[k * kPacketRays + i],
                             own.radius,
                             own.extinction,
                             {own.source[0], own.source[1], own.source[2]},
                             own.id});
        }
        single.integrate(blobs, {bundle.rays.nearest[i], bundle.rays.farthest[i], {0.0f, 0.0f, 0.0f}});
    }
    EXPECT_EQ(integrator.work().rays, kPacketRays);
    EXPECT_EQ(integrator.work().hits, single.work().hits);
    EXPECT_EQ(integrator.work().blobSums, single.work().blobSums);
    EXPECT_EQ(integrator.work().nodes, single.work().nodes);
}

TEST(MeetBlobs, keepsOnlyWhatSomeRayMeetsInTheOrderOfItsCandidates)
{
    PacketRays<float> rays{};
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        rays.origin[0][i] = 0.1f * float(i);
        rays.direction[2][i] = 1.0f;
    }
    const std::vector<BallBlob<float>> balls = {{{0.0f, 0.0f, 5.0f}, 0.05f, 1.0f, {1.0f, 2.0f, 3.0f}},
                                                {{0.0f, 9.0f, 5.0f}, 1.0f, 1.0f, {1.0f, 1.0f, 1.0f}},
                                                {{0.75f, 0.0f, -2.0f}, 1.0f, 0.5f, {1.0f, 1.0f, 1.0f}}};
    const std::vector<uint32_t> candidates = {0, 1, 2};
    RayPacket<float> packet;
    EXPECT_EQ(meetBlobs<float>(rays, balls, candidates, packet), 17u);
    ASSERT_EQ(packet.shared.size(), 2u);
    EXPECT_EQ(packet.shared[0].id, 0u);
    EXPECT_EQ(packet.shared[0].source[2], 3.0f);
    EXPECT_EQ(packet.shared[1].id, 2u);
    EXPECT_EQ(packet.center[0], 5.0f);
    EXPECT_EQ(packet.center[kPacketRays], -2.0f);
    EXPECT_FLOAT_EQ(packet.chord2[0], 0.0025f);
    EXPECT_LT(packet.chord2[1], 0.0f);
    EXPECT_FLOAT_EQ(packet.chord2[kPacketRays], 1.0f - 0.5625f);
}

} // namespace
} // namespace fx::render
