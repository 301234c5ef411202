/// @file distance_field.h
/// Signed distance field of the host's geometry.
///
/// @formula trilinear-distance
/// Distance to a mesh between the nodes of a grid, and its direction.
///
/// symbol   unit   meaning
///   h        m      edge of a cell
///   u        1      position within a cell, 0..1 along each axis
///   di       m      signed distance at the eight corners of the cell
///   wi       1      trilinear weight of a corner, the product of u or 1 - u along each axis
///   s, r     m      distance to solids, negative inside of one; distance to sheets, >= 0
///   f        m      exact distance to all triangles, >= 0
///   d        m      distance, negative inside of matter
///   n        1      unit vector away from the surface
/// @derivation
///   At a node the smaller of the distances to solids and sheets is used
///       di = min(s, b)                                                                        (1)
///   where sheets have a layer of matter behind them, two cells thick,
///       b = r in front, max(-r, r - 2 h) behind                                               (2)
///   If a surface passes between two neighboring nodes that are both outside, the matter is thinner than a
///   cell. Then at both nodes
///       di <- di - h                                                                          (3)
///   and at a node that is inside while both of its neighbors on such a line are outside,
///       di <- min(di, -h / 2)                                                                 (4)
///   so a wall is at least half a cell thick. Between nodes
///       d = sum wi di                                                                         (5)
///       n = grad d / |grad d|, the derivative of (5)                                          (6)
///   No node value exceeds f, and f changes by at most 1 m per m, so (5) exceeds f by at most
///       sum wi |f(p) - f(pi)| <= sum wi |p - pi| <= (sum wi |p - pi|^2)^(1/2)
///                           = h (u(1-u) + v(1-v) + w(1-w))^(1/2) <= (3^(1/2) / 2) h           (7)
///   For solids thicker than two cells, (5) is below the distance by at most the same amount. Outside of the
///   grid d is the distance to the bounding box of the mesh, which does not exceed the distance to the mesh,
///   and n points away from the box                                                                  (8)
/// @source    [FPRJ00] for distances sampled and interpolated in this way; the rest is elementary
/// @deviation a regular grid instead of an adaptive one
/// @valid     |p| within 1e6 m; n is 0 if all corners have the same distance
/// @accuracy  (7) plus the rounding of single precision; exact where the mesh is flat within two cells
/// @tests     tests/simulation/collision/test_distance_field.cpp
#pragma once

#include "foundation/memory/column.h"
#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "simulation/collision/distance_grid.h"
#include "simulation/collision/triangle_mesh.h"

#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>

namespace fx::sim {

/// Largest error of a distance between nodes, in cells: half of the diagonal.
constexpr float kFieldErrorCells = 0.8660255f;

/// Version of the values of build(). For equal meshes and cells, the values differ between versions.
constexpr uint32_t kFieldVersion = 1;

/// A signed distance field of a mesh, sampled on a grid. The field is immutable. Sampling allocates no
/// memory. [any thread]
class DistanceField
{
public:
    /// Builds the field of a mesh. The field needs 4 bytes per node, at most 64 MiB. Building temporarily
    /// needs about 300 bytes per triangle, and 16 bytes per row of nodes that crosses a solid. Equal meshes
    /// give equal bits for any number of threads. Throws std::bad_alloc.
    /// @param cellSize [m] 0: the smallest size with about four million nodes
    /// @return the errors of checkMesh() and planGrid(), or InvalidArgument if all triangles have zero area
    static base::Result<std::shared_ptr<const DistanceField>> build(const TriangleMesh& mesh, float cellSize,
                                                                    base::TaskRunner& tasks,
                                                                    std::pmr::memory_resource* memory);

    /// Returns the grid that build() would use. @return the errors of build(), except the error for triangles
    /// of zero area
    static base::Result<DistanceGrid> plan(const TriangleMesh& mesh, float cellSize);

    /// Restores a field from the result of values(). Throws std::bad_alloc.
    /// @return null if the number of values is wrong, or if a value is not a possible distance in the grid
    static std::shared_ptr<const DistanceField> restore(const glm::dvec3& origin, const DistanceGrid& grid,
                                                        std::span<const float> values,
                                                        std::pmr::memory_resource* memory);

    /// Creates a field without values, for build() and restore() only.
    DistanceField(const glm::dvec3& origin, const DistanceGrid& grid, std::pmr::memory_resource* memory);

    struct Sample
    {
        float distance;   ///< [m]
        glm::vec3 normal; ///< unit vector, or 0
    };

    // Positions are relative to origin().
    float distance(const glm::vec3& p) const;
    Sample sample(const glm::vec3& p) const;

    const glm::dvec3& origin() const { return origin_; } ///< [m] position of the origin in the world
    const DistanceGrid& grid() const { return grid_; }
    /// [m] Signed distances at the nodes.
    std::span<const float> values() const { return {values_.data(), grid_.count()}; }
    float cell() const { return grid_.cell; }
    /// Hash of nodes and distances. The hash is never 0.
    uint64_t hash() const { return hash_; }

private:
    /// The grid cell that contains a position, with the distances at its corners.
    struct Corners
    {
        float d[8]; ///< [m] distances at the corners; the x index changes fastest, the z index slowest
        glm::vec3 u;
    };
    bool find(const glm::vec3& p, Corners& outCorners) const;
    uint64_t computeHash() const;

    glm::dvec3 origin_;
    DistanceGrid grid_;
    base::Column<float> values_;
    uint64_t hash_ = 0;
};

} // namespace fx::sim
