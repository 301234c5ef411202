// The functions of fx_scene.h that take the host's geometry.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

#include <vector>

namespace {

using fx::base::Status;

constexpr uint32_t kMaxVertices = 1u << 24;
constexpr uint32_t kMaxIndices = 3 * fx::sim::kMaxMeshTriangles;

Status checkDef(const FxCollisionMesh& mesh)
{
    fx::api::Checks check;
    check.that(mesh.cellSize == 0.0f || (mesh.cellSize >= 1e-3f && mesh.cellSize <= 1e3f),
               "mesh.cellSize is out of range; allowed is 0, or 0.001 to 1000");
    check.range3(mesh.origin, -1e9, 1e9, "mesh.origin");
    check.notNull(mesh.positions, "mesh.positions");
    check.range(mesh.vertexCount, 3u, mesh.indices ? kMaxVertices : kMaxIndices, "mesh.vertexCount");
    if (mesh.indices)
        check.range(mesh.indexCount, 3u, kMaxIndices, "mesh.indexCount");
    else
        check.range(mesh.indexCount, 0u, 0u, "mesh.indexCount (mesh.indices is null)");
    return check.status();
}

/// The vertices in the memory of the host: what it gives need not be aligned as ours are.
std::pmr::vector<glm::vec3> copyPositions(const FxCollisionMesh& mesh, std::pmr::memory_resource* memory)
{
    std::pmr::vector<glm::vec3> positions(memory);
    positions.reserve(mesh.vertexCount);
    for (size_t i = 0; i < mesh.vertexCount; ++i)
        positions.emplace_back(mesh.positions[3 * i], mesh.positions[3 * i + 1], mesh.positions[3 * i + 2]);
    return positions;
}

} // namespace

FxResult fxScene_SetCollisionMesh(FxScene* scene, const FxCollisionMesh* mesh)
{
    return fx::api::insideScene("fxScene_SetCollisionMesh", scene, [&]() -> Status {
        if (!mesh)
            return scene->scene.setCollisionMesh(nullptr, 0.0f);
        FxCollisionMesh known;
        if (Status status = fx::api::readStruct(mesh, "mesh", fxDefaultCollisionMesh(), known); !status)
            return status;
        if (Status status = checkDef(known); !status)
            return status;
        const std::pmr::vector<glm::vec3> positions = copyPositions(known, &scene->context->memory);
        fx::sim::TriangleMesh triangles;
        triangles.origin = {known.origin[0], known.origin[1], known.origin[2]};
        triangles.positions = positions;
        if (known.indices)
            triangles.indices = {known.indices, known.indexCount};
        return scene->scene.setCollisionMesh(&triangles, known.cellSize);
    });
}

FxResult fxScene_SetContactHook(FxScene* scene, const FxContactHook* hook)
{
    return fx::api::insideScene("fxScene_SetContactHook", scene, [&]() -> Status {
        FxContactHook known = fxDefaultContactHook();
        if (hook) {
            if (Status status = fx::api::readStruct(hook, "hook", fxDefaultContactHook(), known); !status)
                return status;
            fx::api::Checks check;
            check.that(known.meet != nullptr, "hook.meet is null");
            if (!check.status())
                return check.status();
        }
        scene->scene.setContact({known.user, known.meet});
        return {};
    });
}
