#include "rendering/voxelization/medium_cells.h"

#include "rendering/volumes/block_table.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <queue>

namespace fx::render {
namespace {

constexpr double kLeastVisibility = 0.01; // [1] weight of voxels that the medium hides from all sides

/// A voxel with medium.
struct Sample
{
    glm::ivec3 voxel;
    float mass;   ///< [m2]
    float weight; ///< [m2] mass times visibility
};

std::vector<Sample> samplesOf(const MediumGrid& grid)
{
    std::vector<Sample> samples;
    const double volume = grid.voxelVolume();
    for (size_t b = 0; b < grid.blocks.size(); ++b)
        for (size_t v = 0; v < size_t(kBlockVoxels); ++v)
            if (const float density = grid.density[b * size_t(kBlockVoxels) + v]; density > 0.0f) {
                const float mass = float(double(density) * volume);
                samples.push_back({grid.blocks[b] + placeInBlock(v), mass, mass});
            }
    return samples;
}

/// Multiplies weights by the visibility: sweeps along each axis in both directions sum up the optical depth.
void weighVisibility(const MediumGrid& grid, std::vector<Sample>& io)
{
    std::vector<double> visible(io.size(), 0.0);
    const double volume = grid.voxelVolume();
    std::vector<uint32_t> order(io.size());
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (uint32_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
            const glm::ivec3 &p = io[a].voxel, &q = io[b].voxel;
            return std::array{p[u], p[v], p[axis]} < std::array{q[u], q[v], q[axis]};
        });
        const double depthPerMass = glm::length(grid.axes[axis]) / volume; // [1/m2] of a voxel
        const auto sweep = [&](auto begin, auto end) {
            double depth = 0.0;
            int lineU = 0, lineV = 0;
            for (auto at = begin; at != end; ++at) {
                const Sample& sample = io[*at];
                if (at == begin || sample.voxel[u] != lineU || sample.voxel[v] != lineV)
                    depth = 0.0;
                lineU = sample.voxel[u];
                lineV = sample.voxel[v];
                const double here = double(sample.mass) * depthPerMass;
                visible[*at] += std::exp(-(depth + 0.5 * here)) / 6.0;
                depth += here;
            }
        };
        sweep(order.begin(), order.end());
        sweep(order.rbegin(), order.rend());
    }
    for (size_t i = 0; i < io.size(); ++i)
        io[i].weight = float(double(io[i].mass) * std::max(visible[i], kLeastVisibility));
}

MediumCell cellOf(const MediumGrid& grid, const Sample* begin, const Sample* end)
{
    MediumCell cell;
    glm::dvec3 sum(0.0), middle(0.0);
    for (const Sample* s = begin; s != end; ++s) {
        cell.mass += double(s->mass);
        sum += double(s->mass) * glm::dvec3(s->voxel);
        middle += glm::dvec3(s->voxel);
    }
    middle = grid.place(middle / double(end - begin));
    cell.center = grid.place(sum / cell.mass);
    for (const Sample* s = begin; s != end; ++s) {
        const glm::dvec3 way = grid.place(glm::dvec3(s->voxel)) - middle;
        cell.spread += glm::dot(way, way);
    }
    cell.spread /= double(end - begin);
    return cell;
}

/// A node of the k-d tree.
struct Node
{
    double priority; ///< [m4]
    size_t begin, end;
    int axis;      ///< along which it is longest
    double middle; ///< [voxel] weighted mean along it
    bool operator<(const Node& other) const
    {
        return priority != other.priority ? priority < other.priority : begin > other.begin;
    }
};

Node nodeOf(const MediumGrid& grid, const std::vector<Sample>& samples, size_t begin, size_t end)
{
    double weight = 0.0;
    glm::dvec3 mean(0.0), square(0.0);
    const glm::dvec3 origin(samples[begin].voxel);
    for (size_t i = begin; i < end; ++i) {
        const glm::dvec3 way = glm::dvec3(samples[i].voxel) - origin;
        const double w = double(samples[i].weight);
        weight += w;
        mean += w * way;
        square += w * way * way;
    }
    mean /= weight;
    Node node{0.0, begin, end, 0, 0.0};
    double largest = -1.0;
    for (int a = 0; a < 3; ++a) {
        const double moment =
            std::max(square[a] - weight * mean[a] * mean[a], 0.0) * glm::dot(grid.axes[a], grid.axes[a]);
        node.priority += moment;
        if (moment > largest) {
            largest = moment;
            node.axis = a;
            node.middle = origin[a] + mean[a];
        }
    }
    if (end - begin < 2)
        node.priority = 0.0;
    return node;
}

std::vector<MediumCell> cubesOf(const MediumGrid& grid, const std::vector<Sample>& samples,
                                const glm::dvec3& corner, double side)
{
    std::map<std::array<int64_t, 3>, std::vector<Sample>> cubes;
    for (const Sample& sample : samples) {
        const glm::dvec3 at = glm::floor((grid.place(glm::dvec3(sample.voxel)) - corner) / side);
        cubes[{int64_t(at.x), int64_t(at.y), int64_t(at.z)}].push_back(sample);
    }
    std::vector<MediumCell> cells;
    for (const auto& [place, inside] : cubes) {
        cells.push_back(cellOf(grid, inside.data(), inside.data() + inside.size()));
        cells.back().spread = side * side / 4.0; // of a full cube, so that balls at the rim overlap too
    }
    return cells;
}

} // namespace

std::vector<MediumCell> uniformCells(const MediumGrid& grid, uint32_t most)
{
    const std::vector<Sample> samples = samplesOf(grid);
    if (samples.empty() || most == 0)
        return {};
    glm::dvec3 corner =
        grid.place(glm::dvec3(samples[0].voxel)); // of all cubes, so that one can hold everything
    for (const Sample& sample : samples)
        corner = glm::min(corner, grid.place(glm::dvec3(sample.voxel)));
    double side = std::cbrt(double(samples.size()) * grid.voxelVolume() / double(most));
    constexpr double kLarger = 1.03;
    for (;; side *= kLarger)
        if (std::vector<MediumCell> cells = cubesOf(grid, samples, corner, side); cells.size() <= most)
            return cells;
}

std::vector<MediumCell> adaptiveCells(const MediumGrid& grid, uint32_t most)
{
    std::vector<Sample> samples = samplesOf(grid);
    if (samples.empty() || most == 0)
        return {};
    weighVisibility(grid, samples);
    std::priority_queue<Node> nodes;
    nodes.push(nodeOf(grid, samples, 0, samples.size()));
    while (nodes.size() < most && nodes.top().priority > 0.0) {
        const Node node = nodes.top();
        nodes.pop();
        const auto middle = std::stable_partition(
            samples.begin() + std::ptrdiff_t(node.begin), samples.begin() + std::ptrdiff_t(node.end),
            [&](const Sample& s) { return double(s.voxel[node.axis]) <= node.middle; });
        const size_t cut = size_t(middle - samples.begin());
        if (cut == node.begin || cut == node.end) { // all in one plane, to rounding
            nodes.push({0.0, node.begin, node.end, node.axis, node.middle});
            continue;
        }
        nodes.push(nodeOf(grid, samples, node.begin, cut));
        nodes.push(nodeOf(grid, samples, cut, node.end));
    }
    std::vector<Node> leaves;
    for (; !nodes.empty(); nodes.pop())
        leaves.push_back(nodes.top());
    std::sort(leaves.begin(), leaves.end(), [](const Node& a, const Node& b) { return a.begin < b.begin; });
    std::vector<MediumCell> cells;
    for (const Node& leaf : leaves)
        cells.push_back(cellOf(grid, samples.data() + leaf.begin, samples.data() + leaf.end));
    return cells;
}

} // namespace fx::render
