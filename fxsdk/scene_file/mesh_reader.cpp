#include "fxsdk/scene_file/mesh_reader.h"

#include "foundation/math/bits.h"
#include "fxsdk/presets/diagnostic.h"
#include "fxsdk/scene_file/scene_file.h"

#include <glm/geometric.hpp>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <sstream>

namespace fx::scene_file {

namespace {

constexpr float kLargestCoordinate = 1e6f; // [m]

/// Hands material files to the OBJ parser through the resolver, so that the rules of assets apply.
class ResolvedMaterials final : public tinyobj::MaterialReader
{
public:
    ResolvedMaterials(const asset::AssetResolver& resolver, std::string folder)
        : resolver_(resolver), folder_(std::move(folder))
    {}

    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* indices, std::string* warning, std::string* error) override
    {
        const base::Result<std::string> text = resolver_.read(folder_ + name, kMeshBytes);
        if (!text) {
            *warning += text.status().message() + "\n";
            return false;
        }
        std::istringstream stream(*text);
        tinyobj::LoadMtl(indices, materials, &stream, warning, error);
        return true;
    }

private:
    const asset::AssetResolver& resolver_;
    std::string folder_;
};

struct ParsedObject
{
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
};

base::Status parseFailure(const std::string& name, const std::string& why)
{
    return {base::Code::Parse, "mesh \"" + name + "\": " + preset::printable(why, 400)};
}

/// Triangles that the faces of an OBJ text will become, counted before the parser allocates for them; nothing
/// when a face has so many corners that cutting it up would take minutes.
std::optional<size_t> countTriangles(std::string_view text)
{
    constexpr size_t kMostCorners = 1024;
    size_t triangles = 0;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        const size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string_view::npos || line[first] != 'f')
            continue;
        size_t words = 0;
        for (size_t i = first; i < line.size(); ++i)
            words += line[i] > ' ' && (i == 0 || line[i - 1] <= ' ') ? 1 : 0;
        if (words > kMostCorners + 1)
            return std::nullopt;
        triangles += words > 3 ? words - 3 : 0;
    }
    return triangles;
}

base::Status checkFaces(const std::string& name, std::string_view text)
{
    const std::optional<size_t> triangles = countTriangles(text);
    if (!triangles)
        return {base::Code::TooLarge, "mesh \"" + name + "\" has a face with more than 1024 corners"};
    if (*triangles == 0)
        return parseFailure(name, "has no triangles");
    if (*triangles > kMostTriangles)
        return {base::Code::TooLarge, "mesh \"" + name + "\" has " + std::to_string(*triangles) +
                                          " triangles; at most 1000000 are read"};
    return {};
}

glm::vec3 position(const tinyobj::attrib_t& attributes, int index)
{
    const float* v = attributes.vertices.data() + 3 * size_t(index);
    return {v[0], v[1], v[2]};
}

bool isUsable(const glm::vec3& v)
{
    return base::isFinite(v.x) && base::isFinite(v.y) && base::isFinite(v.z) &&
           std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kLargestCoordinate;
}

/// The normal that the file gives, or `face` when it gives none that is usable.
glm::vec3 normalOr(const glm::vec3& face, const tinyobj::attrib_t& attributes, int index)
{
    if (index < 0 || 3 * size_t(index) + 2 >= attributes.normals.size())
        return face;
    const float* n = attributes.normals.data() + 3 * size_t(index);
    const glm::vec3 normal(n[0], n[1], n[2]);
    const float length = glm::length(normal);
    return isUsable(normal) && length > 1e-6f ? normal / length : face;
}

glm::vec3 colorOf(const std::vector<tinyobj::material_t>& materials, int index)
{
    if (index < 0 || size_t(index) >= materials.size())
        return glm::vec3(0.5f);
    const float* diffuse = materials[size_t(index)].diffuse;
    return glm::clamp(glm::vec3(diffuse[0], diffuse[1], diffuse[2]), 0.0f, 1.0f);
}

/// Adds triangle `t` of `shape`; leaves out one that has no area. False when it names a vertex that does not
/// exist.
bool addTriangle(const ParsedObject& object, const tinyobj::mesh_t& shape, size_t t, render::StageMesh& mesh)
{
    const size_t vertexCount = object.attributes.vertices.size() / 3;
    std::array<glm::vec3, 3> corners;
    for (size_t k = 0; k < 3; ++k) {
        const int index = shape.indices[3 * t + k].vertex_index;
        if (index < 0 || size_t(index) >= vertexCount)
            return false;
        corners[k] = position(object.attributes, index);
        if (!isUsable(corners[k]))
            return false;
    }
    const glm::vec3 cross = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const float area = glm::length(cross);
    if (!(area > 0.0f))
        return true;
    const glm::vec3 color =
        colorOf(object.materials, t < shape.material_ids.size() ? shape.material_ids[t] : -1);
    for (size_t k = 0; k < 3; ++k) {
        mesh.positions.push_back(corners[k]);
        mesh.normals.push_back(
            normalOr(cross / area, object.attributes, shape.indices[3 * t + k].normal_index));
        mesh.colors.push_back(color);
    }
    return true;
}

} // namespace

base::Result<render::StageMesh> readMesh(const std::string& name, const asset::AssetResolver& resolver,
                                         std::string& outWarning)
{
    const base::Result<std::string> text = resolver.read(name, kMeshBytes);
    if (!text)
        return text.status();
    if (base::Status status = checkFaces(name, *text); !status)
        return status;
    ParsedObject object;
    ResolvedMaterials materials(resolver, name.starts_with("library:") ? "library:"
                                                                       : name.substr(0, name.rfind('/') + 1));
    std::istringstream stream(*text);
    std::string error;
    if (!tinyobj::LoadObj(&object.attributes, &object.shapes, &object.materials, &outWarning, &error, &stream,
                          &materials, true))
        return parseFailure(name, error.empty() ? "cannot be parsed" : error);

    render::StageMesh mesh;
    for (const tinyobj::shape_t& shape : object.shapes)
        for (size_t t = 0; t < shape.mesh.indices.size() / 3; ++t)
            if (!addTriangle(object, shape.mesh, t, mesh))
                return parseFailure(name, "a triangle names a vertex that does not exist or is not finite");
    if (mesh.positions.empty())
        return parseFailure(name, "has no triangles with an area");
    return mesh;
}

} // namespace fx::scene_file
