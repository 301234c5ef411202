#include "rendering/network/network_gather.h"

#include "foundation/math/elementary.h"
#include "rendering/network/network_basis.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <numbers>

namespace fx::render {

namespace {

constexpr int kMaxSmallAngles = 16; // (4)
constexpr double kDeep = 40.0;      // [1] behind which nothing of (2) is left

/// Sum of (2) over X, without F and transmittances.
double smallAngles(const NetworkPhase& phase, double albedo, double depth, double cosine)
{
    const double c = cosine, g = phase.anisotropy, f = phase.peak;
    const double legendre[3] = {1.0, 3.0 * c, 5.0 * (1.5 * c * c - 0.5)};
    double whole = 1.0, peak = 1.0, bands[3] = {1.0, 1.0, 1.0};
    double share = albedo, sum = 0.0; // share: (albedo X)^N / N! / X
    for (int n = 1; n <= kMaxSmallAngles; ++n) {
        whole *= g;
        peak *= f;
        double rest = 0.0;
        for (size_t l = 0; l < 3; ++l) {
            bands[l] *= f + (1.0 - f) * phase.factors[l];
            if (l < size_t(phase.bands))
                rest += legendre[l] * (bands[l] - peak);
        }
        rest /= 4.0 * std::numbers::pi;
        sum += share * (formula64::fxHenyeyGreenstein(c, whole) - rest); // (3)
        share *= albedo * depth / (n + 1.0);
    }
    return sum;
}

} // namespace

GatheredLight gatherUnscattered(const NetworkPhase& phase, const GatherPoint& point)
{
    const double share = phase.extinctionShare(point.albedo), depth = point.lightDepth + point.eyeDepth;
    GatheredLight light;
    light.scaled = point.irradiance * base::naturalExp(-share * point.lightDepth) * point.albedo *
                   (1.0 - phase.peak) * std::max(phase.series(point.cosine), 0.0); // (1)
    if (depth < kDeep)
        light.plain = std::max(point.irradiance * base::naturalExp(-point.lightDepth) *
                                   smallAngles(phase, point.albedo, depth, point.cosine),         // (2)
                               -light.scaled * base::naturalExp((1.0 - share) * point.eyeDepth)); // (5)
    return light;
}

double gatherScattered(const NetworkPhase& phase, double albedo, const NetworkState& state,
                       const glm::dvec3& position, const glm::dvec3& toEye)
{
    const auto y = harmonics(toEye);
    double sum = 0.0;
    for (int k = 0; k < state.moments; ++k)
        sum += phase.factors[size_t(harmonicBand(k))] * y[size_t(k)] *
               interpolated(state.light.data() + size_t(k) * state.grid.count(), state.grid, position);
    return albedo * (1.0 - phase.peak) * std::max(sum, 0.0); // (1)
}

} // namespace fx::render
