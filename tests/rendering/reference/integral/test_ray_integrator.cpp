#include "ray_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace fx::render {
namespace {

template <class T>
bool sameBits(const RayLight<T>& a, const RayLight<T>& b)
{
    return std::memcmp(a.radiance.data(), b.radiance.data(), sizeof(a.radiance)) == 0 &&
           std::memcmp(&a.opticalDepth, &b.opticalDepth, sizeof(T)) == 0 &&
           std::memcmp(&a.transmittance, &b.transmittance, sizeof(T)) == 0 && a.flags == b.flags;
}

TEST(RayIntegrator, ofNoBlobsIsTheBackground)
{
    const RayWindow<float> window{0.0f, std::numeric_limits<float>::infinity(), {1.0f, 2.0f, 3.0f}};
    const RayLight<float> light = integrate<float>(settingsOf("gauss-5"), {}, window);
    EXPECT_EQ(light.radiance, (std::array<float, 3>{1.0f, 2.0f, 3.0f}));
    EXPECT_EQ(light.transmittance, 1.0f);
    EXPECT_EQ(light.opticalDepth, 0.0f);
    EXPECT_EQ(light.flags, 0u);
}

TEST(RayIntegrator, takesNothingFromBlobsWithoutALength)
{
    const std::vector<RayBlob<double>> blobs = {{1.0, 0.0, 0.5, 3.0, {1.0, 1.0, 1.0}, 0},
                                                {2.0, -1.0, 0.5, 3.0, {1.0, 1.0, 1.0}, 1},
                                                {3.0, 1e-320, 0.5, 3.0, {1.0, 1.0, 1.0}, 2},
                                                {3.0, 0.04, 1e-310, 3.0, {1.0, 1.0, 1.0}, 3}};
    for (const char* name : {"gauss-5", "paper-1", "positive-8", "march-0.1", "adaptive-0.01"}) {
        const RayLight<double> light = integrate<double>(settingsOf(name), {blobs[0], blobs[1], blobs[2]});
        EXPECT_EQ(light.radiance[0], 0.0) << name;
        EXPECT_EQ(light.opticalDepth, 0.0) << name;
    }
    // much smaller than its neighbor: left out, and said so
    const RayLight<double> light =
        integrate<double>(settingsOf("gauss-5"), {{3.0, 1.0, 1.0, 1.0, {1.0, 1.0, 1.0}, 0}, blobs[3]});
    EXPECT_NE(light.flags & kRayTooSmall, 0u);
    EXPECT_NEAR(light.opticalDepth, 16.0 / 15.0, 1e-14);
}

TEST(RayIntegrator, ofCoincidentBlobsIsThatOfTheirSum)
{
    for (const uint32_t count : {2u, 7u, 64u}) {
        std::vector<RayBlob<double>> many(count,
                                          RayBlob<double>{2.0, 0.5, 1.0, 3.0 / count, {0.5, 0.25, 1.0}, 0});
        for (uint32_t i = 0; i < count; ++i)
            many[i].id = i;
        const std::vector<RayBlob<double>> one = {{2.0, 0.5, 1.0, 3.0, {0.5, 0.25, 1.0}, 0}};
        const RayLight<double> a = integrate(settingsOf("gauss-5"), many),
                               b = integrate(settingsOf("gauss-5"), one);
        EXPECT_NEAR(a.radiance[0] / b.radiance[0], 1.0, 1e-14);
        EXPECT_NEAR(a.opticalDepth / b.opticalDepth, 1.0, 1e-14);
    }
}

TEST(RayIntegrator, doesNotCareForTheOrderOfItsBlobs)
{
    // Coincident blobs among others: all 720 orders of six.
    std::vector<RayBlob<float>> blobs = blobsAs<float>(randomRay(6, 3.0, 8));
    blobs[1].center = blobs[4].center;
    blobs[1].chord2 = blobs[4].chord2;
    for (const char* name : {"gauss-5", "gauss-8", "paper-4", "adaptive-0.001", "march-0.1", "positive-4"}) {
        const RayLight<float> expected = integrate(settingsOf(name), blobs);
        std::vector<RayBlob<float>> shuffled = blobs;
        const auto byId = [](const RayBlob<float>& a, const RayBlob<float>& b) { return a.id < b.id; };
        std::sort(shuffled.begin(), shuffled.end(), byId);
        do
            ASSERT_TRUE(sameBits(integrate(settingsOf(name), shuffled), expected)) << name;
        while (std::next_permutation(shuffled.begin(), shuffled.end(), byId));
    }
}

/// Coefficients of all blobs about the ray's origin, added at entries and subtracted at exits, in float: what
/// the paper describes, with stable moments.
double incrementalLight(const std::vector<RayBlob<double>>& blobs, double origin)
{
    struct Event
    {
        float t;
        size_t blob;
        bool isEntry;
    };
    std::vector<Event> events;
    for (size_t i = 0; i < blobs.size(); ++i) {
        const double half = std::sqrt(blobs[i].chord2);
        events.push_back({float(blobs[i].center - half + origin), i, true});
        events.push_back({float(blobs[i].center + half + origin), i, false});
    }
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.t < b.t; });
    float rho[5] = {}, source[5] = {}, light = 0.0f, depth = 0.0f;
    for (size_t k = 0; k + 1 < events.size(); ++k) {
        const RayBlob<double>& blob = blobs[events[k].blob];
        const float tc = float(blob.center + origin), h2 = float(blob.chord2), g0 = h2 - tc * tc,
                    g1 = 2.0f * tc;
        const float q[5] = {g0 * g0, 2.0f * g0 * g1, g1 * g1 - 2.0f * g0, -2.0f * g1, 1.0f};
        const float weight =
            float(blob.extinction / std::pow(blob.radius, 4)) * (events[k].isEntry ? 1.0f : -1.0f);
        for (int j = 0; j < 5; ++j) {
            rho[j] += weight * q[j];
            source[j] += weight * float(blob.source[0]) * q[j];
        }
        float p[5], s[5];
        std::copy_n(rho, 5, p);
        std::copy_n(source, 5, s);
        for (int a = 0; a < 4; ++a)
            for (int j = 3; j >= a; --j) {
                p[j] += events[k].t * p[j + 1];
                s[j] += events[k].t * s[j + 1];
            }
        const float length = events[k + 1].t - events[k].t;
        float own = 0.0f, power = length;
        for (int j = 0; j < 5; ++j, power *= length)
            own += p[j] * power / float(j + 1);
        float m[5];
        integral::attenuationMoments<float, 4>(std::max(own, 0.0f), m);
        power = length * std::exp(-depth);
        for (int j = 0; j < 5; ++j, power *= length)
            light += s[j] * power * m[j];
        depth += own;
    }
    return double(light);
}

TEST(RayIntegrator, keepsItsAccuracyForThousandsOfOverlappingBlobs)
{
    for (const uint32_t count : {1u, 8u, 64u, 512u})
        for (const double depth : {0.1, 1.0}) {
            const std::vector<RayBlob<double>> blobs = randomRay(count, depth, count);
            const RayLight<Quad> exact = integrate(settingsOf("gauss-5"), blobsAs<Quad>(blobs));
            const std::array<double, 3> expected = {double(exact.radiance[0]), double(exact.radiance[1]),
                                                    double(exact.radiance[2])};
            EXPECT_LT(worstError(integrate(settingsOf("gauss-5"), blobsAs<float>(blobs)), expected), 1e-5)
                << count;
            EXPECT_LT(worstError(integrate(settingsOf("gauss-5"), blobs), expected), 1e-13) << count;
        }
    for (const uint32_t count : {1024u, 4096u}) { // doubles are good enough by now
        const std::vector<RayBlob<double>> blobs = randomRay(count, 1.0, count);
        const std::array<double, 3> expected = integrate(settingsOf("gauss-5"), blobs).radiance;
        EXPECT_LT(worstError(integrate(settingsOf("gauss-5"), blobsAs<float>(blobs)), expected), 1e-5)
            << count;
    }
}

TEST(RayIntegrator, wouldLoseEverythingWithCoefficientsThatAreAddedAndSubtracted)
{
    const std::vector<RayBlob<double>> blobs = randomRay(64, 1.0, 64);
    const double expected = trueLight(blobs, {}, openWindow<double>(), 1e-9)[0];
    const double near = incrementalLight(blobs, 0.0), far = incrementalLight(blobs, 1000.0);
    EXPECT_FALSE(std::fabs(near / expected - 1.0) < 0.05);
    EXPECT_FALSE(std::fabs(far / expected - 1.0) < 10.0);
    // one blob from its own beginning is what the text of the paper had in mind
    const std::vector<RayBlob<double>> one = {{1.0, 1.0, 1.0, 0.5, {1.0, 1.0, 1.0}, 0}};
    EXPECT_NEAR(incrementalLight(one, 0.0) / trueLight(one)[0], 1.0, 0.02);
}

TEST(RayIntegrator, isContinuousWhenTheCameraEntersABlob)
{
    const double radius = 2.0, step = 1e-6 * radius;
    for (const char* name : {"gauss-5", "gauss-8", "paper-1", "simpson-4"}) {
        double last = -1.0;
        for (int i = -20; i <= 20; ++i) { // the entry is at 3
            RayWindow<double> window = openWindow<double>();
            window.nearest = 3.0 + i * step;
            const double light =
                integrate<double>(settingsOf(name), {{5.0, radius * radius, radius, 0.4, {1.0, 1.0, 1.0}, 0}},
                                  window)
                    .radiance[0];
            if (last >= 0.0) {
                EXPECT_NEAR(light, last, 1e-5) << name;
            }
            last = light;
        }
    }
}

TEST(RayIntegrator, fromWithinABlobSeesWhatIsBeforeTheCamera)
{
    for (const double depth : {0.1, 1.0, 20.0}) {
        RayWindow<double> window = openWindow<double>();
        window.nearest = 5.0;
        const std::vector<RayBlob<double>> blobs = {{5.0, 1.0, 1.0, depth * 15.0 / 16.0, {1.0, 1.0, 1.0}, 0},
                                                    {2.0, 1.0, 1.0, 5.0, {9.0, 9.0, 9.0}, 1}}; // behind it
        EXPECT_NEAR(integrate(settingsOf("gauss-8"), blobs, window).radiance[0], -std::expm1(-depth / 2.0),
                    2e-5);
        EXPECT_NEAR(integrate(settingsOf("gauss-8"), blobs, window).opticalDepth, depth / 2.0, 1e-12 * depth);
    }
}

TEST(RayIntegrator, cutByTheSceneIsTheSumOfItsPieces)
{
    const std::vector<RayBlob<double>> blobs = randomRay(12, 4.0, 21);
    std::vector<double> cuts;
    for (int i = 0; i < 1000; ++i)
        cuts.push_back(0.5 + 0.013 * i);
    for (const RayBlob<double>& blob : blobs)
        for (const double t : {blob.center - std::sqrt(blob.chord2), blob.center + std::sqrt(blob.chord2)})
            for (const double ulp : {std::nextafter(t, -kInfinity), t, std::nextafter(t, kInfinity)})
                cuts.push_back(ulp);
    for (const auto& [name, tolerance] :
         std::initializer_list<std::pair<const char*, double>>{{"gauss-5", 2e-3}, {"gauss-8", 1e-5}})
    {
        RayIntegrator<double> integrator(settingsOf(name));
        const RayLight<double> whole = integrator.integrate(blobs, openWindow<double>());
        for (const double cut : cuts) {
            RayWindow<double> front = openWindow<double>(), back = openWindow<double>();
            front.farthest = back.nearest = cut;
            const RayLight<double> a = integrator.integrate(blobs, front),
                                   b = integrator.integrate(blobs, back);
            EXPECT_NEAR(a.radiance[1] + a.transmittance * b.radiance[1], whole.radiance[1],
                        tolerance * whole.radiance[1])
                << name << ' ' << cut;
            EXPECT_NEAR(a.opticalDepth + b.opticalDepth, whole.opticalDepth, 1e-12);
        }
    }
}

TEST(RayIntegrator, doesNotDependOnTheUnitOfLength)
{
    const std::vector<RayBlob<double>> blobs = randomRay(8, 2.0, 4);
    for (const uint32_t degree : {2u, 3u, 4u}) {
        const RayLight<float> expected = integrate(settingsOf("gauss-5", degree), blobsAs<float>(blobs));
        for (double unit = 1e-12; unit < 2e12; unit *= 7.0) {
            const float scale = float(unit);
            std::vector<RayBlob<float>> scaled = blobsAs<float>(blobs);
            for (RayBlob<float>& blob : scaled) {
                blob.center *= scale;
                blob.chord2 *= scale * scale;
                blob.radius *= scale;
                blob.extinction /= scale;
            }
            RayWindow<float> window = openWindow<float>();
            window.nearest *= scale;
            const RayLight<float> light = integrate(settingsOf("gauss-5", degree), scaled, window);
            for (size_t c = 0; c < 3; ++c)
                EXPECT_NEAR(light.radiance[c] / expected.radiance[c], 1.0f, 4e-6f) << unit << ' ' << degree;
            EXPECT_EQ(light.flags, 0u);
        }
    }
}

TEST(RayIntegrator, hasTheSameBitsInUnitsThatArePowersOfTwo)
{
    const std::vector<RayBlob<float>> blobs = blobsAs<float>(randomRay(8, 2.0, 4));
    const RayLight<float> expected = integrate(settingsOf("gauss-5"), blobs);
    for (const int exponent : {-40, -7, 3, 40}) {
        std::vector<RayBlob<float>> scaled = blobs;
        for (RayBlob<float>& blob : scaled) {
            blob.center = std::ldexp(blob.center, exponent);
            blob.chord2 = std::ldexp(blob.chord2, 2 * exponent);
            blob.radius = std::ldexp(blob.radius, exponent);
            blob.extinction = std::ldexp(blob.extinction, -exponent);
        }
        RayWindow<float> window = openWindow<float>();
        window.nearest = std::ldexp(window.nearest, exponent);
        EXPECT_TRUE(sameBits(integrate(settingsOf("gauss-5"), scaled, window), expected)) << exponent;
    }
}

TEST(RayIntegrator, isFiniteForAnyExtinctionSoThatChannelsCanHaveTheirOwn)
{
    // Extinction is gray; a channel with its own is a call of its own: ratios of 10^-20 to 10^20, and 0.
    for (double ratio = 1e-20; ratio < 2e20; ratio *= 1e4) {
        std::vector<RayBlob<float>> blobs = blobsAs<float>(randomRay(6, 1.0, 3));
        for (RayBlob<float>& blob : blobs)
            blob.extinction = float(double(blob.extinction) * ratio);
        const RayLight<float> light = integrate(settingsOf("gauss-5"), blobs);
        for (const float channel : light.radiance) {
            EXPECT_TRUE(std::isfinite(channel)) << ratio;
            EXPECT_GE(channel, 0.0f);
        }
        EXPECT_GE(light.transmittance, 0.0f);
        EXPECT_LE(light.transmittance, 1.0f);
    }
    std::vector<RayBlob<float>> blobs = blobsAs<float>(randomRay(6, 1.0, 3));
    for (RayBlob<float>& blob : blobs)
        blob.extinction = 0.0f;
    EXPECT_EQ(integrate(settingsOf("gauss-5"), blobs).radiance[0], 0.0f);
}

TEST(RayIntegrator, leavesNoDenormalsBehindAndTheHostsModeAsItWas)
{
    // Transmittance is denormal between 87 and 103; light from there counts nothing and must not be waited
    // for.
    std::vector<RayBlob<float>> blobs;
    for (uint32_t i = 0; i < 40; ++i)
        blobs.push_back({float(i), 0.25f, 0.5f, 5.0f, {1.0f, 1.0f, 1.0f}, i});
    IntegralSettings going = settingsOf("gauss-5");
    going.scheme.stopDepth = kInfinity;
    const float denormal = std::numeric_limits<float>::denorm_min();
    volatile float before = denormal * 3.0f;
    const RayLight<float> light = integrate(going, blobs);
    EXPECT_EQ(light.radiance, integrate(settingsOf("gauss-5"), blobs).radiance);
    EXPECT_TRUE(light.transmittance == 0.0f || light.transmittance >= std::numeric_limits<float>::min());
    volatile float after = denormal * 3.0f;
    EXPECT_EQ(before, after);
    EXPECT_NE(after, 0.0f);
}

TEST(RayIntegrator, refusesWhatIsNotANumberOrHasTheWrongSign)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    const RayBlob<float> good{1.0f, 0.25f, 0.5f, 1.0f, {1.0f, 1.0f, 1.0f}, 0};
    const auto flagsOf = [](const RayBlob<float>& blob,
                            const RayWindow<float>& window = openWindow<float>()) {
        const RayLight<float> light = integrate<float>(settingsOf("gauss-5"), {blob}, window);
        if (light.flags & kRayInvalid) {
            EXPECT_EQ(light.radiance, (std::array<float, 3>{0.0f, 0.0f, 0.0f}));
            EXPECT_EQ(light.transmittance, 0.0f);
        }
        return light.flags;
    };
    EXPECT_EQ(flagsOf(good), 0u);
    for (const float bad : {nan, inf, -inf}) {
        RayBlob<float> blob = good;
        blob.center = bad;
        EXPECT_EQ(flagsOf(blob), kRayInvalid);
        blob = good;
        blob.chord2 = bad;
        EXPECT_EQ(flagsOf(blob), kRayInvalid);
    }
    for (const float bad : {nan, inf, -1.0f}) {
        RayBlob<float> blob = good;
        blob.radius = bad;
        EXPECT_EQ(flagsOf(blob), kRayInvalid);
        blob = good;
        blob.extinction = bad;
        EXPECT_EQ(flagsOf(blob), kRayInvalid);
        blob = good;
        blob.source[1] = bad;
        EXPECT_EQ(flagsOf(blob), kRayInvalid);
        RayWindow<float> window = openWindow<float>();
        window.background[2] = bad;
        EXPECT_EQ(flagsOf(good, window), kRayInvalid);
    }
    RayBlob<float> blob = good;
    blob.radius = 0.0f;
    EXPECT_EQ(flagsOf(blob), kRayInvalid);
    RayWindow<float> window = openWindow<float>();
    window.nearest = nan;
    EXPECT_EQ(flagsOf(good, window), kRayInvalid);
    window = openWindow<float>();
    window.farthest = nan;
    EXPECT_EQ(flagsOf(good, window), kRayInvalid);
    window = {5.0f, 1.0f, {1.0f, 1.0f, 1.0f}}; // ends before it begins: nothing but the background
    const RayLight<float> light = integrate<float>(settingsOf("gauss-5"), {good}, window);
    EXPECT_EQ(light.radiance[0], 1.0f);
}

TEST(RayIntegrator, countsItsWork)
{
    RayIntegrator<double> integrator(settingsOf("gauss-5"));
    const std::vector<RayBlob<double>> blobs = {{1.0, 1.0, 1.0, 0.1, {1.0, 1.0, 1.0}, 0},
                                                {1.5, 1.0, 1.0, 0.1, {1.0, 1.0, 1.0}, 1},
                                                {9.0, -1.0, 1.0, 0.1, {1.0, 1.0, 1.0}, 2}};
    integrator.integrate(blobs, openWindow<double>());
    const RayWork& work = integrator.work();
    EXPECT_EQ(work.rays, 1u);
    EXPECT_EQ(work.hits, 2u);
    EXPECT_EQ(work.intervals, 3u); // first alone, both, second alone
    EXPECT_EQ(work.blobSums, 4u);
    EXPECT_EQ(work.parts, 3u);
    EXPECT_EQ(work.nodes, 15u);
    integrator.clearWork();
    EXPECT_EQ(integrator.work().rays, 0u);
}

} // namespace
} // namespace fx::render
