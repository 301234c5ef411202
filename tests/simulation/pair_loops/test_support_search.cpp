#include "simulation/sph/pair_loops/support_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

using fx::sim::SupportSearch;

struct Outcome
{
    double support;
    uint32_t evaluations;
    bool atTop, atBottom;
};

/// Searches S(H) = want for a mass given as a function; its growth is H dS/dH.
Outcome search(double want, double bottom, double top, double guess,
               const std::function<double(double)>& mass)
{
    SupportSearch<double> search(want, bottom, top, guess, 1e-8);
    uint32_t evaluations = 0;
    while (!search.isDone()) {
        const double H = search.support(), e = 1e-6 * H;
        search.tell(mass(H), H * (mass(H + e) - mass(H - e)) / (2 * e));
        EXPECT_LE(++evaluations, SupportSearch<double>::kMaxEvaluations);
    }
    EXPECT_GE(search.support(), bottom);
    EXPECT_LE(search.support(), top);
    return {search.support(), evaluations, search.isAtTop(), search.isAtBottom()};
}

double cube(double H)
{
    return 0.1 + H * H * H;
}

TEST(SupportSearch, findsTheSupportFromAnywhereInItsRange)
{
    for (const double guess : {1e-3, 0.1, 1.0, 1.99, 2.0, 2.01, 50.0, 1e4}) {
        const Outcome found = search(8.1, 1e-6, 1e6, guess, cube);
        EXPECT_NEAR(found.support, 2.0, 1e-7) << "from " << guess;
        EXPECT_FALSE(found.atTop || found.atBottom);
    }
}

TEST(SupportSearch, needsOneEvaluationNearTheSolution)
{
    EXPECT_EQ(search(8.1, 1e-6, 1e6, 2.0 * (1 + 2e-5), cube).evaluations, 1u);
}

TEST(SupportSearch, stopsAtItsBounds)
{
    const Outcome top = search(8.1, 0.1, 1.5, 1.0, cube);
    EXPECT_EQ(top.support, 1.5);
    EXPECT_TRUE(top.atTop);
    const Outcome bottom = search(8.1, 2.5, 10.0, 3.0, cube);
    EXPECT_EQ(bottom.support, 2.5);
    EXPECT_TRUE(bottom.atBottom);
    const Outcome point = search(8.1, 1.0, 1.0, 5.0, cube);
    EXPECT_EQ(point.support, 1.0);
    EXPECT_TRUE(point.atTop);
}

TEST(SupportSearch, endsOnMassesThatJump)
{
    const auto step = [](double H) { return H < 3.0 ? 1.0 : 100.0; };
    const Outcome found = search(10.0, 1e-3, 1e3, 1.0, step);
    EXPECT_NEAR(found.support, 3.0, 1.0);
}

TEST(SupportSearch, endsOnMassesThatNeverGrow)
{
    EXPECT_TRUE(search(10.0, 1e-3, 1e3, 1.0, [](double) { return 1.0; }).atTop);
    EXPECT_TRUE(search(10.0, 1e-3, 1e3, 1.0, [](double) { return 20.0; }).atBottom);
}

} // namespace
