#include "simulation/motion/flight_bound.h"

#include <gtest/gtest.h>

#include <cmath>

using fx::sim::flightBound;

TEST(FlightBound, freeFallUnderConstantAccelerationReachesIt)
{
    const double way = 3.0 * 2.0 + 0.5 * 9.81 * 4.0;
    EXPECT_NEAR(flightBound({2.0, 3.0, 9.81, 0.0, 0.0}), way, 2e-6 * way);
}

TEST(FlightBound, noIntegratedFlightPassesIt)
{
    for (int i = 0; i < 400; ++i) {
        const double seconds = 0.1 + 0.7 * (i % 10), speed = 2.0 * (i % 7), pull = 3.0 * (i % 5);
        const double air = 1.5 * (i % 6), drag = 0.4 * (i % 8);
        const double bound = flightBound({seconds, speed, pull, air, drag});
        double v = speed * (i % 2 ? -1 : 1), x = 0, farthest = 0;
        const int steps = 20'000;
        for (int k = 0; k < steps; ++k) { // the worst case in one dimension, and one that turns round
            v += (pull + drag * (air - v)) * seconds / steps;
            x += v * seconds / steps;
            farthest = std::max(farthest, std::abs(x));
        }
        EXPECT_LE(farthest, bound * (1 + 1e-3) + 1e-9) << i;
    }
}

TEST(FlightBound, dragStopsWhatIsFast)
{
    const double way = 40.0 / 2.0 + (9.81 / 2.0) * 3.0; // the whole way of a throw, and falling for ever
    EXPECT_NEAR(flightBound({3.0, 40.0, 9.81, 0.0, 2.0}), way - (9.81 / 2.0) / 2.0, 1e-4 * way);
}

TEST(FlightBound, strongDragKeepsItNearTheSpeedOfTheAir)
{
    EXPECT_LE(flightBound({10.0, 0.0, 9.81, 2.0, 100.0}), (2.0 + 0.0981) * 10.0 * 1.00001);
}
