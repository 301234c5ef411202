/// @file packed_rows.h
/// Packed rows of particles for upload. A row has 24 bytes, and 4 more with a velocity, 4 more with a frame,
/// 8 more with an orientation. shaders/shared/particle_fetch.glsl reads packed rows.
///
/// 32-bit words of a row. Each word has its own column; indices are those of ParticleBlock::newerAt:
///     0 1 2   position, binary32: exact
///     3       radius 17 bits, opacity 15 bits above them
///     4 5     red, green, blue 12 bits each and 5 bits of common exponent, then "turn" 12 bits, age 11 bits
///     6       velocity: 9 bits per component and 5 bits of common exponent
///     10      frame, binary32: exact
///     11 12   orientation, 16 bits for each of four components
///     9       no data; offset >= 0: "turn" is the angle; -1: "turn" has 4 more bits per velocity component
///     15      no data; offset >= 0: rows are packed
///
/// Largest errors, where R is the radius and L the length of a streak on the picture [pixel]:
///     radius      relative 2^-12: 0.27 pixel for a sprite as high as a picture of 2160 lines
///     velocity    2^-12 of its largest component, 2^-8 with an angle: L / 4096 or L / 256 pixels
///     angle       pi / 4096: R / 1304 pixels
///     color       2^-12 of its largest channel; opacity as in binary16, the format of snapshots
///     orientation 2^-16 for each component
///     age         1/2048 s: a birth may be visible this much too early. Ages are limited to one second, so
///                 with steps of one second or more, a row's previous particle is not recognized
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <array>
#include <cstdint>
#include <span>

namespace fx::render {

namespace packed_column {
enum : size_t
{
    Position = 0,
    Radius = 3,
    Color = 4,
    Velocity = 6,
    HasAngle = 9,
    Frame = 10,
    Orientation = 11,
    IsPacked = 15,
};
}

/// Offsets of the columns from the begin of the group, in 32-bit words; -1: the group does not have the
/// column.
using RowPlaces = std::array<int32_t, 16>;

/// A moment between two snapshots.
struct RowMoment
{
    float share = 1.0f;   ///< [1] weight of the newer snapshot
    float seconds = 0.0f; ///< [s] time between both snapshots
};

/// Computes the offsets of the columns of packed rows, for a group of the kind "particle".
/// @param room number of rows for which space is reserved
/// @return size of the packed rows in 32-bit words
uint64_t layOutPacked(const base::SnapshotGroup& group, uint64_t room, RowPlaces& out);
/// Returns the size of a row [byte].
uint32_t packedRowBytes(const RowPlaces& places);

/// Writes packed rows of a group.
/// @param out begin of the group's memory
void packRows(const base::SnapshotGroup& group, uint32_t first, uint32_t count, const RowPlaces& places,
              std::byte* out);
/// Writes packed rows that are interpolated between two snapshots. The formulas are those of the shader
/// function fetchParticle(). Rows of particles that are born after the moment become empty.
/// @param older the group in the older snapshot
void packRowsBetween(const base::SnapshotGroup& newer, const base::SnapshotGroup& older,
                     const RowMoment& moment, uint32_t first, uint32_t count, const RowPlaces& places,
                     std::byte* out);

} // namespace fx::render
