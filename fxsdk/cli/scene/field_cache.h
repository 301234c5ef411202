/// @file field_cache.h
/// Fields of distances that lie beside the meshes they were made from, so that a scene starts at once.
///
/// A file holds the field of one mesh, at one place and size, with one size of cells, in the byte order of
/// the machine. A file is verified before use: it names a hash of the mesh, which determines its size, and
/// another hash covers its values. An invalid file is ignored and replaced; where that fails, as in a
/// read-only folder, the field is computed each time, without a message. Threads: any. Programs that write
/// one file at once each put a whole file in place.
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

/// Reads the field of a mesh from `file`, or builds it and writes the file. Throws std::bad_alloc.
/// @param file see fieldFileOf(); empty: the field is built and not written
/// @return the error of sim::DistanceField::build()
base::Result<std::shared_ptr<const sim::DistanceField>> fieldOf(const sim::TriangleMesh& mesh, float cellSize,
                                                                const std::filesystem::path& file,
                                                                base::TaskRunner& tasks,
                                                                std::pmr::memory_resource* memory);

} // namespace fx::cli
