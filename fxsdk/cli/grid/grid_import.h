/// @file grid_import.h
/// Grids of numbers from the files of other programs.
#pragma once

#include "foundation/result/status.h"
#include "simulation/particles/fields/field_grid.h"

#include <string_view>

namespace fx::cli {

/// Points of a regular grid as lines `x,y,z,value` or `x,y,z,vx,vy,vz` [m], in any order, each place once;
/// also separated by blanks, semicolons or tabs. A first line without numbers is skipped, as are empty lines
/// and those that begin with '#'.
/// @return Parse with the line, TooLarge
base::Result<sim::FieldGrid> gridFromCsv(std::string_view text);

/// binary32 numbers, little endian, channels fastest, then x, y, z.
/// @param shape nodes, channels, low and cell are those of the result
/// @return Parse when the number of bytes differs, TooLarge
base::Result<sim::FieldGrid> gridFromRaw(std::string_view bytes, const sim::FieldGrid& shape);

} // namespace fx::cli
