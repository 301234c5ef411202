/// @file medium_cells.h
/// Divides the voxels of a grid into cells, one for each ball of a fit.
#pragma once

#include "rendering/voxelization/medium_grid.h"

#include <cstdint>
#include <vector>

namespace fx::render {

/// Mass, center and second moment of the medium of a cell.
struct MediumCell
{
    double mass = 0.0;      ///< [m2] integral of the extinction
    glm::dvec3 center{0.0}; ///< [m]
    double spread = 0.0;    ///< [m2] mean square of the distance from the center, of its voxels
};

/// Cubes of one size.
std::vector<MediumCell> uniformCells(const MediumGrid& grid, uint32_t most);

/// A k-d tree that splits the cell with the largest sum of extinction times visibility times squared distance
/// from its center first, in the middle of that weight. Visibility is the mean over the six directions of the
/// lattice's axes of the transmittance to the outside, and at least 1 % , so that also the inside has balls.
std::vector<MediumCell> adaptiveCells(const MediumGrid& grid, uint32_t most);

} // namespace fx::render
