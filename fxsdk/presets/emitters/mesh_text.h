/// @file mesh_text.h
/// Triangles of a Wavefront OBJ text, for what is simulated with them: positions only.
#pragma once

#include "foundation/result/status.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace fx::preset {

constexpr uint64_t kMostMeshText = uint64_t(64) << 20; ///< [byte]

struct MeshText
{
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices; ///< three a triangle
};

/// Reads `v` and `f` lines and passes over all others; polygons become fans of triangles.
/// @return Parse with the number of the line
base::Result<MeshText> readMeshText(std::string_view text);

} // namespace fx::preset
