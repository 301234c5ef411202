/// @file list_entry.h
/// What a list of neighbors is made of.
#pragma once

#include <cstdint>

namespace fx::sim {

/// An entry of a list is a place (lower 29 bits) and, for the mirror image of that particle in a reflecting
/// wall, one bit for each mirrored axis. The wall is the one nearer to the particle that owns the list.
constexpr uint32_t kPlaceMask = (1u << 29) - 1;
constexpr uint32_t kMirrorX = 1u << 29; ///< kMirrorX << a for axis a

/// Lists are padded with the owner's own place to a multiple of this: the number of virtual lanes of every
/// sum over neighbors, whatever the processor's width.
constexpr uint32_t kLanes = 16;

} // namespace fx::sim
