/// @file integral_scheme.h
/// Schemes to integrate the light along a ray, their names, and their default settings.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace fx::render {

enum class IntegralMethod : uint8_t
{
    /// attenuation is linear in the ray parameter within a part, so that the integral has a closed form
    /// (formula linear-attenuation)
    Paper,
    Simpson, ///< Simpson's rule with exact optical depth
    Gauss,   ///< Gauss-Legendre nodes with exact optical depth (formula gauss-attenuation)

    /// the source is linear in optical depth between nodes (formula depth-linear-source); the result is
    /// always within the bounds of the exact light
    Positive,
    March, ///< equal steps along the whole ray, each with the density at its midpoint

    /// Uses the integral of Paper; a bound of the remaining light determines the parts and the end of the
    /// ray.
    Adaptive
};

/// Model of emission. Blob i has extinction rho_i(t) and emits source_i per unit of its optical depth.
enum class SourceModel : uint8_t
{
    PerBlob, ///< sum over i of rho_i source_i, so that each blob emits in proportion to its own extinction
    /// (sum of rho_i) (sum of k_i source_i), where k_i is the kernel scaled to 1 at the center
    Product
};

struct IntegralScheme
{
    IntegralMethod method = IntegralMethod::Gauss;
    /// Paper: parts, 1..64; Simpson: panels, 1..64; Gauss: nodes, 3, 5 or 8; Positive: pieces, 2..64
    uint32_t count = 5;
    /// [1] Gauss: largest optical depth of a part of an interval; infinity: intervals are not divided.
    /// Kernels of degree 3 use a quarter of `cap`, and kernels of degree 4 a tenth.
    double cap = 1.0;
    double step = 0.01;       ///< [m] March: step length
    double tolerance = 0.001; ///< [1] Adaptive: error relative to the largest possible light of the ray
    double stopDepth = 30.0; ///< [1] optical depth at which the integration of a ray ends; infinity: rays are
                             ///< not ended early
};

/// The scheme gauss-5 with the cap 1.
IntegralScheme defaultScheme();
/// The scheme gauss-8 with the cap 2.
IntegralScheme highScheme();

/// Parses the name of a scheme, such as paper-1, simpson-4, gauss-5, gauss-8, gauss-5-cap-0.5,
/// gauss-5-cap-inf, positive-8, march-0.01, adaptive-0.001. The scheme `paper` never ends a ray early. The
/// default cap of gauss-3 is 0.5, of gauss-5 1, of gauss-8 2.
base::Result<IntegralScheme> parseScheme(std::string_view name);
std::string schemeName(const IntegralScheme& scheme);
/// Names of the schemes of the accuracy report, from coarse to fine within a method.
const std::vector<std::string>& comparedSchemes();

struct IntegralSettings
{
    IntegralScheme scheme;
    SourceModel model = SourceModel::PerBlob;
    uint32_t degree = 2; ///< degree of the kernel (1 - q^2)^degree of all blobs, 2..4
};

} // namespace fx::render
