/// @file pair_reference.h
/// Reference implementation of the sums of the pair loops. It computes in double over all pairs, in the
/// textbook form with dW/dr and unit vectors.
#pragma once

#include "benchmarks/scenes/gas_stage.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <numbers>

namespace fx::test {

using bench::chance, bench::latticeGas, bench::parcel, bench::stir, bench::unitBox;
using bench::Densities, bench::Forces, bench::Gas, bench::GasStage;

/// Kernel W and its derivative dW/dr, in the form of the table of Dehnen and Aly.
struct ReferenceKernel
{
    sim::SphKernel kind;

    static double power(double x, int n)
    {
        double y = 1;
        for (int k = 0; k < n; ++k)
            y *= x;
        return y;
    }
    double shape(double q) const
    {
        const double pi = std::numbers::pi;
        if (q >= 1)
            return 0;
        switch (kind) {
        case sim::SphKernel::WendlandC2:
            return 21 / (2 * pi) * power(1 - q, 4) * (1 + 4 * q);
        case sim::SphKernel::WendlandC4:
            return 495 / (32 * pi) * power(1 - q, 6) * (1 + 6 * q + 35 * q * q / 3);
        case sim::SphKernel::CubicSpline:
            return 16 / pi * (q < 0.5 ? 0.5 - 3 * q * q + 3 * q * q * q : power(1 - q, 3));
        case sim::SphKernel::Quartic:
            return 105 / (32 * pi) * power(1 - q * q, 2);
        case sim::SphKernel::Sextic:
            return 315 / (64 * pi) * power(1 - q * q, 3);
        default:
            return 3465 / (512 * pi) * power(1 - q * q, 4);
        }
    }
    double value(double r, double H) const { return shape(r / H) / (H * H * H); }
    double slope(double r, double H) const { return shapeSlope(r / H) / (H * H * H * H); }
    double shapeSlope(double q) const
    {
        const double pi = std::numbers::pi;
        if (q >= 1)
            return 0;
        switch (kind) {
        case sim::SphKernel::WendlandC2:
            return -210 / pi * q * power(1 - q, 3);
        case sim::SphKernel::WendlandC4:
            return -1155 / (4 * pi) * q * power(1 - q, 5) * (1 + 5 * q);
        case sim::SphKernel::CubicSpline:
            return 48 / pi * (q < 0.5 ? -2 * q + 3 * q * q : -power(1 - q, 2));
        case sim::SphKernel::Quartic:
            return -105 / (8 * pi) * q * (1 - q * q);
        case sim::SphKernel::Sextic:
            return -945 / (32 * pi) * q * power(1 - q * q, 2);
        default:
            return -3465 / (64 * pi) * q * power(1 - q * q, 3);
        }
    }
};

/// Calls f(neighbor, x_i - x_j, v_i - v_j, isImage) for all other particles and all images in the domain.
template <class F>
void forEachReference(const Gas& gas, const sim::Domain& domain, uint32_t i, F&& f)
{
    const glm::dvec3 size = domain.high - domain.low;
    for (uint32_t j = 0; j < gas.size(); ++j) {
        for (int code = 0; code < 27; ++code) {
            const int way[3] = {code % 3, code / 3 % 3, code / 9};
            glm::dvec3 x(gas[j].x, gas[j].y, gas[j].z), v(gas[j].vx, gas[j].vy, gas[j].vz);
            bool exists = true;
            for (int a = 0; a < 3; ++a) {
                if (way[a] == 0)
                    continue;
                exists = exists && domain.axes[size_t(a)] != sim::AxisKind::Open;
                if (domain.axes[size_t(a)] == sim::AxisKind::Periodic)
                    x[a] += way[a] == 1 ? size[a] : -size[a];
                if (domain.axes[size_t(a)] == sim::AxisKind::Reflecting) {
                    x[a] = 2 * (way[a] == 1 ? domain.low[a] : domain.high[a]) - x[a];
                    v[a] = -v[a];
                }
            }
            if (exists && (j != i || code != 0))
                f(gas[j], glm::dvec3(gas[i].x, gas[i].y, gas[i].z) - x,
                  glm::dvec3(gas[i].vx, gas[i].vy, gas[i].vz) - v, code != 0);
        }
    }
}

struct ReferenceDensity
{
    double density = 0, correction = 0, divergence = 0;
    glm::dvec3 curl{0.0};
    uint32_t neighbors = 0;
};

inline double referenceSum(const Gas& gas, const sim::Domain& domain, const ReferenceKernel& w, double bias,
                           uint32_t i, double H)
{
    double density = gas[i].mass * w.value(0, H) * (1 - bias);
    forEachReference(gas, domain, i, [&](const auto& j, const glm::dvec3& d, const glm::dvec3&, bool) {
        density += j.mass * w.value(glm::length(d), H);
    });
    return density;
}

/// All results of the density loop at a given support H.
inline ReferenceDensity referenceDensity(const Gas& gas, const sim::Domain& domain, sim::SphKernel kernel,
                                         double bias, uint32_t i, double H)
{
    const ReferenceKernel w{kernel};
    ReferenceDensity out;
    out.density = referenceSum(gas, domain, w, bias, i, H);
    const double e = 1e-4;
    const double slope = (referenceSum(gas, domain, w, bias, i, H * (1 + e)) -
                          referenceSum(gas, domain, w, bias, i, H * (1 - e))) /
                         (2 * e * H);
    out.correction = 1 / (1 + H / (3 * out.density) * slope);
    glm::dmat3 moments(0.0), flows(0.0);
    forEachReference(gas, domain, i, [&](const auto& j, const glm::dvec3& d, const glm::dvec3& u, bool) {
        const double r = glm::length(d);
        out.neighbors += r < H ? 1u : 0u;
        const double weight = r > 0 ? -j.mass * w.slope(r, H) / r : 0;
        moments += weight * glm::outerProduct(d, d);
        flows += weight * glm::outerProduct(u, d);
    });
    const glm::dmat3 J = flows * glm::inverse(moments); // J[b][a] = d v_a / d x_b
    out.divergence = J[0][0] + J[1][1] + J[2][2];
    out.curl = {J[1][2] - J[2][1], J[2][0] - J[0][2], J[0][1] - J[1][0]};
    return out;
}

struct ReferenceForce
{
    glm::dvec3 acceleration{0.0};
    double heating = 0;
    double pressureWork = 0; ///< [W/kg] increase of the thermal energy by compression
    double signalSpeed = 0, fastestNeighbor = 1e30;
    uint32_t pairs = 0;
    /// sums of the absolute values of the terms, from which error bounds are computed
    double accelerationScale = 0, heatingScale = 0;
};

inline ReferenceForce referenceForce(const Gas& gas, const sim::Domain& domain, const sim::ForceRules& rules,
                                     uint32_t index)
{
    const ReferenceKernel w{rules.kernel};
    const auto& i = gas[index];
    ReferenceForce out;
    out.signalSpeed = 2 * i.sound;
    forEachReference(gas, domain, index, [&](const auto& j, const glm::dvec3& d, const glm::dvec3& v, bool) {
        const double r = glm::length(d);
        if (r >= std::max(i.support, j.support))
            return;
        const glm::dvec3 n = d / r;
        const glm::dvec3 gradI = w.slope(r, i.support) * n, gradJ = w.slope(r, j.support) * n;
        const glm::dvec3 grad = 0.5 * (gradI + gradJ);
        const double mu = std::min(glm::dot(v, n), 0.0);
        const double signal = i.sound + j.sound - rules.beta * mu;
        const double density = 0.5 * (i.density + j.density);
        const double nu =
            -0.5 * 0.5 * (i.viscosity + j.viscosity) * mu * signal / density * 0.5 * (i.limiter + j.limiter);
        const glm::dvec3 force = j.mass * (i.push * gradI + j.push * gradJ + nu * grad);
        out.acceleration -= force;
        out.accelerationScale += j.mass * (std::abs(i.push) * glm::length(gradI) +
                                           std::abs(j.push) * glm::length(gradJ) + nu * glm::length(grad));
        const double brake = j.mass * 0.5 * nu * glm::dot(v, grad);
        const double flow = j.mass * rules.conductivity *
                            std::sqrt(std::abs(i.pressure - j.pressure) / density) * (i.energy - j.energy) /
                            density * glm::dot(n, grad);
        out.heating += brake + flow;
        out.heatingScale += std::abs(brake) + std::abs(flow);
        out.pressureWork += i.push * j.mass * glm::dot(v, gradI);
        out.signalSpeed = std::max(out.signalSpeed, signal);
        out.fastestNeighbor = std::min(out.fastestNeighbor, j.stepLevel);
        ++out.pairs;
    });
    return out;
}

} // namespace fx::test
