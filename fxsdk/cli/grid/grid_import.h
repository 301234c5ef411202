/// @file grid_import.h
/// Imports grids of numbers from files of other programs.
#pragma once

#include "foundation/result/status.h"
#include "simulation/particles/fields/field_grid.h"

#include <string_view>

namespace fx::cli {

/// Reads the points of a regular grid as lines `x,y,z,value` or `x,y,z,vx,vy,vz`, with x, y, z in [m]. The
/// lines may have any order, but each point occurs once. Spaces, semicolons or tabs also separate numbers.
/// A first line without numbers is skipped, as are empty lines and lines that begin with '#'.
/// @return Parse with the line, TooLarge
base::Result<sim::FieldGrid> gridFromCsv(std::string_view text);

/// Reads little-endian binary32 numbers. The channels of a node are consecutive; then x varies fastest,
/// then y, then z.
/// @param shape gives nodes, channels, low and cell of the result
/// @return Parse when the number of bytes does not fit `shape`, TooLarge
base::Result<sim::FieldGrid> gridFromRaw(std::string_view bytes, const sim::FieldGrid& shape);

} // namespace fx::cli
