/// @file host_scene.h
/// A scene of a host of other units and axes, with geometry, wind and instances that are turned and scaled.
#pragma once

#include "tests/api/api_fixture.h"
#include "tests/api/event_presets.h"
#include "tests/api/host_convention.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace fx::test {

const glm::quat kHostTurn(0.48f, 0.36f, 0.48f, -0.64f); ///< of instances, in axes of the library
const glm::dvec3 kHostPlace(3.0, 0.5, -2.0);            ///< [m] of instances

/// A scene that uses everything that has a length or a direction, in the world of a host, and what it gave.
class HostScene
{
public:
    explicit HostScene(const HostConvention& convention, bool hasGeometry = true) : host(convention)
    {
        const FxContextDef contextDef = host.contextDef();
        EXPECT_EQ(fxCreateContext(&contextDef, &context), FX_OK) << fxGetLastErrorMessage();
        FxSceneDef def = fxDefaultSceneDef();
        host.set(def.gravity, host.vector({0.5, -8.0, 0.25}));
        def.eventCapacity = 4000;
        def.eventKinds = kAllEvents;
        EXPECT_EQ(fxCreateScene(context, &def, &scene), FX_OK) << fxGetLastErrorMessage();
        if (hasGeometry)
            addGeometry();
    }
    ~HostScene() { EXPECT_EQ(fxDestroyContext(context), FX_OK); }
    HostScene(const HostScene&) = delete;
    HostScene& operator=(const HostScene&) = delete;

    FxInstanceId add(const std::string& preset)
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context, preset);
        def.userData = 5;
        host.set(def.position, host.vector(kHostPlace));
        const glm::quat turn = host.rotation(kHostTurn);
        const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
        std::copy_n(xyzw, 4, def.rotation);
        host.set(def.wind, host.vector({2.0, 0.5, -1.0}));
        def.scale = 1.5f;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    void play(int frames)
    {
        for (int i = 0; i < frames; ++i)
            EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK) << fxGetLastErrorMessage();
    }
    uint64_t hash()
    {
        uint64_t out = 0;
        EXPECT_EQ(fxScene_GetSimulationHash(scene, &out), FX_OK);
        return out;
    }
    std::vector<FxEvent> events()
    {
        std::vector<FxEvent> out(4000);
        out[0].structSize = sizeof(FxEvent);
        uint32_t count = 0;
        EXPECT_EQ(fxScene_GetEvents(scene, out.data(), uint32_t(out.size()), &count, nullptr), FX_OK);
        out.resize(count);
        return out;
    }

    HostConvention host;
    FxContext* context = nullptr;
    FxScene* scene = nullptr;

private:
    /// A wall on the right, and a floor that lets nothing through.
    void addGeometry()
    {
        const std::array<glm::dvec3, 8> corners{
            {{6, -8, -8}, {7, -8, -8}, {6, 8, -8}, {7, 8, -8}, {6, -8, 8}, {7, -8, 8}, {6, 8, 8}, {7, 8, 8}}};
        constexpr std::array<uint32_t, 36> kIndices{0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
        std::array<float, 24> positions{};
        for (size_t i = 0; i < corners.size(); ++i)
            host.set(&positions[3 * i], host.vector(corners[i] - glm::dvec3(1, 2, 4)));
        FxCollisionMesh mesh = fxDefaultCollisionMesh();
        host.set(mesh.origin, host.vector({1, 2, 4}));
        mesh.positions = positions.data();
        mesh.indices = kIndices.data();
        mesh.vertexCount = 8;
        mesh.indexCount = 36;
        mesh.cellSize = float(0.5 * host.unitsPerMeter);
        EXPECT_EQ(fxScene_SetCollisionMesh(scene, &mesh), FX_OK) << fxGetLastErrorMessage();
        FxContactHook hook = fxDefaultContactHook();
        hook.user = this;
        hook.meet = &meetFloor;
        EXPECT_EQ(fxScene_SetContactHook(scene, &hook), FX_OK) << fxGetLastErrorMessage();
    }
    static int meetFloor(void* user, const double from[3], const double to[3], float* outShare,
                         float outNormal[3])
    {
        const HostConvention& host = static_cast<HostScene*>(user)->host;
        const glm::dvec3 up = HostConvention::unit(host.up);
        const double height = -0.5 * host.unitsPerMeter;
        const double before = glm::dot(up, glm::make_vec3(from)), after = glm::dot(up, glm::make_vec3(to));
        if (after >= height || before < after)
            return 0;
        *outShare = before > height ? float((before - height) / (before - after)) : 0.0f;
        host.set(outNormal, 2.0 * up);
        return 1;
    }
};

} // namespace fx::test
