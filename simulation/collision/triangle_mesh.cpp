#include "simulation/collision/triangle_mesh.h"

#include <string>

namespace fx::sim {

namespace {

base::Status invalid(const std::string& what)
{
    return {base::Code::InvalidArgument, what};
}

bool isInReach(float x)
{
    return x >= -kFarthestVertex && x <= kFarthestVertex; // false for NaN
}

} // namespace

base::Status checkMesh(const TriangleMesh& mesh)
{
    const size_t corners = mesh.indices.empty() ? mesh.positions.size() : mesh.indices.size();
    if (corners % 3 != 0)
        return invalid("the mesh ends within a triangle");
    if (corners / 3 > kMaxMeshTriangles)
        return {base::Code::TooLarge, "the mesh has " + std::to_string(corners / 3) + " triangles; at most " +
                                          std::to_string(kMaxMeshTriangles) + " are taken"};
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        if (!isInReach(p.x) || !isInReach(p.y) || !isInReach(p.z))
            return invalid("position " + std::to_string(i) +
                           " of the mesh is not finite, or farther than 100000 m from its origin");
    }
    for (size_t i = 0; i < mesh.indices.size(); ++i)
        if (mesh.indices[i] >= mesh.positions.size())
            return invalid("index " + std::to_string(i) + " of the mesh is " +
                           std::to_string(mesh.indices[i]) + "; it has " +
                           std::to_string(mesh.positions.size()) + " positions");
    return {};
}

} // namespace fx::sim
