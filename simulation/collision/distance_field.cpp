#include "simulation/collision/distance_field.h"

#include "foundation/math/hash.h"
#include "foundation/simd/floating_point_scope.h"
#include "simulation/collision/mesh_surface.h"
#include "simulation/collision/row_crossings.h"
#include "simulation/collision/triangle_tree.h"
#include "simulation/collision/winding_rows.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace fx::sim {

namespace {

constexpr uint32_t kMinRows = 2; ///< pairs of pairs of rows of nodes
constexpr float kShallow = 0.5f; ///< [cell] least depth of a node that is alone inside of matter
constexpr double kJustBeyond = 1.0 + 1e-9;
constexpr float kOnSurface = 1e-3f; ///< [cell] a node as near as this is on the surface, not outside

/// Everything that the distances of nodes are computed from.
struct FieldSources
{
    FieldSources(const MeshSurface& from, const DistanceGrid& nodes, std::pmr::memory_resource* memory)
        : grid(nodes), surface(from), solids(from.solids, memory), sheets(from.sheets, memory),
          winding(from.solids, nodes, memory)
    {}
    const DistanceGrid& grid;
    const MeshSurface& surface;
    TriangleTree solids;
    TriangleTree sheets;
    WindingRows winding;
};

/// Distance to the sheets, whose matter lies behind them.
double sheetDistance(const FieldSources& from, const glm::dvec3& p, const TriangleTree::Nearest& nearest)
{
    const double r = nearest.distance;
    if (nearest.triangle == TriangleTree::kNone)
        return r;
    const glm::dvec3 n(from.surface.normals[nearest.triangle][size_t(nearest.feature)]);
    const bool isFront = glm::dot(p - nearest.point, n) >= 0.0;
    return isFront ? r : std::max(-r, r - 2.0 * double(from.grid.cell)); // (2)
}

/// Nodes that are computed together, two along each axis. Beyond the last node of an axis stands that node
/// again.
struct NodePacket
{
    NodePacket(const DistanceGrid& grid, uint32_t x, uint32_t y, uint32_t z)
    {
        const glm::uvec3 last = grid.nodes - 1u;
        for (uint32_t k = 0; k < kPacketPoints; ++k) {
            node[k] = glm::min(glm::uvec3(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)), last);
            place[k] = grid.place(node[k].x, node[k].y, node[k].z);
            points.x[k] = place[k].x;
            points.y[k] = place[k].y;
            points.z[k] = place[k].z;
        }
    }
    glm::uvec3 node[kPacketPoints];
    glm::dvec3 place[kPacketPoints]; ///< [m]
    PointPacket points;
};

/// What the last packet was nearest to is near the next one too.
struct Guesses
{
    uint32_t solid = 0, sheet = 0; ///< places in the trees
};

/// Distance of point `k` to the sheets. Where several triangles are equally near and disagree on the side,
/// the one that the tree finds first decides.
double sheetDistance(const FieldSources& from, const glm::dvec3& p, const PacketNearest& found, uint32_t k)
{
    const TriangleTree::Nearest nearest = from.sheets.at(found.triangle[k], p);
    const double distance = sheetDistance(from, p, nearest);
    const uint32_t equals = found.equals[k];
    bool isSure = equals <= PacketNearest::kMaxEqualTriangles;
    for (uint32_t i = 0; isSure && i < equals; ++i) {
        const uint32_t other = found.equal[k * PacketNearest::kMaxEqualTriangles + i];
        isSure = sheetDistance(from, p, from.sheets.at(other, p)) == distance;
    }
    return isSure ? distance : sheetDistance(from, p, from.sheets.nearest(p, nearest.distance * kJustBeyond));
}

void addSheets(const FieldSources& from, const NodePacket& packet, uint32_t& ioGuess, double* ioDistances)
{
    PacketNearest found;
    from.sheets.nearest(packet.points, ioGuess, found);
    for (uint32_t k = 0; k < kPacketPoints; ++k)
        ioDistances[k] = std::min(ioDistances[k], sheetDistance(from, packet.place[k], found, k)); // (1)
    ioGuess = found.triangle[kPacketPoints - 1];
}

void addSolids(const FieldSources& from, const NodePacket& packet, uint32_t& ioGuess, double* ioDistances)
{
    PacketNearest found;
    from.solids.nearest(packet.points, ioGuess, found);
    for (uint32_t k = 0; k < kPacketPoints; ++k) {
        const double s = std::sqrt(found.squared[k]);
        const bool isInside = from.winding.isInside(packet.place[k].x, packet.node[k].y, packet.node[k].z);
        ioDistances[k] = std::min(ioDistances[k], isInside ? -s : s); // (1)
    }
    ioGuess = found.triangle[kPacketPoints - 1];
}

/// The nodes of the rows y, y + 1 at z, z + 1.
void computeRows(const FieldSources& from, uint32_t y, uint32_t z, float* outValues)
{
    const DistanceGrid& grid = from.grid;
    Guesses guesses;
    for (uint32_t x = 0; x < grid.nodes.x; x += 2) {
        const NodePacket packet(grid, x, y, z);
        double distances[kPacketPoints];
        std::fill_n(distances, kPacketPoints, std::numeric_limits<double>::infinity());
        if (!from.sheets.empty())
            addSheets(from, packet, guesses.sheet, distances);
        if (!from.solids.empty())
            addSolids(from, packet, guesses.solid, distances);
        for (uint32_t k = 0; k < kPacketPoints; ++k)
            outValues[grid.index(packet.node[k].x, packet.node[k].y, packet.node[k].z)] = float(distances[k]);
    }
}

/// What the grid makes of matter that is thinner than a cell.
enum class Thin : uint8_t
{
    No,
    Missed,  ///< no node is inside of it
    Shallow, ///< one node is, and only just
};

/// Looks at the line between neighboring nodes that a surface crosses, `first` at the smaller coordinate.
void markThin(const float* values, size_t first, size_t stride, bool hasBefore, bool hasAfter, float cell,
              std::pmr::vector<Thin>& ioMarks)
{
    const float most = kOnSurface * cell;
    const size_t second = first + stride;
    const bool isFirstOut = values[first] > most, isSecondOut = values[second] > most;
    if (isFirstOut && isSecondOut)
        ioMarks[first] = ioMarks[second] = Thin::Missed;
    if (isFirstOut == isSecondOut)
        return;
    const size_t inside = isFirstOut ? second : first;
    const bool hasBeyond = isFirstOut ? hasAfter : hasBefore;
    const size_t beyond = isFirstOut ? second + stride : first - stride;
    if (hasBeyond && values[beyond] > most && values[inside] > -kShallow * cell &&
        ioMarks[inside] == Thin::No)
        ioMarks[inside] = Thin::Shallow;
}

void markThin(std::span<const Triangle> triangles, const DistanceGrid& grid, const float* values,
              std::pmr::vector<Thin>& ioMarks)
{
    const std::array<size_t, 3> strides{1, grid.nodes.x, size_t(grid.nodes.x) * grid.nodes.y};
    for (const Triangle& triangle : triangles)
        for (int axis = 0; axis < 3; ++axis)
            forEachCrossing(triangle, grid, axis, [&](uint32_t u, uint32_t v, double place, int) {
                const double q = std::floor((place - double(grid.low[axis])) / double(grid.cell));
                const uint32_t last = grid.nodes[axis] - 2;
                glm::uvec3 i(0u);
                i[axis] = uint32_t(std::clamp(q, 0.0, double(last)));
                i[(axis + 1) % 3] = u;
                i[(axis + 2) % 3] = v;
                markThin(values, grid.index(i.x, i.y, i.z), strides[size_t(axis)], i[axis] > 0,
                         i[axis] < last, grid.cell, ioMarks);
            });
}

/// Thickens what is thinner than a cell.
void thicken(const MeshSurface& surface, const DistanceGrid& grid, float* ioValues,
             std::pmr::memory_resource* memory)
{
    std::pmr::vector<Thin> marks(grid.count(), Thin::No, memory);
    markThin(surface.solids, grid, ioValues, marks);
    markThin(surface.sheets, grid, ioValues, marks);
    for (size_t i = 0; i < marks.size(); ++i) {
        if (marks[i] == Thin::Missed)
            ioValues[i] -= grid.cell; // (3)
        if (marks[i] == Thin::Shallow)
            ioValues[i] = -kShallow * grid.cell; // (4)
    }
}

base::Bounds boundsOf(const TriangleMesh& mesh)
{
    base::Bounds bounds;
    const size_t corners = size_t(3) * mesh.triangles();
    for (size_t i = 0; i < corners; ++i)
        bounds.add(mesh.positions[mesh.vertex(i)], 0.0f);
    return bounds;
}

} // namespace

DistanceField::DistanceField(const glm::dvec3& origin, const DistanceGrid& grid,
                             std::pmr::memory_resource* memory)
    : origin_(origin), grid_(grid), values_(memory, grid.count())
{}

base::Result<std::shared_ptr<const DistanceField>> DistanceField::build(const TriangleMesh& mesh,
                                                                        float cellSize,
                                                                        base::TaskRunner& tasks,
                                                                        std::pmr::memory_resource* memory)
{
    const base::FloatingPointScope floatingPoint;
    const base::Result<DistanceGrid> grid = plan(mesh, cellSize);
    if (!grid)
        return grid.status();
    const MeshSurface surface = sortTriangles(mesh, memory);
    if (surface.solids.empty() && surface.sheets.empty())
        return base::Status(base::Code::InvalidArgument, "the mesh has no triangle with an area");

    const FieldSources sources(surface, *grid, memory);
    const auto field = std::allocate_shared<DistanceField>(
        std::pmr::polymorphic_allocator<DistanceField>(memory), mesh.origin, *grid, memory);
    float* const values = field->values_.data();
    const glm::uvec3 pairs = (grid->nodes + 1u) / 2u;
    tasks.parallelFor(pairs.y * pairs.z, kMinRows, [&](uint32_t begin, uint32_t end) {
        const base::FloatingPointScope floatingPointOfWorker;
        for (uint32_t row = begin; row < end; ++row)
            computeRows(sources, row % pairs.y * 2, row / pairs.y * 2, values);
    });
    thicken(surface, *grid, values, memory);
    field->hash_ = field->computeHash();
    return std::shared_ptr<const DistanceField>(field);
}

base::Result<DistanceGrid> DistanceField::plan(const TriangleMesh& mesh, float cellSize)
{
    if (base::Status status = checkMesh(mesh); !status)
        return status;
    if (mesh.triangles() == 0)
        return base::Status(base::Code::InvalidArgument, "the mesh has no triangles");
    return planGrid(boundsOf(mesh), cellSize);
}

std::shared_ptr<const DistanceField> DistanceField::restore(const glm::dvec3& origin,
                                                            const DistanceGrid& grid,
                                                            std::span<const float> values,
                                                            std::pmr::memory_resource* memory)
{
    const float farthest = grid.cell * float(grid.nodes.x + grid.nodes.y + grid.nodes.z);
    const auto isDistance = [farthest](float d) { return d >= -farthest && d <= farthest; }; // no NaN
    if (values.size() != grid.count() || !std::all_of(values.begin(), values.end(), isDistance))
        return nullptr;
    const auto field = std::allocate_shared<DistanceField>(
        std::pmr::polymorphic_allocator<DistanceField>(memory), origin, grid, memory);
    std::copy(values.begin(), values.end(), field->values_.data());
    field->hash_ = field->computeHash();
    return field;
}

uint64_t DistanceField::computeHash() const
{
    const double place[7] = {origin_.x,           origin_.y,           origin_.z,         double(grid_.low.x),
                             double(grid_.low.y), double(grid_.low.z), double(grid_.cell)};
    uint64_t hash = base::hashBytes(0, place, sizeof place);
    for (const uint32_t n : {grid_.nodes.x, grid_.nodes.y, grid_.nodes.z})
        hash = base::hashWord(hash, n);
    return std::max<uint64_t>(base::hashBytes(hash, values_.data(), grid_.count() * sizeof(float)), 1);
}

/// False outside of the grid.
bool DistanceField::find(const glm::vec3& p, Corners& outCorners) const
{
    const glm::vec3 q = (p - grid_.low) / grid_.cell;
    const glm::vec3 last = glm::vec3(grid_.nodes) - 1.0f;
    if (!(q.x >= 0.0f && q.y >= 0.0f && q.z >= 0.0f && q.x < last.x && q.y < last.y && q.z < last.z))
        return false;
    const glm::uvec3 i(q);
    outCorners.u = q - glm::vec3(i);
    const float* const values = values_.data();
    for (uint32_t k = 0; k < 8; ++k)
        outCorners.d[k] = values[grid_.index(i.x + (k & 1), i.y + (k >> 1 & 1), i.z + (k >> 2))];
    return true;
}

float DistanceField::distance(const glm::vec3& p) const
{
    return sample(p).distance;
}

DistanceField::Sample DistanceField::sample(const glm::vec3& p) const
{
    Corners c;
    if (!find(p, c)) {
        const glm::vec3 away = p - glm::clamp(p, grid_.bounds.min, grid_.bounds.max); // (8)
        const float length = glm::length(away);
        return {length, length > 0.0f ? away / length : glm::vec3(0.0f)};
    }
    const auto& [d, u] = c;
    const auto blend = [](float a, float b, float t) { return a + t * (b - a); };
    const float d00 = blend(d[0], d[1], u.x), d10 = blend(d[2], d[3], u.x);
    const float d01 = blend(d[4], d[5], u.x), d11 = blend(d[6], d[7], u.x);
    const float d0 = blend(d00, d10, u.y), d1 = blend(d01, d11, u.y);
    const glm::vec3 slope( // (6)
        blend(blend(d[1] - d[0], d[3] - d[2], u.y), blend(d[5] - d[4], d[7] - d[6], u.y), u.z),
        blend(d10 - d00, d11 - d01, u.z), d1 - d0);
    const float length = glm::length(slope);
    return {blend(d0, d1, u.z), length > 1e-6f * grid_.cell ? slope / length : glm::vec3(0.0f)}; // (5)
}

} // namespace fx::sim
