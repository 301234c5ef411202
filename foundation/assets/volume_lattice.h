/// @file volume_lattice.h
/// Lattices of voxels along the same axes, and what is on one of them in terms of another.
#pragma once

#include "foundation/assets/voxel_volume.h"

#include <glm/vec3.hpp>

#include <vector>

namespace fx::base {

/// Places of voxels.
struct VolumeLattice
{
    glm::dvec3 origin{0.0}; ///< [m] center of the voxel (0, 0, 0)
    double side = 1.0;      ///< [m] side of a voxel, > 0

    bool operator==(const VolumeLattice&) const = default;
};

/// From places in voxels of one lattice to those of another.
struct LatticeMap
{
    double scale = 1.0;
    glm::dvec3 offset{0.0}; ///< [voxel]

    LatticeMap() = default;
    LatticeMap(const VolumeLattice& from, const VolumeLattice& to);
    glm::dvec3 operator()(const glm::dvec3& place) const { return scale * place + offset; }
    bool isSame() const { return scale == 1.0 && offset == glm::dvec3(0.0); }
};

/// Bricks on which voxels have medium where a volume on another lattice is interpolated, ascending by z, then
/// y, then x.
/// @param bricks of the volume  @param toVolume from voxels of the result to those of the volume
std::vector<glm::ivec3> bricksReached(const std::vector<glm::ivec3>& bricks, const LatticeMap& toVolume);

/// The same medium in the cells of another lattice, in the order of VolumeCells: each brick's medium is
/// shared among the bricks that it overlaps. The sum of all cross sections is
/// kept, but for bricks beyond kMaxVolumeBricksPerAxis, which are left out.
std::vector<VolumeCells> cellsOn(const VolumeLattice& to, const std::vector<VolumeCells>& cells,
                                 const VolumeLattice& from);

/// Adds to cells the share of others of the same brick.
void blendInto(VolumeCells& io, const VolumeCells& more, float share);

/// Order of cells and bricks.
bool isBefore(const glm::ivec3& a, const glm::ivec3& b);

} // namespace fx::base
