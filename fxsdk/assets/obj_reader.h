/// @file obj_reader.h
/// Wavefront OBJ files: the lines of one, and from them meshes for particles and triangles for the
/// simulation. Curves, lines and smoothing groups are ignored.
#pragma once

#include "foundation/assets/asset_table.h"

#include <compare>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace fx::asset {

/// Points of an OBJ file that its faces refer to, up to the line that was read last.
struct ObjPoints
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> textures;
    std::vector<glm::vec3> normals;
};

/// Indices of the points of one corner of a face; -1: the file gives none.
struct ObjCorner
{
    int64_t position, texture = -1, normal = -1;
    auto operator<=>(const ObjCorner&) const = default;
};

/// Receives the lines of an OBJ file in their order. Functions that are not set are not called.
struct ObjHandler
{
    /// A polygon of at least three corners. A status with an error ends the reading.
    std::function<base::Status(const ObjPoints& points, std::span<const ObjCorner> corners)> face;

    /// The material of the faces that follow: usemtl.
    std::function<void(std::string_view name)> material;

    /// Files of materials, separated by blanks: mtllib.
    std::function<void(std::string_view names)> materialFiles;

    bool wantsTextures = true; ///< false: texture coordinates are ignored, also in corners
    bool wantsNormals = true;  ///< false: normals are ignored, also in corners
};

/// Reads all lines of `text`.
/// @return all points; Parse with the number of the line and the reason; the error of `face`
base::Result<ObjPoints> parseObj(std::string_view text, const ObjHandler& handler);

/// The next word of `io`, separated by blanks, which is taken off; empty at the end.
std::string_view takeWord(std::string_view& io);

/// False when `word` is no finite number. One that is too small for a float is 0.
bool parseFloat(std::string_view word, float& out);

struct ObjMesh
{
    std::vector<base::MeshVertex> vertices;
    std::vector<uint32_t> indices;
};

constexpr size_t kMaxMeshTriangles = 65'536; ///< an instanced mesh is drawn thousands of times

/// A mesh for particles. Polygons become fans; corners without a normal get that of their triangle.
/// @return Parse with the line and the reason, TooLarge
base::Result<ObjMesh> readObj(std::string_view text);

struct ObjTriangles
{
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices; ///< three a triangle
};

/// Reads positions only, for simulation. Polygons become fans.
/// @return Parse with the line and the reason
base::Result<ObjTriangles> readObjTriangles(std::string_view text);

} // namespace fx::asset
