/// @file material_kind.h
/// The kind "material": noise coordinates of balls of medium. The detail of the density field, the sum over
/// all balls, is evaluated at these coordinates. The detail therefore moves with the medium. Techniques that
/// publish media and passes that draw media as fields include this header; the snapshot container does not.
///
/// A group of this kind follows the group of the kind "blob" of the same solver, and has the same elements in
/// the same order. A solver publishes this kind only if its preset sets the detail of the field.
///
/// There are two generations of coordinates. The generation of number n has the columns Place0 for even n,
/// Place1 for odd n. The coordinate at a point x is the mean of growth (x - position) + place over the balls
/// at x, weighted by their extinction. The noise is evaluated at this coordinate divided by the length of the
/// generation. The younger generation has the weight Fade, the older 1 - Fade. Generation + Fade changes
/// linearly between two snapshots. The place of a ball is constant during a generation, but for balls that
/// move within a block (block_kind.h): their place changes linearly between two snapshots.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"

namespace fx::base {

/// Indices of the columns of the kind.
namespace material_column {
enum : size_t
{
    Place0X,
    Place0Y,
    Place0Z,
    Place1X,
    Place1Y,
    Place1Z,
    Count
};
}

/// Indices of the constants of a group.
namespace material_constant {
enum : size_t
{
    Generation, ///< [1] number of the younger generation modulo kGenerationCycle
    Fade,       ///< [1] weight of the younger generation, 0 .. 1
    Length0,    ///< [m] size of the largest lumps of the generation in the columns Place0
    Length1,    ///< [m] size of the largest lumps of the generation in the columns Place1
    Growth0,    ///< [1] radius of balls when the generation of Place0 began, divided by their present radius
    Growth1,
    Thinnest, ///< [1] optical depth of a lump below which the medium is removed completely
    Densest,  ///< [1] optical depth of a lump above which the medium is not eroded
    Ramp,     ///< [1] width of the erosion threshold; small values give crisp edges
    Gain,     ///< [1] amplitude of each octave of the noise, divided by that of the previous octave
    Cooling,  ///< [1] share of the temperature that is lost at the surface of lumps
    Glow,     ///< [1] relative rise of temperature where the noise is one standard deviation above its mean
    /// [1] Softening of edges as the medium thins. At 0, lumps fall apart; at 1, lumps keep their form; above
    /// 1, lumps blur.
    Softening,
    /// [1] 0: the extinction of the group is multiplied so that its total is that without detail; 1: what
    /// detail removes is lost
    Lossy,
    Count
};
}

constexpr uint32_t kGenerationCycle = 1u << 20; ///< modulus of the numbers of generations; exact in a float

inline constexpr ColumnDesc kMaterialColumns[material_column::Count] = {
    {"place0X", "m"}, {"place0Y", "m"}, {"place0Z", "m"},
    {"place1X", "m"}, {"place1Y", "m"}, {"place1Z", "m"},
};

inline constexpr ColumnDesc kMaterialConstants[material_constant::Count] = {
    {"generation", "1"}, {"fade", "1"},     {"length0", "m"},   {"length1", "m"}, {"growth0", "1"},
    {"growth1", "1"},    {"thinnest", "1"}, {"densest", "1"},   {"ramp", "1"},    {"gain", "1"},
    {"cooling", "1"},    {"glow", "1"},     {"softening", "1"}, {"lossy", "1"},
};

inline constexpr KindDesc kMaterialKind{"material", kMaterialColumns, kMaterialConstants};

} // namespace fx::base
