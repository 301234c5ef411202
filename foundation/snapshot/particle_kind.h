/// @file particle_kind.h
/// The kinds "particle", "ribbon" and "light", which emitters publish besides media. The technique that
/// writes these kinds, and the passes and hosts that draw them, include this header; the snapshot container
/// does not.
///
/// A particle keeps its row for its lifetime. A row of radius 0 is empty. Row i of two successive snapshots
/// is the same particle under two conditions. The row contains a particle in both snapshots. The age in the
/// newer snapshot is at least the time between the snapshots. Consecutive rows of a ribbon with the same
/// strip are joined.
///
/// A color is four binary16 numbers, red in the lowest 16 bits, then green, blue, opacity. Red, green and
/// blue are linear Rec. 709 and not multiplied by the opacity. The visible luminance is color * (luminance +
/// lit * illuminance of the particle / pi).
#pragma once

#include "foundation/snapshot/snapshot_schema.h"

namespace fx::base {

/// Indices of the columns of the kind "particle". Columns after Color exist only for emitters that need these
/// columns.
namespace particle_column {
enum : size_t
{
    PositionX,
    PositionY,
    PositionZ,
    Age,
    Radius,
    Color,
    VelocityX,
    VelocityY,
    VelocityZ,
    Angle,
    Frame,
    OrientationX,
    OrientationY,
    OrientationZ,
    OrientationW,
    Index,
    Count
};

/// The columns that every group of the kind has.
constexpr uint64_t kAlways = (uint64_t(1) << VelocityX) - 1;
constexpr uint64_t kVelocity = uint64_t(7) << VelocityX;
constexpr uint64_t kAngle = uint64_t(1) << Angle;
constexpr uint64_t kFrame = uint64_t(1) << Frame;
constexpr uint64_t kOrientation = uint64_t(15) << OrientationX;
constexpr uint64_t kIndex = uint64_t(1) << Index;
} // namespace particle_column

/// Indices of the columns of the kind "ribbon". Elements are points along strips, the newest first in each
/// strip.
namespace ribbon_column {
enum : size_t
{
    PositionX,
    PositionY,
    PositionZ,
    HalfWidth,
    Arc, ///< length along the path since birth; if ArcPerTile is 0: 0 at the end of the strip, 1 at its head
    Color,
    Strip,
    Age, ///< age of the particle
    Count
};
}

/// Indices of the columns of the kind "light".
namespace light_column {
enum : size_t
{
    PositionX,
    PositionY,
    PositionZ,
    IntensityR,
    IntensityG,
    IntensityB,
    Count
};
}

/// Geometry with which a particle is drawn.
enum class ParticleShape : uint32_t
{
    Sprite, ///< a textured square
    Mesh,   ///< an instanced mesh
};

/// Blending with the background.
enum class ParticleBlend : uint32_t
{
    Alpha,    ///< the particle covers the background in proportion to its opacity
    Additive, ///< the light of the particle times its opacity is added to the background
    Opaque,   ///< the particle is opaque where its opacity is at least one half, and writes depth
};

/// Orientation of the quad of a sprite.
enum class SpriteAlignment : uint32_t
{
    Camera, ///< faces the camera
    /// The vertical axis of the quad is along the velocity; the quad is rotated about it to face the camera.
    Velocity,
    /// The vertical axis of the quad is along a fixed axis; the quad is rotated about it to face the camera.
    Axis,
    Plane, ///< the quad lies in the plane normal to the axis
};

/// Order in which the rows of a group are drawn.
enum class ParticleOrder : uint32_t
{
    None,     ///< the rows are drawn in the order in which they are stored
    Depth,    ///< the farthest first
    Oldest,   ///< the oldest first
    Youngest, ///< the youngest first
};

/// Indices of the constants of a group of the kind "particle" or "ribbon".
namespace particle_constant {
enum : size_t
{
    Shape, ///< ParticleShape
    Layer, ///< MediaLayer to which light and opacity are added
    Blend, ///< ParticleBlend
    Order, ///< ParticleOrder
    /// [m] If > 0, the group is sorted as if the group were nearer to the camera by this length.
    OrderBias,
    Alignment, ///< SpriteAlignment
    AxisX,     ///< [1] local unit vector of the alignments Axis and Plane
    AxisY,     ///< [1]
    AxisZ,     ///< [1]
    /// [1] Width of a sprite divided by its height, > 0; the radius of the particle is half the height.
    Aspect,
    /// [s] With the alignment Velocity, a sprite is longer by speed times Stretch. The texture coordinate v
    /// increases along the velocity.
    Stretch,
    Luminance,   ///< [cd/m2] luminance that color 1 emits
    Lit,         ///< [1] fraction of the scene's light that color 1 scatters, 0..1
    Softness,    ///< [m] depth over which a particle fades where it intersects opaque surfaces; 0: hard edge
    Texture,     ///< id of the texture in the AssetTable; 0: a round spot that fades towards its edge
    TileColumns, ///< [1] number of frames of the texture side by side, >= 1
    TileRows,    ///< [1] number of frames of the texture above each other, >= 1
    /// 1: the two nearest frames are mixed, with the fractional part of Frame as weight; 0: the frame
    /// floor(Frame) is shown.
    FrameBlend,
    Motion, ///< id in the AssetTable of the texture of motion vectors (red, green; 0.5 is no motion); 0: none
    MotionScale, ///< [1] displacement by a motion vector of length 1, in widths of a frame
    Mesh,        ///< id of the mesh in the AssetTable; 0: none
    ArcPerTile,  ///< [m] length of a ribbon per width of the texture; 0: the texture covers the whole strip
    Edge,        ///< [1] fraction of a ribbon's half width over which its edges fade, 0..1
    /// [s] age at which a ribbon ends. Rows of greater age are not drawn. They serve the
    /// interpolation to earlier moments.
    TailAge,
    Count
};
}

inline constexpr ColumnDesc kParticleColumns[particle_column::Count] = {
    {"x", "m"},      {"y", "m"},
    {"z", "m"},      {"age", "s"},
    {"radius", "m"}, {"color", "1", ColumnType::U64},
    {"vx", "m/s"},   {"vy", "m/s"},
    {"vz", "m/s"},   {"angle", "rad"},
    {"frame", "1"},  {"qx", "1"},
    {"qy", "1"},     {"qz", "1"},
    {"qw", "1"},     {"index", "1", ColumnType::U64},
};

inline constexpr ColumnDesc kRibbonColumns[ribbon_column::Count] = {
    {"x", "m"},
    {"y", "m"},
    {"z", "m"},
    {"halfWidth", "m"},
    {"arc", "m"},
    {"color", "1", ColumnType::U64},
    {"strip", "1", ColumnType::U64},
    {"age", "s"},
};

inline constexpr ColumnDesc kLightColumns[light_column::Count] = {
    {"x", "m"}, {"y", "m"}, {"z", "m"}, {"intensityR", "cd"}, {"intensityG", "cd"}, {"intensityB", "cd"},
};

inline constexpr ColumnDesc kParticleConstants[particle_constant::Count] = {
    {"shape", "1"},     {"layer", "1"},      {"blend", "1"},   {"order", "1"},
    {"orderBias", "m"}, {"alignment", "1"},  {"axisX", "1"},   {"axisY", "1"},
    {"axisZ", "1"},     {"aspect", "1"},     {"stretch", "s"}, {"luminance", "cd/m2"},
    {"lit", "1"},       {"softness", "m"},   {"texture", "1"}, {"tileColumns", "1"},
    {"tileRows", "1"},  {"frameBlend", "1"}, {"motion", "1"},  {"motionScale", "1"},
    {"mesh", "1"},      {"arcPerTile", "m"}, {"edge", "1"},    {"tailAge", "s"},
};

inline constexpr KindDesc kParticleKind{"particle", kParticleColumns, kParticleConstants, false};
inline constexpr KindDesc kRibbonKind{"ribbon", kRibbonColumns, kParticleConstants, false};
inline constexpr KindDesc kLightKind{"light", kLightColumns, {}, false};

} // namespace fx::base
