#include "simulation/collision/mesh_surface.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace fx::sim {

namespace {

using Corners = std::array<uint32_t, 3>; ///< welded vertices

/// Sets that grow together; each is called by its smallest member.
class Pieces
{
public:
    Pieces(size_t count, std::pmr::memory_resource* memory) : parent_(count, memory)
    {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    uint32_t find(uint32_t i)
    {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    void join(uint32_t a, uint32_t b)
    {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::pmr::vector<uint32_t> parent_;
};

/// For each position the first one at the same place.
std::pmr::vector<uint32_t> weld(std::span<const glm::vec3> positions, std::pmr::memory_resource* memory)
{
    std::pmr::vector<uint32_t> order(positions.size(), memory);
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](uint32_t i) { return std::tuple(positions[i].x, positions[i].y, positions[i].z); };
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::pmr::vector<uint32_t> first(positions.size(), memory);
    for (size_t k = 0; k < order.size(); ++k) {
        const bool isSame = k > 0 && key(order[k]) == key(order[k - 1]);
        first[order[k]] = isSame ? first[order[k - 1]] : order[k];
    }
    return first;
}

struct Edge
{
    uint32_t low, high; ///< welded vertices
    uint32_t triangle;
    int32_t way; ///< +1 from low to high, -1 back
};

std::pmr::vector<Edge> edgesOf(std::span<const Corners> triangles, std::pmr::memory_resource* memory)
{
    std::pmr::vector<Edge> edges(memory);
    edges.reserve(3 * triangles.size());
    for (uint32_t t = 0; t < triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), t, from < to ? 1 : -1});
        }
    std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
    return edges;
}

/// What decides whether a piece is a solid.
struct PieceShape
{
    double volume = 0; ///< [m3] enclosed, negative when its triangles face inwards
    bool isClosed = true;
    bool isSolid() const { return isClosed && volume > 0.0; }
};

/// A mesh without what has no area, with equal corners made one.
struct WeldedMesh
{
    WeldedMesh(const TriangleMesh& mesh, std::pmr::memory_resource* memory)
        : positions(mesh.positions), triangles(memory)
    {
        const std::pmr::vector<uint32_t> welded = weld(mesh.positions, memory);
        triangles.reserve(mesh.triangles());
        for (size_t t = 0; t < mesh.triangles(); ++t) {
            triangles.push_back(
                {welded[mesh.vertex(3 * t)], welded[mesh.vertex(3 * t + 1)], welded[mesh.vertex(3 * t + 2)]});
            const auto& [a, b, c] = triangles.back();
            if (a == b || b == c || c == a || !(glm::length(normal(uint32_t(triangles.size() - 1))) > 0.0))
                triangles.pop_back();
        }
    }
    glm::dvec3 at(uint32_t t, size_t k) const { return glm::dvec3(positions[triangles[t][k]]); }
    /// [m2] twice the area long
    glm::dvec3 normal(uint32_t t) const { return glm::cross(at(t, 1) - at(t, 0), at(t, 2) - at(t, 0)); }
    glm::vec3 unitNormal(uint32_t t) const { return glm::vec3(glm::normalize(normal(t))); }
    /// [rad] at corner k
    float angle(uint32_t t, size_t k) const
    {
        const glm::dvec3 u = glm::normalize(at(t, (k + 1) % 3) - at(t, k));
        const glm::dvec3 v = glm::normalize(at(t, (k + 2) % 3) - at(t, k));
        const double exact = std::acos(std::clamp(glm::dot(u, v), -1.0, 1.0));
        return float(std::round(exact * 1048576.0) / 1048576.0);
    }

    std::span<const glm::vec3> positions;
    std::pmr::vector<Corners> triangles;
};

std::pmr::vector<PieceShape> shapesOf(const WeldedMesh& mesh, std::span<const Edge> edges, Pieces& ioPieces,
                                      std::pmr::memory_resource* memory)
{
    const auto isSame = [&](size_t i, size_t j) {
        return edges[i].low == edges[j].low && edges[i].high == edges[j].high;
    };
    for (size_t i = 1; i < edges.size(); ++i)
        if (isSame(i - 1, i))
            ioPieces.join(edges[i - 1].triangle, edges[i].triangle);
    std::pmr::vector<PieceShape> shapes(mesh.triangles.size(), memory);
    int64_t sum = 0;
    for (size_t i = 0; i < edges.size(); ++i) {
        sum += edges[i].way;
        if (i + 1 < edges.size() && isSame(i, i + 1))
            continue;
        if (sum != 0)
            shapes[ioPieces.find(edges[i].triangle)].isClosed = false;
        sum = 0;
    }
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const uint32_t piece = ioPieces.find(t);
        const glm::dvec3 base = mesh.at(piece, 0); // near the piece, so that nothing cancels
        shapes[piece].volume += glm::dot(mesh.at(t, 0) - base, mesh.normal(t)) / 6.0;
    }
    return shapes;
}

/// (1) of each corner.
std::pmr::vector<glm::vec3> cornerNormals(const WeldedMesh& mesh, std::pmr::memory_resource* memory)
{
    std::pmr::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0.0f), memory);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (size_t k = 0; k < 3; ++k)
            normals[mesh.triangles[t][k]] += mesh.angle(t, k) * mesh.unitNormal(t); // (1)
    return normals;
}

/// (2) of the side from u to v.
glm::vec3 sideNormal(const WeldedMesh& mesh, std::span<const Edge> edges, uint32_t u, uint32_t v)
{
    const std::pair wanted(std::min(u, v), std::max(u, v));
    const auto first =
        std::lower_bound(edges.begin(), edges.end(), wanted,
                         [](const Edge& edge, const auto& w) { return std::pair(edge.low, edge.high) < w; });
    glm::vec3 sum(0.0f);
    for (auto edge = first; edge != edges.end() && std::pair(edge->low, edge->high) == wanted; ++edge)
        sum += mesh.unitNormal(edge->triangle); // (2)
    return sum;
}

} // namespace

MeshSurface sortTriangles(const TriangleMesh& given, std::pmr::memory_resource* memory)
{
    const WeldedMesh mesh(given, memory);
    const std::pmr::vector<Edge> edges = edgesOf(mesh.triangles, memory);
    Pieces pieces(mesh.triangles.size(), memory);
    const std::pmr::vector<PieceShape> shapes = shapesOf(mesh, edges, pieces, memory);
    const std::pmr::vector<glm::vec3> corners = cornerNormals(mesh, memory);
    MeshSurface surface(memory);
    for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const Triangle triangle{mesh.positions[a], mesh.positions[b], mesh.positions[c]};
        if (shapes[pieces.find(t)].isSolid()) {
            surface.solids.push_back(triangle);
            continue;
        }
        surface.sheets.push_back(triangle);
        surface.normals.push_back({corners[a], corners[b], corners[c], sideNormal(mesh, edges, a, b),
                                   sideNormal(mesh, edges, b, c), sideNormal(mesh, edges, c, a),
                                   mesh.unitNormal(t)}); // (3)
    }
    return surface;
}

} // namespace fx::sim
