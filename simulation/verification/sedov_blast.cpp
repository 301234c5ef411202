#include "simulation/verification/sedov_blast.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::sim {
namespace {

constexpr int kIntervals = 4096;

/// The flow as a function of a, the parameter that runs from 0 to 1.
struct Profile
{
    double gamma;

    double velocity(double a) const { return (1 + (gamma - 1) / (gamma + 1) * a) / gamma; } ///< V
    double b(double v) const { return (gamma + 1) / (7 - gamma) * (5 - (3 * gamma - 1) * v); }
    double n1() const { return -(13 * gamma * gamma - 7 * gamma + 12) / ((3 * gamma - 1) * (2 * gamma + 1)); }
    double logX(double logA) const
    {
        const double v = velocity(std::exp(logA));
        const double n2 = 5 * (gamma - 1) / (2 * gamma + 1);
        return (-2 * std::log(0.5 * (gamma + 1) * v) + n1() * std::log(b(v)) + n2 * logA) / 5; // (3)
    }
    double density(double logA) const
    {
        const double v = velocity(std::exp(logA));
        const double d = (gamma + 1) / (gamma - 1) * (1 - v);
        const double n3 = 3 / (2 * gamma + 1);
        const double n4 = -n1() / (2 - gamma);
        const double n5 = -2 / (2 - gamma);
        return (gamma + 1) / (gamma - 1) *
               std::exp(n3 * logA + n4 * std::log(b(v)) + n5 * std::log(d)); // (4)
    }
    double soundSquared(double logA) const
    {
        const double a = std::exp(logA);
        const double v = velocity(a);
        const double excess = (gamma - 1) / (gamma + 1) * a;         // gamma V - 1
        return gamma * (gamma - 1) * (1 - v) * v * v / (2 * excess); // (2)
    }
    double solve(double x) const
    {
        double low = -700;
        double high = 0;
        const double goal = std::log(x);
        for (int i = 0; i < 100; ++i) {
            const double middle = 0.5 * (low + high);
            (logX(middle) < goal ? low : high) = middle;
        }
        return 0.5 * (low + high);
    }
};

} // namespace

SedovBlast::SedovBlast(double gamma, double energy, double density)
    : gamma_(gamma), energy_(energy), density_(density), table_(kIntervals + 1)
{
    const Profile profile{gamma};
    double integral = 0;
    for (int k = 1; k <= kIntervals; ++k) {
        const double x = double(k) / kIntervals;
        const double logA = k == kIntervals ? 0.0 : profile.solve(x);
        const double v = profile.velocity(std::exp(logA));
        const double g = profile.density(logA);
        const double z = profile.soundSquared(logA);
        table_[size_t(k)] = {v * x, g, g * z * x * x / gamma};
        const double share = g * (0.5 * v * v + z / (gamma * (gamma - 1))) * x * x * x * x; // (5)
        const double simpson = k == kIntervals ? 1 : k % 2 == 1 ? 4 : 2;
        integral += simpson * share / (3.0 * kIntervals);
    }
    table_[0] = {0, 0, table_[1].pressure}; // (6)
    xi0_ = std::pow(16 * std::numbers::pi / 25 * integral, -0.2);
}

double SedovBlast::shockRadius(double time) const
{
    return xi0_ * std::pow(energy_ * time * time / density_, 0.2); // (1)
}

double SedovBlast::shockSpeed(double time) const
{
    return 0.4 * shockRadius(time) / time; // (1)
}

FlowState SedovBlast::behindShock(double time) const
{
    const double speed = shockSpeed(time);
    const Similar& last = table_.back();
    return {density_ * last.density, speed * last.velocity, density_ * speed * speed * last.pressure};
}

FlowState SedovBlast::at(double radius, double time) const
{
    const double x = radius / shockRadius(time) * kIntervals;
    if (!(x < kIntervals))
        return {density_, 0, 0};
    const auto k = size_t(x);
    const double f = x - double(k);
    const Similar& low = table_[k];
    const Similar& high = table_[k + 1];
    const double speed = shockSpeed(time);
    const double density = k == 0 ? high.density * std::pow(f, 3 / (gamma_ - 1)) // (6)
                                  : low.density + f * (high.density - low.density);
    return {density_ * density, speed * (low.velocity + f * (high.velocity - low.velocity)),
            density_ * speed * speed * (low.pressure + f * (high.pressure - low.pressure))};
}

} // namespace fx::sim
