/// @file ray_moments.cpp
/// R-01, and the incremental form that is the control of other rows.

#include "benchmarks/stability/rows/ray_sweeps.h"
#include "benchmarks/stability/stability_row.h"
#include "rendering/reference/integral/ray_integrator-inl.h"

#include <algorithm>

namespace fx::cli {
namespace {

/// e^-s M(1, n + 2, s) / (n + 1) by its series up to s = 60; beyond, upwards, which there loses nothing.
long double trueMoment(long double s, int n)
{
    if (s > 60.0L) {
        long double moment = -std::expm1(-s) / s;
        for (int k = 1; k <= n; ++k)
            moment = (k * moment - std::exp(-s)) / s;
        return moment;
    }
    long double sum = 0.0L, term = 1.0L / (n + 1);
    for (int k = 1; term > 1e-22L * sum; ++k) {
        sum += term;
        term *= s / (n + 1 + k);
    }
    return std::exp(-s) * sum;
}

/// In units of 2^-24 or 2^-53. Moments below 1e-30 are left out: float has none of their digits.
template <class T>
double roundings(T got, T s, int n)
{
    const long double exact = trueMoment(s, n);
    const double unit = std::ldexp(1.0, std::numeric_limits<T>::digits);
    return exact < 1e-30L ? 0.0 : double(std::fabs((static_cast<long double>(got) - exact) / exact)) * unit;
}

template <class T>
double stableError(double x, double n)
{
    const T s = static_cast<T>(x);
    T moments[9];
    render::integral::attenuationMoments<T, 8>(s, moments);
    return roundings(moments[int(n)], s, int(n));
}

/// Upwards from m_0 for every s, as the paper gives it.
template <class T>
double naiveError(double x, double n)
{
    const T s = static_cast<T>(x);
    T moment = -std::expm1(-s) / s;
    for (int k = 1; k <= int(n); ++k)
        moment = (T(k) * moment - std::exp(-s)) / s;
    return roundings(moment, s, int(n));
}

std::vector<StabilitySweep> moments(bool isQuick)
{
    const StabilityAxis s = powersOfTen("s", -30, 4, 20, isQuick);
    const StabilityAxis n = values("n", {0, 1, 2, 3, 4, 5, 6, 7, 8});
    const StabilitySweep inFloat{"float, in roundings", s, n, 8.0, false, stableError<float>};
    const StabilitySweep inDouble{"double, in roundings", s, n, 8.0, false, stableError<double>};
    return {inFloat, inDouble, controlOf(inFloat, "textbook recurrence, float", naiveError<float>),
            controlOf(inDouble, "textbook recurrence, double", naiveError<double>)};
}

/// Sums of all blobs' coefficients in powers of the ray parameter.
struct RunningSums
{
    float density[5] = {};
    float source[5] = {};

    void add(const render::RayBlob<double>& blob, double origin, float sign)
    {
        const float center = float(blob.center + origin), g1 = 2.0f * center,
                    g0 = float(blob.chord2) - center * center;
        const float q[5] = {g0 * g0, 2.0f * g0 * g1, g1 * g1 - 2.0f * g0, -2.0f * g1, 1.0f};
        const float weight = sign * float(blob.extinction / std::pow(blob.radius, 4));
        for (int j = 0; j < 5; ++j) {
            density[j] += weight * q[j];
            source[j] += weight * float(blob.source[0]) * q[j];
        }
    }
};

/// Coefficients about `t`.
void shift(const float* from, float t, float* to)
{
    std::copy_n(from, 5, to);
    for (int a = 0; a < 4; ++a)
        for (int j = 3; j >= a; --j)
            to[j] += t * to[j + 1];
}

struct BlobEvent
{
    float t;
    size_t blob;
    float sign;
};

} // namespace

double incrementalLight(const SweepBlobs& blobs, double origin)
{
    std::vector<BlobEvent> events;
    for (size_t i = 0; i < blobs.size(); ++i)
        for (const float sign : {1.0f, -1.0f})
            events.push_back(
                {float(blobs[i].center - double(sign) * std::sqrt(blobs[i].chord2) + origin), i, sign});
    std::sort(events.begin(), events.end(), [](const BlobEvent& a, const BlobEvent& b) { return a.t < b.t; });
    RunningSums sums;
    float light = 0.0f, depth = 0.0f;
    for (size_t k = 0; k + 1 < events.size(); ++k) {
        sums.add(blobs[events[k].blob], origin, events[k].sign);
        float density[5], source[5], m[5];
        shift(sums.density, events[k].t, density);
        shift(sums.source, events[k].t, source);
        const float length = events[k + 1].t - events[k].t;
        float own = 0.0f, power = length;
        for (int j = 0; j < 5; ++j, power *= length)
            own += density[j] * power / float(j + 1);
        render::integral::attenuationMoments<float, 4>(std::max(own, 0.0f), m);
        power = length * std::exp(-depth);
        for (int j = 0; j < 5; ++j, power *= length)
            light += source[j] * power * m[j];
        depth += own;
    }
    return double(light);
}

StabilityRows rayMomentsStability()
{
    return {{"R-01", "moments of e^-s are good for every s", "series in long double", moments}};
}

} // namespace fx::cli
