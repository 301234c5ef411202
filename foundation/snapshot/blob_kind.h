/// @file blob_kind.h
/// The kind "blob": a ball of participating medium with the polynomial kernel. The techniques that publish
/// gas and the passes that draw gas include this header; the snapshot container does not.
///
/// Extinction at distance r from the center is crossSection * W(r; radius) with W(r; R) = 105 / (32 pi R^3)
/// (1 - (r/R)^2)^2, see shaders/formulas/kernel_optical_depth.fx.h. The medium emits as a gray body: source =
/// (1 - albedo) * tint * B(temperature) + emission, where B is the luminance of a black body, and the tint is
/// that of the instance, see tintOf(). The source is multiplied by the blob's opacity. Therefore a medium
/// without extinction emits nothing.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"

#include <glm/vec3.hpp>

#include <span>

namespace fx::base {

/// Indices of the columns of the kind.
namespace blob_column {
enum : size_t
{
    PositionX,
    PositionY,
    PositionZ,
    VelocityX,
    VelocityY,
    VelocityZ,
    Radius,
    CrossSection,
    Temperature,
    AlbedoR,
    AlbedoG,
    AlbedoB,
    EmissionR,
    EmissionG,
    EmissionB,
    FireShare,
    Heat,
    Age,
    Count
};
}

/// Indices of the constants of a group.
namespace blob_constant {
enum : size_t
{
    Layer, ///< MediaLayer of the part of opacity and light that FireShare does not assign to the layer Fire
    DetailAmount, ///< [1] strength of procedural detail, 0 shows the bare kernel
    DetailScale,  ///< [1] periods of the noise per diameter of a blob
    Anisotropy,   ///< [1] mean cosine g of the Henyey-Greenstein phase function, (-1, 1)
    Shutter,      ///< [s] exposure time for motion blur; 0: no motion blur
    /// [1] 1 minus the tint of the instance, which multiplies the luminance of black bodies; the columns of
    /// albedo and emission are tinted already
    ShadeR,
    ShadeG,
    ShadeB,
    Count
};
}

/// Layers to which media are assigned. The order of the enumerators is the order of the EXR layers, not the
/// order of drawing.
enum class MediaLayer : uint32_t
{
    Fire,
    Smoke,
    Dust,
    Count
};

inline constexpr ColumnDesc kBlobColumns[blob_column::Count] = {
    {"x", "m"},
    {"y", "m"},
    {"z", "m"},
    {"vx", "m/s"},
    {"vy", "m/s"},
    {"vz", "m/s"},
    {"radius", "m"},
    {"crossSection", "m2"},
    {"temperature", "K"},
    {"albedoR", "1"},
    {"albedoG", "1"},
    {"albedoB", "1"},
    {"emissionR", "cd/m2"},
    {"emissionG", "cd/m2"},
    {"emissionB", "cd/m2"},
    {"fireShare", "1"},
    {"heat", "K"},
    {"age", "s"},
};

inline constexpr ColumnDesc kBlobConstants[blob_constant::Count] = {
    {"layer", "1"},   {"detailAmount", "1"}, {"detailScale", "1"}, {"anisotropy", "1"},
    {"shutter", "s"}, {"shadeR", "1"},       {"shadeG", "1"},      {"shadeB", "1"},
};

/// [1] Tint of the instance. @param shade index of the constant ShadeR of a kind of media
inline glm::vec3 tintOf(std::span<const float> constants, size_t shade = blob_constant::ShadeR)
{
    return {1.0f - constants[shade], 1.0f - constants[shade + 1], 1.0f - constants[shade + 2]};
}

inline constexpr KindDesc kBlobKind{"blob", kBlobColumns, kBlobConstants};

} // namespace fx::base
