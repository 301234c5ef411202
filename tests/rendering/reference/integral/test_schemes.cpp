#include "ray_cases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace fx::render {
namespace {

/// One blob looked at through its center, with light in proportion to its mass.
std::vector<RayBlob<double>> centralBlob(double opticalDepth)
{
    return {{3.0, 1.0, 1.0, opticalDepth * 15.0 / 16.0, {1.0, 0.5, 0.25}, 7}};
}

/// |I / I_true - 1| of one blob.
double blobError(std::string_view scheme, double opticalDepth)
{
    return std::fabs(integrate(settingsOf(scheme), centralBlob(opticalDepth)).radiance[0] /
                         -std::expm1(-opticalDepth) -
                     1.0);
}

double percentile99(const IntegralSettings& settings, double opticalDepth, uint32_t rays = 40)
{
    std::vector<double> errors;
    for (uint64_t seed = 0; seed < rays; ++seed) {
        const std::vector<RayBlob<double>> blobs = randomRay(8, opticalDepth, seed, settings.degree);
        errors.push_back(
            worstError(integrate(settings, blobs), trueLight(blobs, settings, openWindow<double>(), 1e-14)));
    }
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() * 99 / 100];
}

TEST(LinearAttenuation, errsWithTheSquareOfTheOpticalDepth)
{
    double lowest = 10.0, highest = 0.0;
    for (double depth = 0.01; depth < 0.6; depth *= 2.0) {
        const double slope = std::log2(blobError("paper-1", 2.0 * depth) / blobError("paper-1", depth));
        lowest = std::min(lowest, slope);
        highest = std::max(highest, slope);
        EXPECT_LE(blobError("paper-1", depth), depth * depth / 41.0); // 1/42 where it is thin, 0.018 at 1
    }
    EXPECT_GT(lowest, 1.9);
    EXPECT_LT(highest, 2.1);
}

TEST(LinearAttenuation, hasALawThatOtherErrorsDoNotFollow)
{
    // Simpson's error on a thin blob is that of the polynomial, whatever the optical depth.
    EXPECT_LT(std::log2(blobError("simpson-1", 0.02) / blobError("simpson-1", 0.01)), 0.5);
    EXPECT_LT(blobError("gauss-8", 1.0), 0.001 * blobError("paper-1", 1.0));
}

TEST(LinearAttenuation, isTheSameInTwoPartsOfASymmetricBlobAndBetterInFour)
{
    // The two halves err alike and in opposite directions, as the paper says of an isolated particle; furnace
    // light needs at least three parts.
    EXPECT_LT(blobError("paper-4", 1.0), 0.3 * blobError("paper-1", 1.0));
    EXPECT_LT(blobError("paper-16", 1.0), 0.08 * blobError("paper-4", 1.0));
}

TEST(LinearAttenuation, isExactInItsOpticalDepth)
{
    const std::vector<RayBlob<double>> blobs = randomRay(20, 3.0, 11);
    double depth = 0.0;
    for (const RayBlob<double>& blob : blobs)
        depth += fullDepth(blob);
    for (const char* name :
         {"paper-1", "paper-4", "gauss-5", "gauss-8", "simpson-4", "positive-8", "adaptive-0.0001"})
        EXPECT_NEAR(integrate(settingsOf(name), blobs).opticalDepth, depth, 1e-12) << name;
    EXPECT_NEAR(integrate(settingsOf("march-0.01"), blobs).opticalDepth, depth, 1e-3);
}

TEST(GaussAttenuation, gainsDigitsWithEveryNode)
{
    const double three = percentile99(settingsOf("gauss-3"), 1.0),
                 five = percentile99(settingsOf("gauss-5"), 1.0),
                 eight = percentile99(settingsOf("gauss-8"), 1.0);
    EXPECT_LT(three, 2e-3);
    EXPECT_LT(five, 1e-4);
    EXPECT_LT(eight, 1e-7);
    EXPECT_LT(five, 0.1 * three);
    EXPECT_LT(eight, 0.01 * five);
}

TEST(GaussAttenuation, isFarBetterThanLinearAttenuation)
{
    for (const double depth : {0.1, 1.0, 10.0, 100.0})
        EXPECT_GT(percentile99(settingsOf("paper-1"), depth),
                  100.0 * percentile99(settingsOf("gauss-5"), depth))
            << depth;
}

TEST(Schemes, allComeToTheSameLightWhenTheyAreRefined)
{
    for (const uint32_t degree : {2u, 3u, 4u})
        for (const SourceModel model : {SourceModel::PerBlob, SourceModel::Product})
            for (const auto& [name, tolerance] :
                 std::initializer_list<std::pair<const char*, double>>{{"paper-64", 1e-4},
                                                                       {"simpson-64", 2e-6},
                                                                       {"gauss-3-cap-0.5", 3e-3},
                                                                       {"gauss-5-cap-0.5", 1e-5},
                                                                       {"gauss-8-cap-0.5", 1e-8},
                                                                       {"positive-64", 1e-2},
                                                                       {"march-0.0003", 1e-5},
                                                                       {"adaptive-0.000001", 1e-4}})
            {
                const IntegralSettings settings = settingsOf(name, degree, model);
                const std::vector<RayBlob<double>> blobs = randomRay(6, 2.0, 3, degree);
                const std::array<double, 3> expected = trueLight(blobs, settings);
                EXPECT_LT(worstError(integrate(settings, blobs), expected), tolerance)
                    << name << " degree " << degree << " model " << int(model);
            }
}

TEST(Schemes, integrateThinPolynomialsExactly)
{
    // Without attenuation the integrand is the polynomial itself: degree 4 for blobs, 8 for products.
    const std::vector<RayBlob<double>> blobs = randomRay(6, 1e-13, 9);
    for (const char* name : {"paper-1", "gauss-3", "gauss-5", "gauss-8"})
        EXPECT_LT(worstError(integrate(settingsOf(name), blobs), trueLight(blobs)), 1e-11) << name;
    const IntegralSettings product = settingsOf("gauss-5", 2, SourceModel::Product);
    EXPECT_LT(worstError(integrate(product, blobs), trueLight(blobs, product)), 1e-11);
    const IntegralSettings tooFew = settingsOf("gauss-3", 2, SourceModel::Product);
    EXPECT_GT(worstError(integrate(tooFew, blobs), trueLight(blobs, tooFew)), 1e-6);
}

TEST(AdaptiveSplitting, keepsItsTolerance)
{
    for (const double tolerance : {1e-2, 1e-3, 1e-4})
        for (const double depth : {0.1, 1.0, 3.0})
            for (uint64_t seed = 0; seed < 20; ++seed) {
                IntegralSettings settings = settingsOf("adaptive-1");
                settings.scheme.tolerance = tolerance;
                const std::vector<RayBlob<double>> blobs = randomRay(8, depth, seed);
                double bound = 0.0; // light without any attenuation is at least F_0
                for (const RayBlob<double>& blob : blobs)
                    bound += fullDepth(blob) * *std::max_element(blob.source.begin(), blob.source.end());
                const std::array<double, 3> expected = trueLight(blobs, {}, openWindow<double>(), 1e-12);
                const RayLight<double> light = integrate(settings, blobs);
                for (size_t c = 0; c < 3; ++c)
                    EXPECT_NEAR(light.radiance[c], expected[c], 2.0 * tolerance * bound) << depth;
            }
}

TEST(AdaptiveSplitting, doesNotEndBeforeABrightLightThatComesFromBehind)
{
    // Dense smoke before a blob a million times brighter: transmittance alone would say that all is seen.
    const std::vector<RayBlob<double>> blobs = {{1.0, 1.0, 1.0, 10.0, {1e-6, 1e-6, 1e-6}, 0},
                                                {4.0, 1.0, 1.0, 1.0, {1e6, 1e6, 1e6}, 1}};
    const std::array<double, 3> expected = trueLight(blobs);
    EXPECT_LT(worstError(integrate(settingsOf("adaptive-0.001"), blobs), expected), 0.01);
    RayIntegrator<double> integrator(settingsOf("adaptive-0.001"));
    std::vector<RayBlob<double>> turned = blobs;
    std::swap(turned[0].center, turned[1].center);
    integrator.integrate(turned, openWindow<double>());
    const uint64_t parts = integrator.work().parts;
    integrator.clearWork();
    integrator.integrate(blobs, openWindow<double>());
    EXPECT_LT(parts, integrator.work().parts); // with the light in front the smoke behind does not matter
}

TEST(PositiveScheme, neverLeavesTheRangeOfTheSources)
{
    for (const double depth : {0.01, 1.0, 100.0, 1e6})
        for (uint64_t seed = 0; seed < 20; ++seed) {
            const std::vector<RayBlob<double>> blobs = randomRay(8, depth, seed);
            double most = 0.0, least = 1.0;
            for (const RayBlob<double>& blob : blobs) {
                most = std::max(most, blob.source[0]);
                least = std::min(least, blob.source[0]);
            }
            const RayLight<double> light = integrate(settingsOf("positive-4"), blobs);
            const double opacity = -std::expm1(-light.opticalDepth);
            EXPECT_LE(light.radiance[0], most * opacity * (1.0 + 1e-12));
            EXPECT_GE(light.radiance[0], least * opacity * (1.0 - 1e-12));
        }
}

TEST(MarchingScheme, errsWithTheSquareOfItsStep)
{
    double coarse = 0.0, fine = 0.0;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        const std::vector<RayBlob<double>> blobs = randomRay(8, 2.0, seed);
        const std::array<double, 3> expected = trueLight(blobs, {}, openWindow<double>(), 1e-12);
        coarse += worstError(integrate(settingsOf("march-0.04"), blobs), expected);
        fine += worstError(integrate(settingsOf("march-0.01"), blobs), expected);
    }
    EXPECT_LT(fine, 0.15 * coarse);
}

TEST(SchemeNames, areReadAndWrittenAlike)
{
    for (const std::string& name : comparedSchemes()) {
        const base::Result<IntegralScheme> scheme = parseScheme(name);
        ASSERT_TRUE(scheme.ok()) << name;
        EXPECT_EQ(schemeName(*scheme), name);
    }
    EXPECT_EQ(schemeName(defaultScheme()), "gauss-5");
    EXPECT_EQ(schemeName(highScheme()), "gauss-8");
    EXPECT_EQ(schemeName(*parseScheme("gauss-5-cap-inf")), "gauss-5-cap-inf");
    EXPECT_EQ(parseScheme("gauss-5")->cap, 1.0);
    EXPECT_EQ(parseScheme("gauss-8")->cap, 2.0);
    EXPECT_EQ(parseScheme("paper-4")->stopDepth, kInfinity);
}

TEST(SchemeNames, thatMeanNothingAreRefusedWithTheListOfThoseThatDo)
{
    for (const char* name : {"", "gauss", "gauss-", "gauss-4", "gauss-5-cap-", "gauss-5-cap--1", "paper-0",
                             "paper-65", "paper-1.5", "paper-1-cap-2", "march-0", "march--1", "march-inf",
                             "adaptive-nan", "positive-1", "euler-3", "gauss-5x"})
    {
        const base::Result<IntegralScheme> scheme = parseScheme(name);
        ASSERT_FALSE(scheme.ok()) << name;
        EXPECT_NE(scheme.status().message().find("gauss-5"), std::string::npos);
    }
}

} // namespace
} // namespace fx::render
