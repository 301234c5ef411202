#include "rendering/network/network_gather.h"

#include "foundation/math/elementary.h"
#include "rendering/network/network_basis.h"
#include "shaders/formulas/formula.h"

#include <algorithm>

namespace fx::render {

GatheredLight gatherUnscattered(const NetworkPhase& phase, const GatherPoint& point)
{
    const double b = point.albedo * (1.0 - phase.peak);
    const double whole = formula64::fxHenyeyGreenstein(point.cosine, phase.anisotropy);
    const double rest = formula64::fxHenyeyGreenstein(point.cosine, phase.factors[1]);
    const double scaled = phase.extinctionShare(point.albedo) * point.lightDepth;
    return {point.irradiance * base::naturalExp(-point.lightDepth) * (point.albedo * whole - b * rest), // (1)
            point.irradiance * base::naturalExp(-scaled) * b * rest};                                   // (2)
}

double gatherScattered(const NetworkPhase& phase, double albedo, const NetworkState& state,
                       const glm::dvec3& position, const glm::dvec3& toEye)
{
    const auto y = harmonics(toEye);
    double sum = 0.0;
    for (int k = 0; k < state.moments; ++k)
        sum += phase.factors[size_t(harmonicBand(k))] * y[size_t(k)] *
               interpolated(state.light.data() + size_t(k) * state.grid.count(), state.grid, position);
    return albedo * (1.0 - phase.peak) * std::max(sum, 0.0); // (2)
}

} // namespace fx::render
