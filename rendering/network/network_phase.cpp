#include "rendering/network/network_phase.h"

#include "shaders/formulas/formula.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr int kShares = 4096; // that are tried

/// The least value of 1 + 3 g1 c + 5 g2 P2(c), for cosines -1 to 1.
double leastOf(double g1, double g2)
{
    if (std::abs(g1) >= 5.0 * g2)
        return 1.0 - 3.0 * std::abs(g1) + 5.0 * g2;
    return 1.0 - 2.5 * g2 - 0.3 * g1 * g1 / g2;
}

} // namespace

double NetworkPhase::series(double c) const
{
    return (1.0 + 3.0 * factors[1] * c + 5.0 * factors[2] * (1.5 * c * c - 0.5)) / (4.0 * std::numbers::pi);
}

NetworkPhase networkPhase(double anisotropy, int moments)
{
    NetworkPhase phase;
    const double g = std::clamp(anisotropy, -0.3, 0.98);
    phase.anisotropy = g;
    phase.bands = moments > 4 ? 3 : 2;
    const auto withPeak = [&](double f) {
        phase.peak = f;
        phase.factors = {1.0, (g - f) / (1.0 - f), moments > 4 ? (g * g - f) / (1.0 - f) : 0.0}; // (1)
        return leastOf(phase.factors[1], phase.factors[2]) >= 0.0;
    };
    if (g <= 0.0) {
        withPeak(0.0);
        return phase;
    }
    if (moments == 4) {
        withPeak(formula64::fxNetworkPeak(g)); // (4)
        return phase;
    }
    for (int i = 0; i <= kShares; ++i)
        if (withPeak(g * g * (g + (1.0 - g) * double(i) / kShares))) // (3)
            return phase;
    const double first = std::numbers::inv_sqrt3; // (5)
    phase.peak = (g - first) / (1.0 - first);
    phase.factors = {1.0, first, 0.2};
    return phase;
}

} // namespace fx::render
