#include "simulation/fragments/fragment_sizes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace fx::sim;

namespace {

FragmentsDef law(SizeLaw sizeLaw, float least, float most)
{
    FragmentsDef def;
    def.sizeLaw = sizeLaw;
    def.size = {least, most};
    return def;
}

constexpr int kDraws = 20000;

/// Share of sizes above d, drawn at equal steps of u.
double shareAbove(const FragmentsDef& def, float d)
{
    int above = 0;
    for (int i = 0; i < kDraws; ++i)
        above += fragmentSize(def, (float(i) + 0.5f) / kDraws) > d;
    return double(above) / kDraws;
}

} // namespace

TEST(FragmentSizes, staySmallestToLargestAndGrowWithTheRandomNumber)
{
    for (const SizeLaw sizeLaw : {SizeLaw::Mott, SizeLaw::PowerLaw}) {
        const FragmentsDef def = law(sizeLaw, 0.003f, 0.06f);
        float last = fragmentSize(def, 0.0f);
        EXPECT_NEAR(last, 0.003f, 1e-7f);
        for (int i = 1; i <= 1000; ++i) {
            const float d = fragmentSize(def, std::min(float(i) / 1000.0f, 0.99999994f));
            EXPECT_GE(d, last);
            EXPECT_LE(d, 0.06f);
            last = d;
        }
    }
}

TEST(FragmentSizes, mottMassesHaveTheirMeanAndTheirTail)
{
    FragmentsDef def = law(SizeLaw::Mott, 1e-5f, 1.0f); // practically not truncated
    def.meanSize = 0.01f;
    double mass = 0; // in units of the mean one
    for (int i = 0; i < kDraws; ++i)
        mass += std::pow(double(fragmentSize(def, (float(i) + 0.5f) / kDraws)) / 0.01, 3.0);
    EXPECT_NEAR(mass / kDraws, 1.0, 0.02);
    for (const double m : {0.1, 1.0, 4.0})
        EXPECT_NEAR(shareAbove(def, float(0.01 * std::cbrt(m))), std::exp(-std::sqrt(2.0 * m)), 1e-3) << m;
}

TEST(FragmentSizes, thePowerLawIsOne)
{
    FragmentsDef def = law(SizeLaw::PowerLaw, 0.002f, 2.0f);
    def.exponent = 2.0f;
    for (const float d : {0.004f, 0.008f, 0.02f})
        EXPECT_NEAR(shareAbove(def, d), std::pow(0.002 / double(d), 2.0), 2e-4) << d;
}

TEST(FragmentSizes, oneSizeAndExtremeMeansAreNoSpecialCases)
{
    for (const SizeLaw sizeLaw : {SizeLaw::Mott, SizeLaw::PowerLaw})
        EXPECT_NEAR(fragmentSize(law(sizeLaw, 0.01f, 0.01f), 0.7f), 0.01f, 1e-7f);
    FragmentsDef def = law(SizeLaw::Mott, 0.01f, 0.1f);
    for (const float mean : {1e-6f, 1e-3f, 1e3f}) {
        def.meanSize = mean;
        for (const float u : {0.0f, 0.5f, 0.99999994f}) {
            const float d = fragmentSize(def, u);
            EXPECT_TRUE(d >= 0.01f && d <= 0.1f) << mean << " " << u;
        }
    }
}
