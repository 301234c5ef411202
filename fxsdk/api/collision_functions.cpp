// The functions of fx_scene.h that take the host's geometry.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace {

using fx::api::HostContact;
using fx::api::HostWorld;
using fx::base::Status;

constexpr uint32_t kMaxVertices = 1u << 24;
constexpr uint32_t kMaxIndices = 3 * fx::sim::kMaxMeshTriangles;

Status checkDef(const HostWorld& world, const FxCollisionMesh& mesh)
{
    const float smallest = world.fromMeters(1e-3f), largest = world.fromMeters(1e3f);
    const double farthest = world.fromMeters(1e9);
    fx::api::Checks check;
    check.that(mesh.cellSize == 0.0f || (mesh.cellSize >= smallest && mesh.cellSize <= largest),
               "mesh.cellSize is out of range; allowed is 0, or 0.001 m to 1000 m in units of the host");
    check.range3(mesh.origin, -farthest, farthest, "mesh.origin");
    check.notNull(mesh.positions, "mesh.positions");
    check.range(mesh.vertexCount, 3u, mesh.indices ? kMaxVertices : kMaxIndices, "mesh.vertexCount");
    if (mesh.indices)
        check.range(mesh.indexCount, 3u, kMaxIndices, "mesh.indexCount");
    else
        check.range(mesh.indexCount, 0u, 0u, "mesh.indexCount (mesh.indices is null)");
    return check.status();
}

/// The vertices in the memory of the host: what it gives need not be aligned as ours are.
std::pmr::vector<glm::vec3> copyPositions(const HostWorld& world, const FxCollisionMesh& mesh,
                                          std::pmr::memory_resource* memory)
{
    std::pmr::vector<glm::vec3> positions(memory);
    positions.reserve(mesh.vertexCount);
    for (size_t i = 0; i < mesh.vertexCount; ++i)
        positions.push_back(world.vector(mesh.positions + 3 * i));
    return positions;
}

/// Asks a callback of a host whose world is not that of the library. On several threads.
int meetInHostWorld(void* user, const double from[3], const double to[3], float* outShare, float outNormal[3])
{
    const auto& contact = *static_cast<const HostContact*>(user);
    double hostFrom[3], hostTo[3];
    contact.world->writePosition({from[0], from[1], from[2]}, hostFrom);
    contact.world->writePosition({to[0], to[1], to[2]}, hostTo);
    float normal[3] = {};
    const int met = contact.meet(contact.user, hostFrom, hostTo, outShare, normal);
    const glm::vec3 converted = contact.world->direction(normal);
    std::copy_n(glm::value_ptr(converted), 3, outNormal);
    return met;
}

/// Strong guarantee.
void setContact(FxScene& scene, const FxContactHook& hook)
{
    const HostWorld& world = scene.context->world;
    if (!hook.meet || world.isLibraryWorld()) {
        scene.scene.setContact({hook.user, hook.meet});
        scene.contact.reset();
        return;
    }
    auto contact = std::allocate_shared<HostContact>(
        std::pmr::polymorphic_allocator<HostContact>(&scene.context->memory),
        HostContact{&world, hook.user, hook.meet});
    scene.scene.setContact({contact.get(), &meetInHostWorld}); // completes the step with the last one
    scene.contact = std::move(contact);
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
        const HostWorld& world = scene->context->world;
        if (Status status = checkDef(world, known); !status)
            return status;
        const std::pmr::vector<glm::vec3> positions = copyPositions(world, known, &scene->context->memory);
        fx::sim::TriangleMesh triangles;
        triangles.origin = world.position(known.origin);
        triangles.positions = positions;
        if (known.indices)
            triangles.indices = {known.indices, known.indexCount};
        return scene->scene.setCollisionMesh(&triangles, world.toMeters(known.cellSize));
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
        setContact(*scene, known);
        return {};
    });
}
