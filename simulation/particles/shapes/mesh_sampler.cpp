#include "simulation/particles/shapes/mesh_sampler.h"

#include <glm/geometric.hpp>

namespace fx::sim {

base::Result<std::shared_ptr<const MeshSampler>> makeMeshSampler(const TriangleMesh& mesh)
{
    if (const base::Status status = checkMesh(mesh); !status)
        return status;
    auto sampler = std::make_shared<MeshSampler>();
    std::vector<double> areas;
    for (size_t t = 0; t < mesh.triangles(); ++t) {
        const glm::vec3 a = mesh.positions[mesh.vertex(3 * t)];
        const glm::vec3 b = mesh.positions[mesh.vertex(3 * t + 1)];
        const glm::vec3 c = mesh.positions[mesh.vertex(3 * t + 2)];
        const glm::dvec3 normal = glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
        const double area = glm::length(normal);
        if (!(area > 0.0))
            continue;
        sampler->triangles.push_back({a, {b - a, c - a}, glm::vec3(normal / area)});
        areas.push_back(area);
    }
    if (areas.empty())
        return base::Status(base::Code::InvalidArgument, "the mesh has no triangle with an area");
    sampler->table = AliasTable(areas);
    return std::shared_ptr<const MeshSampler>(std::move(sampler));
}

base::Result<std::shared_ptr<const VolumeSampler>> makeVolumeSampler(const FieldGrid& density)
{
    if (density.channels != 1)
        return base::Status(base::Code::InvalidArgument,
                            "a density has 1 channel; the grid has " + std::to_string(density.channels));
    auto sampler = std::make_shared<VolumeSampler>();
    sampler->low = density.low;
    sampler->cell = density.cell;
    std::vector<double> weights;
    for (uint32_t z = 0; z < density.nodes.z; ++z)
        for (uint32_t y = 0; y < density.nodes.y; ++y)
            for (uint32_t x = 0; x < density.nodes.x; ++x)
                if (const float value = density.values[density.index(x, y, z)]; value > 0.0f) {
                    sampler->nodes.emplace_back(x, y, z);
                    weights.push_back(double(value));
                }
    if (weights.empty())
        return base::Status(base::Code::InvalidArgument, "the grid has no density above 0");
    sampler->table = AliasTable(weights);
    return std::shared_ptr<const VolumeSampler>(std::move(sampler));
}

} // namespace fx::sim
