/// @file group_tint.h
/// Applies the tint of an instance to the groups that its solvers have published.
///
/// @formula instance-tint
/// Light of the elements of an instance with a tint.
///
/// symbol   unit    meaning
///   t        1       tint of the instance, for each color, 0..1
///   a        1       albedo of the medium, 0..1
///   E, B     cd/m2   emission, and luminance of a black body of the temperature
///   c        1       color of a sprite, mesh, or ribbon
///   I        cd      intensity of a light
/// @derivation
///   A tint is a filter: it multiplies what is scattered and what is emitted
///       a' = t a                                                                            (1)
///       source' = t ((1 - a') B + E)                                                        (2)
///       c' = t c,  I' = t I                                                                 (3)
///   As 0 <= t <= 1, no medium scatters more light than it gets, and none emits more than a black body. A
///   color is a factor of both emitted and scattered light. Extinction, opacity and temperature do not
///   change. Columns hold a', t E, c' and I'. Readers of temperatures multiply B by t, which is 1 minus the
///   constants "shade".
/// @source    elementary
/// @deviation voxels: (1 - a) in place of (1 - a') in (2), because a volume stores one light for both terms
/// @valid     0 <= t <= 1
/// @accuracy  rounding of one product; c' is a binary16 number
/// @tests     tests/api/test_tint.cpp
#pragma once

#include "foundation/snapshot/frame_snapshot.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace fx::sim {

/// Applies `tint` to the groups from number `first` on.
/// @return number of rows that were changed
uint64_t tintGroups(const glm::vec3& tint, size_t first, base::FrameSnapshot& io);

} // namespace fx::sim
