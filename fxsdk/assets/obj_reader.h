/// @file obj_reader.h
/// Reads Wavefront OBJ files: line by line, as meshes for particles, or as triangles for the simulation.
/// Curves, lines and smoothing groups are ignored.
#pragma once

#include "foundation/assets/asset_table.h"

#include <compare>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace fx::asset {

/// Points of an OBJ file that have been read so far; faces refer to them by index.
struct ObjPoints
{
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> textures;
    std::vector<glm::vec3> normals;
};

/// Indices into ObjPoints of one corner of a face; -1 if the file gives no index.
struct ObjCorner
{
    int64_t position, texture = -1, normal = -1;
    auto operator<=>(const ObjCorner&) const = default;
};

/// Callbacks for the lines of an OBJ file, called in the order of the file. Unset callbacks are skipped.
struct ObjHandler
{
    /// A polygon of at least three corners. Reading ends when the callback returns an error.
    std::function<base::Status(const ObjPoints& points, std::span<const ObjCorner> corners)> face;

    /// The name of the material of the following faces (usemtl).
    std::function<void(std::string_view name)> material;

    /// Names of material files, separated by spaces (mtllib).
    std::function<void(std::string_view names)> materialFiles;

    bool wantsTextures = true; ///< false: texture coordinates are ignored, also in corners
    bool wantsNormals = true;  ///< false: normals are ignored, also in corners
};

/// Reads all lines of `text`.
/// @return all points; Parse with the number of the line and the reason; or the error that `face` returned
base::Result<ObjPoints> parseObj(std::string_view text, const ObjHandler& handler);

/// Removes the next word, delimited by spaces, from `io` and returns it; empty at the end.
std::string_view takeWord(std::string_view& io);

/// Parses a finite number; false if `word` is not a finite number. A number too small for a float becomes 0.
bool parseFloat(std::string_view word, float& out);

struct ObjMesh
{
    std::vector<base::MeshVertex> vertices;
    std::vector<uint32_t> indices;
};

/// maximum number of triangles of a particle mesh; the mesh is drawn thousands of times
constexpr size_t kMaxMeshTriangles = 65'536;

/// Reads a mesh for particles. Polygons become fans of triangles; a corner without a normal gets the normal
/// of its triangle.
/// @return the mesh, or an error with the code Parse or TooLarge
base::Result<ObjMesh> readObj(std::string_view text);

struct ObjTriangles
{
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices; ///< three indices per triangle
};

/// Reads positions only, for simulation. Polygons become fans of triangles.
/// @return Parse with the line and the reason
base::Result<ObjTriangles> readObjTriangles(std::string_view text);

} // namespace fx::asset
