#include "simulation/collision/distance_grid.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace fx::sim {

namespace {

constexpr double kGrowth = 1.02;       ///< of the cell from one attempt to the next
constexpr double kFinest = 1e-3;       ///< [1] automatic cell over the longest side
constexpr double kSmallestCell = 1e-4; ///< [m]

glm::dvec3 nodesOf(const base::Bounds& bounds, double cell)
{
    const glm::dvec3 size = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
    return glm::ceil(size / cell) + 2.0 * double(kFieldMargin) + 1.0;
}

double countOf(const glm::dvec3& nodes)
{
    return nodes.x * nodes.y * nodes.z;
}

} // namespace

base::Result<DistanceGrid> planGrid(const base::Bounds& bounds, float cell)
{
    const glm::dvec3 size = glm::dvec3(bounds.max) - glm::dvec3(bounds.min);
    double edge = double(cell);
    if (!(cell > 0.0f)) {
        edge = std::max(kFinest * std::max({size.x, size.y, size.z}), kSmallestCell);
        while (countOf(nodesOf(bounds, edge)) > double(kAutomaticFieldNodes))
            edge *= kGrowth;
        edge = double(float(edge));
    }
    const glm::dvec3 nodes = nodesOf(bounds, edge);
    if (!(countOf(nodes) <= double(kMaxFieldNodes)))
        return base::Status(base::Code::Capacity,
                            "the mesh takes " + std::to_string(uint64_t(std::min(countOf(nodes), 1e18))) +
                                " cells of this size; at most " + std::to_string(kMaxFieldNodes) +
                                " are made: use larger cells or a smaller mesh");
    DistanceGrid grid;
    grid.cell = float(edge);
    grid.nodes = glm::uvec3(nodes);
    grid.bounds = bounds;
    const glm::dvec3 spare = edge * (nodes - 1.0) - size;
    grid.low = glm::vec3(glm::dvec3(bounds.min) - 0.5 * spare);
    return grid;
}

} // namespace fx::sim
