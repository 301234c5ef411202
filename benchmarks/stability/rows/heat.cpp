/// @file heat.cpp
/// H-01, H-02, H-05, H-06: what of the heat shimmer can be computed without a GPU.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"
#include "rendering/passes/heat_offset_pass.h"
#include "shaders/formulas/formula.h"

#include <numbers>

namespace fx::cli {
namespace {

std::vector<StabilitySweep> noHeat(bool isQuick)
{
    const StabilitySweep sweep{"deflection without heat",
                               evenSteps("x [radius]", -1.2, 1.2, 120, isQuick),
                               values("heat [K]", {-1000, -50, -1e-6, 0}),
                               0.0,
                               false,
                               [](double x, double heat) {
                                   const float bend = formula::fxHeatRefraction(float(heat));
                                   return std::fabs(
                                       double(bend * formula::fxHeatStreamX(float(x), 0.3f, 0.2f, 0.7f)));
                               }};
    return {sweep, controlOf(sweep, "cold gas bends too", [](double x, double heat) {
                const double share = heat / (288.0 + heat);
                return std::fabs(share * formula64::fxHeatStreamX(x, 0.3, 0.2, 0.7));
            })};
}

std::vector<StabilitySweep> constants(bool isQuick)
{
    const StabilitySweep sweep{"v + f (v - v)",
                               powersOfTen("value", -6, 6, 20, isQuick),
                               evenSteps("f", 0.0, 1.0, 100, isQuick),
                               0.0,
                               false,
                               [](double value, double place) {
                                   const float v = float(value), f = float(place);
                                   return std::fabs(double(v + f * (v - v)) - double(v));
                               }};
    return {sweep, controlOf(sweep, "weights 1 - f and f", [](double value, double place) {
                const float v = float(value), f = float(place);
                return std::fabs(double((1.0f - f) * v + f * v) - double(v)) / double(v);
            })};
}

/// A bright spot seen through a ball of hot gas: change of its mean. @param isCurl displaced along the stream
/// function, otherwise down its slope
double meanDrift(double amplitude, double phase, bool isCurl)
{
    constexpr int kSteps = 96;
    const auto picture = [](double x, double y) { return 0.2 + std::exp(-4.0 * (x * x + y * y)); };
    double before = 0, after = 0;
    for (int j = 0; j < kSteps; ++j)
        for (int i = 0; i < kSteps; ++i) {
            const double x = -1.2 + 2.4 * (i + 0.5) / kSteps, y = -1.2 + 2.4 * (j + 0.5) / kSteps;
            const double q = x * x + y * y, sx = formula64::fxHeatStreamX(x, y, phase, 0.3),
                         sy = formula64::fxHeatStreamY(x, y, phase, 0.3);
            const double dx = isCurl ? sy / 18.0 : formula64::fxHeatColumnSlope(x, q) / 1.6,
                         dy = isCurl ? -sx / 18.0 : formula64::fxHeatColumnSlope(y, q) / 1.6;
            before += picture(x, y);
            after += picture(x + amplitude * dx, y + amplitude * dy);
        }
    return relativeError(after, before);
}

std::vector<StabilitySweep> energies(bool isQuick)
{
    const StabilitySweep sweep{
        "mean of a picture",
        powersOfTen("largest offset [radius]", -3, -0.8, 20, isQuick),
        evenSteps("phase", 0.0, 0.95, 19, isQuick),
        0.01,
        false,
        [](double amplitude, double phase) { return meanDrift(amplitude, phase, true); }};
    return {sweep, controlOf(sweep, "displaced down a slope", [](double amplitude, double phase) {
                return meanDrift(amplitude, phase, false);
            })};
}

std::vector<StabilitySweep> phases(bool isQuick)
{
    const auto timeOf = [](double x, double periods) {
        return std::round(x * 1024.0) / 1024.0 + render::kHeatPeriod * periods;
    };
    const StabilitySweep sweep{"heatPhase",
                               evenSteps("time [s]", 0.0, 8.0, 256, isQuick),
                               values("periods later", {1, 100, 1e4, 1250000, 1e8}),
                               0.0,
                               false,
                               [timeOf](double x, double periods) {
                                   return std::fabs(double(render::heatPhase(timeOf(x, periods))) -
                                                    double(render::heatPhase(timeOf(x, 0.0))));
                               }};
    return {sweep, controlOf(sweep, "time in float", [timeOf](double x, double periods) {
                const auto phase = [](double t) { return formula::fract(float(t) / 8.0f); };
                return std::fabs(double(phase(timeOf(x, periods))) - double(phase(timeOf(x, 0.0))));
            })};
}

} // namespace

StabilityRows heatStability()
{
    return {
        {"H-01", "no heat bends nothing", "0", noHeat},
        {"H-02", "a constant picture stays constant", "the constant", constants},
        {"H-05", "the mean brightness stays", "the picture before", energies},
        {"H-06", "the motion repeats after any time", "the first period", phases},
    };
}

} // namespace fx::cli
