/// @file marker_kind.h
/// Kind of snapshot data for markers: the position of each marker, and the common appearance of all markers.
/// Simulation and rendering share this file.
#pragma once

#include "foundation/snapshot/snapshot_schema.h"

namespace fx::test {

namespace marker {

inline constexpr base::ColumnDesc kColumns[] = {{"x", "m"}, {"y", "m"}, {"z", "m"}};
inline constexpr base::ColumnDesc kConstants[] = {
    {"halfSide", "m"}, {"red", "cd/m2"}, {"green", "cd/m2"}, {"blue", "cd/m2"}};

} // namespace marker

inline constexpr base::KindDesc kMarkerKind{"marker", marker::kColumns, marker::kConstants, false};

} // namespace fx::test
