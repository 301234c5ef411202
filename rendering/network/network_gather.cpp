#include "rendering/network/network_gather.h"

#include "foundation/math/elementary.h"
#include "rendering/network/cell_interpolation.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr double kDeep = 40.0;     // [1] behind which nothing of (2) is left
constexpr double kNothing = 1e-15; // [1/sr] of R_N: rounding

} // namespace

GatherAngle::GatherAngle(const NetworkPhase& phase, double cosine)
    : series_(std::max(phase.series(cosine), 0.0)), peak_(phase.peak)
{
    const double c = cosine, g = phase.anisotropy, f = phase.peak;
    const double legendre[3] = {1.0, 3.0 * c, 5.0 * (1.5 * c * c - 0.5)};
    double whole = 1.0, peak = 1.0, bands[3] = {1.0, 1.0, 1.0}, factorial = 1.0;
    for (int n = 1; n <= kMaxOrder; ++n) {
        whole *= g;
        peak *= f;
        factorial *= n;
        double rest = 0.0;
        for (size_t l = 0; l < 3; ++l) {
            bands[l] *= f + (1.0 - f) * phase.factors[l];
            if (l < size_t(phase.bands))
                rest += legendre[l] * (bands[l] - peak);
        }
        rest = formula64::fxHenyeyGreenstein(c, whole) - rest / (4.0 * std::numbers::pi); // (3)
        rest_[size_t(n - 1)] = rest / factorial;
        if (std::abs(rest) > kNothing)
            orders_ = n;
    }
}

double GatherAngle::smallAngles(double albedo, double depth) const
{
    const double x = albedo * depth;
    double sum = 0.0;
    for (size_t n = size_t(orders_); n > 0; --n)
        sum = rest_[n - 1] + x * sum;
    return albedo * sum; // (2)
}

GatheredLight gatherUnscattered(const GatherAngle& angle, const GatherPoint& point)
{
    const double peak = angle.peak(), share = 1.0 - point.albedo * peak;
    GatheredLight light;
    light.scaled = point.irradiance * base::naturalExp(-share * point.lightDepth) * point.albedo *
                   (1.0 - peak) * angle.series(); // (1)
    const double depth = point.lightDepth + point.eyeDepth;
    if (angle.orders() > 0 && depth < kDeep)
        light.plain = std::max(point.irradiance * base::naturalExp(-point.lightDepth) *
                                   angle.smallAngles(point.albedo, depth),                        // (2)
                               -light.scaled * base::naturalExp((1.0 - share) * point.eyeDepth)); // (5)
    return light;
}

GatherMoments::GatherMoments(const NetworkPhase& phase, const NetworkState& state)
    : grid_(state.grid), moments_(state.moments), stride_(state.moments > 4 ? 12 : 4)
{
    for (int k = 0; k < moments_; ++k)
        factors_[size_t(k)] = (1.0 - phase.peak) * phase.factors[size_t(harmonicBand(k))];
    const size_t count = moments_ > 0 ? grid_.count() : 0;
    light_.assign(count * size_t(stride_), 0.0f);
    for (size_t k = 0; k < size_t(moments_); ++k)
        for (size_t i = 0; i < count; ++i)
            light_[i * size_t(stride_) + k] = state.light[k * count + i];
}

GatherMoments::Weights GatherMoments::weights(const glm::dvec3& toEye) const
{
    const auto y = harmonics(toEye);
    Weights weights{};
    for (size_t k = 0; k < size_t(moments_); ++k)
        weights[k] = float(factors_[k] * y[k]);
    return weights;
}

double GatherMoments::at(const glm::dvec3& position, const Weights& weights) const
{
    if (light_.empty())
        return 0.0;
    return stride_ == 4 ? sum<4>(position, weights) : sum<12>(position, weights);
}

template <int Stride>
double GatherMoments::sum(const glm::dvec3& position, const Weights& weights) const
{
    const auto light = interpolatedCells<Stride>(light_.data(), grid_, position);
    float sum = 0.0f;
    for (size_t k = 0; k < Stride; ++k)
        sum += weights[k] * light[k];
    return double(std::max(sum, 0.0f)); // (1)
}

} // namespace fx::render
