/// @file marker_kind.h
/// Snapshot data of markers, shared by both halves of the technique: the position of each, and their common
/// appearance.
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
