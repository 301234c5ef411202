#include "simulation/sph/pair_loops/sph_kernel.h"

#include "foundation/math/elementary.h"

#include <algorithm>

namespace fx::sim {

namespace {

double larger(double a, double b)
{
    return a > b ? a : b;
}

#include "simulation/sph/pair_loops/kernel_shapes.inl"

constexpr double kAnyNumber = std::numeric_limits<double>::infinity();

} // namespace

KernelFacts kernelFacts(SphKernel kernel)
{
    switch (kernel) {
    case SphKernel::WendlandC2:
        return {"wendland-c2", WendlandC2Shape::kNorm, WendlandC2Shape::kCenter, kAnyNumber};
    case SphKernel::WendlandC4:
        return {"wendland-c4", WendlandC4Shape::kNorm, WendlandC4Shape::kCenter, kAnyNumber};
    case SphKernel::CubicSpline:
        return {"cubic-spline", CubicSplineShape::kNorm, CubicSplineShape::kCenter, 50.0};
    case SphKernel::Quartic:
        return {"quartic", QuarticShape::kNorm, QuarticShape::kCenter, 0.0};
    case SphKernel::Sextic:
        return {"sextic", SexticShape::kNorm, SexticShape::kCenter, 0.0};
    case SphKernel::Octic:
        return {"octic", OcticShape::kNorm, OcticShape::kCenter, 0.0};
    }
    return {};
}

double kernelValue(SphKernel kernel, double r, double support)
{
    const double q = std::min(r / support, 1.0);
    double result = 0;
    withShape(kernel, [&](auto shape) {
        result = shape.kNorm / (support * support * support) * shape.value(q); // (1)
    });
    return result;
}

double kernelSlope(SphKernel kernel, double r, double support)
{
    const double q = std::min(r / support, 1.0);
    const double square = support * support;
    double result = 0;
    withShape(kernel, [&](auto shape) { result = shape.kNorm / (square * square) * q * shape.slope(q); });
    return result;
}

double kernelSupportSlope(SphKernel kernel, double r, double support)
{
    const double q = std::min(r / support, 1.0);
    const double square = support * support;
    double result = 0;
    withShape(kernel, [&](auto shape) {
        result = -shape.kNorm / (square * square) * (3.0 * shape.value(q) + q * q * shape.slope(q)); // (1)
    });
    return result;
}

double selfBias(SphKernel kernel, double neighbors)
{
    const double n = std::max(neighbors, 1.0) / 100.0;
    switch (kernel) {
    case SphKernel::WendlandC2:
        return std::min(0.0294 * base::power(n, -0.977), 0.5); // (7)
    case SphKernel::WendlandC4:
        return std::min(0.01342 * base::power(n, -1.579), 0.5);
    default:
        return 0.0;
    }
}

} // namespace fx::sim
