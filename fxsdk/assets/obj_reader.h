/// @file obj_reader.h
/// Triangles of Wavefront OBJ files, for mesh particles. Materials, groups and curves are left aside.
///
/// Not by tinyobjloader, which reads stages for tools: it takes a coordinate that is missing or no number for
/// 0 without a word, and allocates before a limit could be checked.
#pragma once

#include "foundation/assets/asset_table.h"

#include <string_view>
#include <vector>

namespace fx::asset {

struct ObjMesh
{
    std::vector<base::MeshVertex> vertices;
    std::vector<uint32_t> indices;
};

constexpr size_t kMostMeshTriangles = 65'536; ///< an instanced mesh is drawn thousands of times

/// Polygons become fans; corners without a normal get that of their triangle.
/// @return Parse with the line and the reason, TooLarge
base::Result<ObjMesh> readObj(std::string_view text);

} // namespace fx::asset
