/// @file vdb_reader.h
/// Reads the medium of an OpenVDB file.
///
/// OpenVDB trusts the files that it reads: a damaged one may end the process or demand any amount of memory.
/// Therefore readVdb() is called in a process of its own with limits. It allocates nothing for a grid before
/// the type of its tree, and the sizes that the file states, have been checked; the real numbers of voxels
/// and blocks are checked again before the grid is copied. It starts no threads.
#pragma once

#include "foundation/result/status.h"
#include "rendering/voxelization/medium_grid.h"

#include <cstdint>
#include <optional>
#include <string>

namespace fx::render {

/// Which grids are read, and in which units they are. A name that is empty stands for the usual ones.
struct VdbReadOptions
{
    std::string density;           ///< empty: "density"
    std::string temperature;       ///< empty: "temperature", if there is one
    std::string flame;             ///< empty: "flame", "heat" or "flames", if there is one
    std::string color;             ///< empty: "Cd" or "color", if there is one
    std::string velocity;          ///< empty: "v", "vel" or "velocity", if there is one
    double densityScale = 1.0;     ///< [1/m] extinction of density 1, or inside of a level set
    double temperatureScale = 1.0; ///< [K] of temperature 1
    double flameScale = 1.0;       ///< [cd/m3] of flame 1
    double lengthScale = 1.0;      ///< [m] of a unit of the file's world space
    /// [1] Mean cosine of the scattering angle; nothing: metadata "anisotropy" of the file, or 0 without them
    std::optional<double> anisotropy;
    uint64_t maxVoxels = uint64_t(64) << 20; ///< active ones of a grid
    uint64_t maxBytes = uint64_t(2) << 30;   ///< [byte] of the result
};

/// Reads the grid of densities, and the others where it has voxels.
///
/// Densities are a fog volume, or a level set, whose voxels have the share of their volume that is inside.
/// The other grids may have other voxels: they are interpolated at the centers of those of the densities.
/// Values that are not finite or are negative become 0, with a warning.
/// @return NotFound for a missing file or grid, with the grids that are there; Schema for a type of tree or a
///         transform that is not supported, TooLarge, OutOfMemory, Parse with the message of OpenVDB
base::Result<MediumGrid> readVdb(const std::string& path, const VdbReadOptions& options);

} // namespace fx::render
