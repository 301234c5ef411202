#include "fxsdk/scene_file/mesh_reader.h"

#include "foundation/math/bits.h"
#include "fxsdk/assets/obj_reader.h"
#include "fxsdk/presets/diagnostic.h"
#include "fxsdk/scene_file/scene_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace fx::scene_file {

namespace {

constexpr float kLargestCoordinate = 1e6f; // [m]
constexpr size_t kMaxCorners = 1024;       ///< of a face: cutting up one with more would take minutes

bool isUsable(const glm::vec3& v)
{
    return base::isFinite(v.x) && base::isFinite(v.y) && base::isFinite(v.z) &&
           std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= kLargestCoordinate;
}

struct Material
{
    glm::vec3 color{0.0f};
    bool isWater = false; ///< its illumination model is 7: reflection by Fresnel's equations
};

/// Materials by name.
using Materials = std::map<std::string, Material, std::less<>>;

/// Adds the materials of an MTL text; of several with one name the first counts.
void readMaterials(std::string_view text, Materials& io)
{
    Materials::iterator material = io.end();
    bool hasColor = false;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view rest = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string_view kind = asset::takeWord(rest);
        if (kind == "newmtl") {
            const auto [added, isNew] = io.emplace(std::string(asset::takeWord(rest)), Material());
            material = isNew ? added : io.end();
            hasColor = false;
        }
        if (material == io.end())
            continue;
        if (kind == "map_Kd" && !hasColor)
            material->second.color = glm::vec3(0.6f); // its picture is not read
        if (kind == "illum")
            material->second.isWater = asset::takeWord(rest) == "7";
        if (kind != "Kd")
            continue;
        hasColor = true;
        for (int i = 0; i < 3; ++i)
            if (float value = 0.0f; asset::parseFloat(asset::takeWord(rest), value))
                material->second.color[i] = glm::clamp(value, 0.0f, 1.0f);
    }
}

/// Cuts a polygon into triangles: a quadrilateral along its shorter diagonal, others ear by ear.
class Triangulation
{
public:
    using Triangle = std::array<size_t, 3>; ///< places in the polygon

    const std::vector<Triangle>& of(std::span<const glm::vec3> polygon)
    {
        triangles_.clear();
        if (polygon.size() == 3) {
            triangles_.push_back({0, 1, 2});
        } else if (polygon.size() == 4) {
            const glm::vec3 a = polygon[2] - polygon[0], b = polygon[3] - polygon[1];
            const bool isFirst = a.x * a.x + a.y * a.y + a.z * a.z < b.x * b.x + b.y * b.y + b.z * b.z;
            triangles_.push_back({0, 1, isFirst ? size_t(2) : size_t(3)});
            triangles_.push_back({isFirst ? size_t(0) : size_t(1), 2, 3});
        } else {
            clipEars(polygon);
        }
        return triangles_;
    }

private:
    /// Cuts off the middle one of three corners, as long as there are more than three. Any order is right for
    /// a convex polygon; that of tinyobjloader gives the same triangles.
    void clipEars(std::span<const glm::vec3> polygon)
    {
        flatten(polygon);
        rest_.clear();
        for (size_t i = 0; i < polygon.size(); ++i)
            rest_.push_back(i);
        const bool isConvex = std::ranges::all_of(rest_, [&](size_t i) {
            return turn(i, (i + 1) % polygon.size(), (i + 2) % polygon.size()) >= 0.0;
        });
        // Where no corner is an ear, as in a polygon that crosses itself, the next one is cut off all the
        // same.
        for (size_t first = 0, failed = 0; rest_.size() > 3;) {
            const size_t n = rest_.size();
            first %= n;
            const Triangle ear{rest_[first], rest_[(first + 1) % n], rest_[(first + 2) % n]};
            if (failed < n && !(isConvex ? turnsAroundOrigin(ear) : isEar(ear))) {
                ++first;
                ++failed;
                continue;
            }
            triangles_.push_back(ear);
            rest_.erase(rest_.begin() + std::ptrdiff_t((first + 1) % n));
            failed = 0;
        }
        triangles_.push_back({rest_[0], rest_[1], rest_[2]});
    }

    /// Drops the axis along which the polygon is thinnest, and turns it counterclockwise.
    void flatten(std::span<const glm::vec3> polygon)
    {
        glm::dvec3 area(0.0);
        for (size_t i = 0; i < polygon.size(); ++i)
            area += glm::cross(glm::dvec3(polygon[i]), glm::dvec3(polygon[(i + 1) % polygon.size()]));
        const glm::dvec3 size = glm::abs(area);
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        const float side = area[axis] < 0.0 ? -1.0f : 1.0f;
        flat_.clear();
        for (const glm::vec3& p : polygon)
            flat_.emplace_back(side * p[(axis + 1) % 3], p[(axis + 2) % 3]);
    }

    /// Twice the area of a triangle, positive where it is counterclockwise.
    double turn(size_t a, size_t b, size_t c) const
    {
        const glm::dvec2 ab = glm::dvec2(flat_[b]) - glm::dvec2(flat_[a]);
        const glm::dvec2 ac = glm::dvec2(flat_[c]) - glm::dvec2(flat_[a]);
        return ab.x * ac.y - ab.y * ac.x;
    }

    bool turnsAroundOrigin(const Triangle& ear) const
    {
        const glm::vec2 a = flat_[ear[0]], b = flat_[ear[1]];
        return a.x * b.y - a.y * b.x >= 0.0f;
    }

    bool isEar(const Triangle& ear) const
    {
        const auto [a, b, c] = ear;
        if (turn(a, b, c) <= 0.0)
            return false;
        return std::ranges::none_of(rest_, [&, a = a, b = b, c = c](size_t p) {
            return flat_[p] != flat_[a] && flat_[p] != flat_[b] && flat_[p] != flat_[c] &&
                   turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        });
    }

    std::vector<Triangle> triangles_;
    std::vector<glm::vec2> flat_;
    std::vector<size_t> rest_; ///< places that are not cut off yet
};

class MeshBuilder
{
public:
    MeshBuilder(const asset::AssetResolver& resolver, std::string folder, std::string& outWarning)
        : resolver_(resolver), folder_(std::move(folder)), warning_(outWarning)
    {}

    base::Status addFace(const asset::ObjPoints& points, std::span<const asset::ObjCorner> corners)
    {
        if (corners.size() > kMaxCorners)
            return {base::Code::TooLarge, "a face has more than 1024 corners"};
        polygon_.clear();
        for (const asset::ObjCorner& corner : corners) {
            polygon_.push_back(points.positions[size_t(corner.position)]);
            if (!isUsable(polygon_.back()))
                return {base::Code::Parse, "a corner of the face is farther than 1e6 m away"};
        }
        triangles_ += corners.size() - 2;
        if (triangles_ > kMaxTriangles)
            return {base::Code::TooLarge,
                    "more than the 1000000 triangles that are read: use a coarser mesh"};
        for (const Triangulation::Triangle& triangle : triangulation_.of(polygon_))
            addTriangle(points, corners, triangle);
        return {};
    }

    void useMaterial(std::string_view name)
    {
        const auto found = materials_.find(name);
        material_ = found == materials_.end() ? kNoMaterial : found->second;
        if (found == materials_.end())
            warning_ += "material \"" + std::string(name) + "\" is in none of the mesh's files\n";
    }

    /// Reads the first of the files that can be read.
    void useFiles(std::string_view names)
    {
        for (std::string_view name = asset::takeWord(names); !name.empty(); name = asset::takeWord(names)) {
            if (!files_.emplace(name).second)
                return;
            const base::Result<std::string> text = resolver_.read(folder_ + std::string(name), kMeshBytes);
            if (text)
                return readMaterials(*text, materials_);
            warning_ += text.status().message() + "\n";
        }
        warning_ += "faces without a material are gray\n";
    }

    bool hasTriangles() const { return triangles_ > 0; }
    /// The mesh, with the triangles of water behind the others.
    render::StageMesh take()
    {
        mesh_.waterVertices = water_.positions.size();
        mesh_.positions.insert(mesh_.positions.end(), water_.positions.begin(), water_.positions.end());
        mesh_.normals.insert(mesh_.normals.end(), water_.normals.begin(), water_.normals.end());
        mesh_.colors.insert(mesh_.colors.end(), water_.colors.begin(), water_.colors.end());
        return std::move(mesh_);
    }

private:
    static constexpr Material kNoMaterial{glm::vec3(0.5f)};

    /// Leaves out a triangle without an area.
    void addTriangle(const asset::ObjPoints& points, std::span<const asset::ObjCorner> corners,
                     const Triangulation::Triangle& triangle)
    {
        const auto place = [&](size_t k) { return polygon_[triangle[k]]; };
        const glm::vec3 cross = glm::cross(place(1) - place(0), place(2) - place(0));
        const float area = glm::length(cross);
        if (!(area > 0.0f))
            return;
        render::StageMesh& mesh = material_.isWater ? water_ : mesh_;
        for (size_t k = 0; k < 3; ++k) {
            mesh.positions.push_back(place(k));
            mesh.normals.push_back(normalOr(cross / area, points, corners[triangle[k]].normal));
            mesh.colors.push_back(material_.color);
        }
    }

    /// The normal that the file gives, or `face` when it gives none that is usable.
    static glm::vec3 normalOr(const glm::vec3& face, const asset::ObjPoints& points, int64_t index)
    {
        if (index < 0)
            return face;
        const glm::vec3 normal = points.normals[size_t(index)];
        const float length = glm::length(normal);
        return isUsable(normal) && length > 1e-6f ? normal / length : face;
    }

    const asset::AssetResolver& resolver_;
    std::string folder_;
    std::string& warning_;
    std::set<std::string, std::less<>> files_;
    Materials materials_;
    Material material_ = kNoMaterial;
    render::StageMesh mesh_;
    render::StageMesh water_;
    Triangulation triangulation_;
    std::vector<glm::vec3> polygon_;
    size_t triangles_ = 0;
};

} // namespace

base::Result<render::StageMesh> readMesh(const std::string& name, const asset::AssetResolver& resolver,
                                         std::string& outWarning)
{
    const auto fail = [&](base::Code code, const std::string& why) {
        return base::Status(code, "mesh \"" + name + "\": " + preset::printable(why, 400));
    };
    const base::Result<std::string> text = resolver.read(name, kMeshBytes);
    if (!text)
        return text.status();
    MeshBuilder builder(resolver,
                        name.starts_with("library:") ? "library:" : name.substr(0, name.rfind('/') + 1),
                        outWarning);
    asset::ObjHandler handler;
    handler.wantsTextures = false;
    handler.face = [&](const asset::ObjPoints& points, std::span<const asset::ObjCorner> corners) {
        return builder.addFace(points, corners);
    };
    handler.material = [&](std::string_view material) { builder.useMaterial(material); };
    handler.materialFiles = [&](std::string_view files) { builder.useFiles(files); };
    if (const auto points = asset::parseObj(*text, handler); !points)
        return fail(points.status().code(), points.status().message());
    if (!builder.hasTriangles())
        return fail(base::Code::Parse, "no triangle (no line begins with f)");
    render::StageMesh mesh = builder.take();
    if (mesh.positions.empty())
        return fail(base::Code::Parse, "no triangle has an area");
    return mesh;
}

} // namespace fx::scene_file
