// Blobs of any size beside each other and of any optical depth: results stay numbers.
#include "ray_cases.h"
#include "rendering/reference/integral/ray_packet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace fx::render {
namespace {

constexpr const char* kSchemes[] = {"gauss-3",    "gauss-5",       "gauss-8",   "gauss-5-cap-inf",
                                    "paper-1",    "paper-4",       "simpson-4", "positive-4",
                                    "march-0.01", "adaptive-0.001"};
constexpr SourceModel kModels[] = {SourceModel::PerBlob, SourceModel::Product};

/// A number of T, however large.
template <class T>
T asNumber(double x)
{
    return static_cast<T>(std::min(x, double(std::numeric_limits<T>::max())));
}

/// A blob of radius 1 and another of radius `ratio`, each with this optical depth, in any unit of length.
template <class T>
std::vector<RayBlob<T>> twoBlobs(double ratio, double opticalDepth, double light, double unit = 1.0)
{
    std::vector<RayBlob<T>> blobs;
    for (const double radius : {unit, ratio * unit}) {
        const auto id = uint32_t(blobs.size());
        blobs.push_back({static_cast<T>(0.3 * unit * id),
                         static_cast<T>(0.8 * radius * radius),
                         static_cast<T>(radius),
                         asNumber<T>(opticalDepth / radius),
                         {asNumber<T>(light), T(0), asNumber<T>(0.25 * light)},
                         id});
    }
    return blobs;
}

template <class T>
bool isSound(const RayLight<T>& light)
{
    bool isSound = light.transmittance >= T(0) && light.transmittance <= T(1) &&
                   std::isfinite(light.opticalDepth) && light.opticalDepth >= T(0);
    for (const T channel : light.radiance)
        isSound = isSound && std::isfinite(channel) && channel >= T(0);
    return isSound;
}

template <class T>
void sweep(const char* scheme, uint32_t degree, SourceModel model)
{
    for (int size = -12; size <= 12; ++size)
        for (int depth = -6; depth <= 30; depth += 3)
            for (const double light : {1.0, 1e12, 1e38}) {
                const double ratio = std::pow(10.0, size);
                IntegralSettings settings = settingsOf(scheme, degree, model);
                settings.scheme.step = 0.01 * std::max(1.0, ratio); // marching stays affordable
                RayWindow<T> window{T(-1e15), static_cast<T>(kInfinity), {T(1), T(1), T(0)}};
                const std::vector<RayBlob<T>> blobs = twoBlobs<T>(ratio, std::pow(10.0, depth), light);
                const RayLight<T> got = integrate(settings, blobs, window);
                ASSERT_TRUE(isSound(got))
                    << scheme << " degree " << degree << " model " << int(model) << " ratio 1e" << size
                    << " depth 1e" << depth << " light " << light << ": " << double(got.radiance[0]) << " "
                    << double(got.radiance[2]) << " T " << double(got.transmittance) << " depth "
                    << double(got.opticalDepth);
                ASSERT_EQ(got.flags & kRayInvalid, 0u);
            }
}

TEST(NumberRange, isNotLeftByBlobsOfAnySizeAndOpticalDepthInFloat)
{
    for (const char* scheme : kSchemes)
        for (const uint32_t degree : {2u, 3u, 4u})
            for (const SourceModel model : kModels)
                sweep<float>(scheme, degree, model);
}

TEST(NumberRange, isNotLeftByBlobsOfAnySizeAndOpticalDepthInDouble)
{
    for (const char* scheme : kSchemes)
        for (const uint32_t degree : {2u, 3u, 4u})
            for (const SourceModel model : kModels)
                sweep<double>(scheme, degree, model);
}

TEST(NumberRange, isLeftByWeightsOfWhichExtinctionIsNotBounded)
{
    // What is multiplied with powers of lengths: extinction / radius^(2 degree), in units of the largest.
    int left = 0;
    for (const double ratio : {1e-3, 1e-4, 1e-5, 1.1e-6})
        for (const double depth : {1.0, 1e4, 1e8, 1e16, 1e30}) {
            const RayBlob<float> blob = twoBlobs<float>(ratio, depth, 1.0)[1];
            const float radius2 = blob.radius * blob.radius;
            const float weight = blob.extinction * (1.0f / radius2) * (1.0f / radius2);
            left += std::isfinite(weight * (blob.chord2 * blob.chord2)) ? 0 : 1;
            // infinity times the 0 of a place outside has no value
            EXPECT_TRUE(std::isfinite(weight) || std::isnan(weight * 0.0f));
        }
    EXPECT_GT(left, 5);
}

TEST(NumberRange, makesASmallDenseBlobNeitherTransparentNorDark)
{
    for (const char* scheme : {"gauss-5", "gauss-8", "positive-4"})
        for (const double ratio : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 2e-6})
            for (const double depth : {1e2, 1e4, 1e8, 1e16, 1e30})
                for (const double light : {1.0, 1e12}) {
                    const RayLight<float> got =
                        integrate(settingsOf(scheme), twoBlobs<float>(ratio, depth, light));
                    EXPECT_LT(got.transmittance, 1e-13f) << scheme << " " << ratio << " " << depth;
                    EXPECT_NEAR(double(got.radiance[0]) / light, 1.0, 5e-3)
                        << scheme << " " << ratio << " " << depth;
                }
}

TEST(NumberRange, isNotLeftByPlacesThatAreFarInUnitsOfTheRadius)
{
    for (const double unit : {1e-150, 1e-140, 1e-100, 1e-15, 1.0})
        for (const char* scheme : kSchemes)
            for (const uint32_t degree : {2u, 3u, 4u}) {
                std::vector<RayBlob<double>> blobs = twoBlobs<double>(0.5, 1e30, 1e12, unit);
                blobs[1].center = 1e12;
                RayWindow<double> window = openWindow<double>();
                window.nearest = -2.0 * unit;
                EXPECT_TRUE(isSound(integrate(settingsOf(scheme, degree), blobs, window)))
                    << unit << " " << scheme;
            }
}

/// Lanes that see the blobs cut, missed and whole.
template <class T>
void expectPacketsLikeRays(const char* scheme, uint32_t degree, SourceModel model, double ratio, double depth)
{
    const std::vector<RayBlob<T>> blobs = twoBlobs<T>(ratio, depth, 1e12);
    IntegralSettings settings = settingsOf(scheme, degree, model);
    settings.scheme.step = 0.01 * std::max(1.0, ratio);
    PacketRays<T> rays{};
    RayPacket<T> packet;
    for (const RayBlob<T>& b : blobs)
        packet.add({b.radius, b.extinction, {b.source[0], b.source[1], b.source[2]}, b.id});
    std::vector<std::vector<RayBlob<T>>> alone(kPacketRays, blobs);
    std::vector<RayWindow<T>> windows(kPacketRays, openWindow<T>());
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        for (size_t k = 0; k < blobs.size(); ++k) {
            alone[i][k].chord2 *= T(1.1f) - T(0.08f) * T(i);
            packet.center[k * kPacketRays + i] = blobs[k].center;
            packet.chord2[k * kPacketRays + i] = alone[i][k].chord2;
        }
        windows[i].nearest = rays.nearest[i] = i % 5 == 0 ? T(0) : T(-10);
        windows[i].farthest = rays.farthest[i] = static_cast<T>(kInfinity);
    }
    PacketLight<T> light;
    PacketIntegrator<T>(settings).integrate(rays, packet, light);
    for (uint32_t i = 0; i < kPacketRays; ++i) {
        const RayLight<T> expected = integrate(settings, alone[i], windows[i]);
        for (size_t c = 0; c < 3; ++c)
            ASSERT_EQ(std::memcmp(&light.radiance[c][i], &expected.radiance[c], sizeof(T)), 0)
                << scheme << " " << degree << " " << ratio << " " << depth << " lane " << i;
        ASSERT_EQ(light.opticalDepth[i], expected.opticalDepth) << scheme << " " << ratio << " " << depth;
    }
}

TEST(NumberRange, endsAlikeForPacketsAndRays)
{
    for (const char* scheme : kSchemes)
        for (const uint32_t degree : {2u, 3u, 4u})
            for (const SourceModel model : kModels)
                for (const double ratio : {1e-12, 2e-6, 1e-3, 1.0, 1e3, 1e6})
                    for (const double depth : {1e-6, 1.0, 1e4, 1e16, 1e30}) {
                        expectPacketsLikeRays<float>(scheme, degree, model, ratio, depth);
                        expectPacketsLikeRays<double>(scheme, degree, model, ratio, depth);
                    }
}

} // namespace
} // namespace fx::render
