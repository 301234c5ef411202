#include "rendering/reference/path/path_phase.h"

#include "tests/rendering/reference/path/path_statistics.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

namespace fx::render {
namespace {

struct NamedPhase
{
    const char* name;
    PhaseFunction phase;
    double meanCosine;
};

std::vector<NamedPhase> phases()
{
    return {{"isotropic", PhaseFunction::isotropic(), 0.0},
            {"rayleigh", PhaseFunction::rayleigh(), 0.0},
            {"forwards", PhaseFunction::henyeyGreenstein(0.7), 0.7},
            {"backwards", PhaseFunction::henyeyGreenstein(-0.4), -0.4},
            {"nearly isotropic", PhaseFunction::henyeyGreenstein(1e-5), 1e-5},
            {"two lobes", PhaseFunction::twoLobes(0.8, -0.3, 0.75), 0.75 * 0.8 - 0.25 * 0.3}};
}

/// Integral of `f` over [-1, 1] by Simpson's rule.
template <class F>
double integrate(F f)
{
    constexpr int kSteps = 200000;
    double sum = f(-1.0) + f(1.0);
    for (int i = 1; i < kSteps; ++i)
        sum += f(-1.0 + 2.0 * i / kSteps) * (i % 2 ? 4.0 : 2.0);
    return sum * (2.0 / kSteps) / 3.0;
}

TEST(PhaseFunction, integratesToOneAndHasItsMeanCosine)
{
    for (const NamedPhase& named : phases()) {
        SCOPED_TRACE(named.name);
        const auto density = [&](double cosine) { return 2.0 * std::numbers::pi * named.phase.at(cosine); };
        EXPECT_NEAR(integrate(density), 1.0, 1e-9);
        EXPECT_NEAR(integrate([&](double cosine) { return cosine * density(cosine); }), named.meanCosine,
                    1e-9);
        EXPECT_NEAR(named.phase.meanCosine(), named.meanCosine, 1e-12);
    }
}

TEST(PhaseFunction, drawsDirectionsByItsOwnDensity)
{
    constexpr int kDraws = 200000;
    constexpr int kBins = 40;
    for (const NamedPhase& named : phases()) {
        SCOPED_TRACE(named.name);
        Statistics cosine;
        std::vector<int> counts(kBins);
        PathSampler sampler(21, 0, 0);
        for (int i = 0; i < kDraws; ++i) {
            const double c = named.phase.cosine(sampler.number());
            cosine.add(c);
            ++counts[size_t(std::min(kBins - 1, int((c + 1.0) * 0.5 * kBins)))];
        }
        EXPECT_NEAR(cosine.mean(), named.meanCosine, 3.0 * cosine.error());
        double chiSquare = 0.0;
        for (int bin = 0; bin < kBins; ++bin) {
            double expected = 0.0; // the density over the bin, by the midpoint rule
            constexpr int kParts = 200;
            for (int part = 0; part < kParts; ++part)
                expected += named.phase.at(-1.0 + 2.0 * (bin + (part + 0.5) / kParts) / kBins);
            expected *= 2.0 * std::numbers::pi * 2.0 / kBins / kParts * kDraws;
            chiSquare += (counts[size_t(bin)] - expected) * (counts[size_t(bin)] - expected) / expected;
        }
        EXPECT_LT(chiSquare, 72.1) << "39 degrees of freedom: exceeded with probability 0.001";
    }
}

TEST(PhaseFunction, turnsAroundEveryDirection)
{
    PathSampler sampler(2, 0, 0);
    for (int i = 0; i < 1000; ++i) {
        const double height = 1.0 - 2.0 * sampler.number();
        const glm::dvec3 axis = PhaseFunction::around({0, 0, 1}, height, sampler.number());
        const double cosine = 1.0 - 2.0 * sampler.number();
        const double turn = sampler.number();
        const glm::dvec3 direction = PhaseFunction::around(axis, cosine, turn);
        EXPECT_NEAR(glm::length(direction), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(direction, axis), cosine, 1e-12);
        const glm::dvec3 opposite = PhaseFunction::around(axis, cosine, turn < 0.5 ? turn + 0.5 : turn - 0.5);
        EXPECT_NEAR(glm::length(direction + opposite - 2.0 * cosine * axis), 0.0, 1e-12);
    }
    for (const glm::dvec3& axis :
         {glm::dvec3(0, 0, -1), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0)})
        EXPECT_NEAR(glm::dot(PhaseFunction::around(axis, 0.25, 0.1), axis), 0.25, 1e-12);
}

} // namespace
} // namespace fx::render
