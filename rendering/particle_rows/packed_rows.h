/// @file packed_rows.h
/// Packed rows of particles for upload: 24 bytes, and 4 more with a velocity, 4 with a frame, 8 with an
/// orientation. shaders/shared/particle_fetch.glsl reads them.
///
/// Words of a row, each in a column of its own; numbers are those of ParticleBlock::newerAt:
///     0 1 2   position, binary32: exact
///     3       radius 17 bits, opacity 15 bits above them
///     4 5     red, green, blue 12 bits each and 5 bits of exponent, then the turn 12 bits, age 11 bits
///     6       velocity: 9 bits each and 5 bits of exponent; without an angle the turn holds 4 more bits each
///     10      frame, binary32: exact
///     11 12   orientation, 16 bits each
///     9       not there, or what tells that the turn is the angle;  15 what tells that rows are packed
///
/// Errors, at most; R, L, M: radius, length of the streak, distance flown in a step, in pixels:
///     radius      2^-12 of itself: 0.27 pixel for a sprite as high as a picture of 2160 lines
///     velocity    2^-12 of its largest component, with an angle 2^-8: L / 4096 pixels, or L / 256
///     angle       pi / 4096: R / 1304 pixels
///     color       2^-12 of its largest channel; opacity that of binary16, which it is published in
///     orientation 2^-16 for each component
///     age         births are seen up to 1/2048 s early; steps of one second or more are not told apart
///                 from the life before
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

/// Offsets of columns in words from the begin of a group; -1: absent.
using RowPlaces = std::array<int32_t, 16>;

/// Between two snapshots.
struct RowMoment
{
    float share = 1.0f;   ///< of the newer one
    float seconds = 0.0f; ///< between both
};

/// Lays out the packed rows of a group of the kind "particle".
/// @param room capacity in rows
/// @return size in words
uint64_t layOutPacked(const base::SnapshotGroup& group, uint64_t room, RowPlaces& out);
/// [byte] a row takes.
uint32_t packedRowBytes(const RowPlaces& places);

/// Writes rows of a group.
/// @param out where the group lies
void packRows(const base::SnapshotGroup& group, uint32_t first, uint32_t count, const RowPlaces& places,
              std::byte* out);
/// Writes the rows interpolated between two snapshots, equal to fetchParticle(). Rows of particles that are
/// not born yet become empty.
/// @param older the same group before
void packRowsBetween(const base::SnapshotGroup& newer, const base::SnapshotGroup& older,
                     const RowMoment& moment, uint32_t first, uint32_t count, const RowPlaces& places,
                     std::byte* out);

} // namespace fx::render
