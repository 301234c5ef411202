/// @file field_cache.h
/// Caches distance fields in files beside their meshes, so that a scene starts without computing the fields.
///
/// A file holds the field of one mesh, with one position and scale and one cell size, in the byte order of
/// the machine. A file is verified before use by two hashes that the file contains: a hash of the mesh and a
/// hash of the values. An invalid file is ignored and replaced. If the file cannot be replaced, as in a
/// read-only folder, the field is computed each time, without a message. Threads: any. When several programs
/// write one file at once, each replaces the whole file atomically.
#pragma once

#include "foundation/result/status.h"
#include "simulation/collision/distance_field.h"

#include <filesystem>
#include <memory>
#include <memory_resource>

namespace fx::cli {

/// Path of the cached field of a mesh: beside the mesh, with the cell size in its name.
std::filesystem::path fieldFileOf(const std::filesystem::path& meshFile, const sim::TriangleMesh& mesh,
                                  float cellSize);

/// Reads the field of a mesh from `file`. If reading fails, builds the field and writes the file. Throws
/// std::bad_alloc.
/// @param file see fieldFileOf(); empty: the field is built and not written
/// @return the error of sim::DistanceField::build()
base::Result<std::shared_ptr<const sim::DistanceField>> fieldOf(const sim::TriangleMesh& mesh, float cellSize,
                                                                const std::filesystem::path& file,
                                                                base::TaskRunner& tasks,
                                                                std::pmr::memory_resource* memory);

} // namespace fx::cli
