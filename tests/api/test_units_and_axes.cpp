// Units and axes of the host: every value that crosses the C API, without OpenGL.
#include "fxsdk/api/context.h"
#include "tests/api/host_scene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using fx::test::HostConvention;
using fx::test::HostScene;
using fx::test::kExactWorlds;
using fx::test::kHostPlace;
using fx::test::kLibraryWorld;
using fx::test::kRoundedWorlds;

namespace {

double farthest(const glm::dvec3& a, const glm::dvec3& b)
{
    return glm::length(a - b);
}

const std::string kHail =
    R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64, "shape": "disc",
    "size": 1, "emission": {"bursts": [{"time": 0, "count": 64}]}, "lifetime": 100, "radius": 0.01,
    "space": "world", "appearance": {"kind": "sprite"}, "collisions": [{"shape": "hook", "bounce": 0.5}]}]})";
/// An effect that culling hides by its distance.
const std::string kBounded = R"({"version": 1, "ground": false, "bound": 4, "emitters": [{"radius": 0.1,
    "emission": {"bursts": [{"time": 0, "count": 40}]}, "lifetime": 100, "forces": {"gravity": 0}}]})";
const std::string kDebris = R"({"version": 1, "ground": false, "fragments": [{"count": 100, "speed": 25,
    "lifetime": 100, "trail": {"spacing": 0}}]})";

/// The columns of a snapshot's newer step: "group/column" to values.
class Shown
{
public:
    explicit Shown(HostScene& from) : from_(from)
    {
        EXPECT_EQ(fxScene_AcquireSnapshot(from.scene, &id_), FX_OK) << fxGetLastErrorMessage();
    }
    ~Shown() { EXPECT_EQ(fxScene_ReleaseSnapshot(from_.scene, id_), FX_OK); }
    Shown(const Shown&) = delete;
    Shown& operator=(const Shown&) = delete;

    uint32_t groups() const
    {
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_GetSnapshotInfo(from_.scene, id_, &info), FX_OK);
        return info.groupsNewer;
    }
    FxSnapshotGroup group(uint32_t index) const
    {
        FxSnapshotGroup out{};
        out.structSize = sizeof out;
        EXPECT_EQ(fxScene_GetSnapshotGroup(from_.scene, id_, FX_SNAPSHOT_NEWER, index, &out), FX_OK);
        return out;
    }
    FxSnapshotColumn column(uint32_t group, uint32_t index) const
    {
        FxSnapshotColumn out{};
        out.structSize = sizeof out;
        EXPECT_EQ(fxScene_GetSnapshotColumn(from_.scene, id_, FX_SNAPSHOT_NEWER, group, index, &out), FX_OK);
        return out;
    }
    glm::dvec3 vector(uint32_t group, const char* x, uint32_t row) const
    {
        glm::dvec3 out;
        std::string name = x;
        for (int i = 0; i < 3; ++i, ++name.back()) {
            FxSnapshotColumn found{};
            found.structSize = sizeof found;
            EXPECT_EQ(
                fxScene_FindSnapshotColumn(from_.scene, id_, FX_SNAPSHOT_NEWER, group, name.c_str(), &found),
                FX_OK);
            out[i] = double(found.values[row]);
        }
        return out;
    }

private:
    HostScene& from_;
    FxSnapshotId id_{};
};

std::string refusal(const FxContextDef& def)
{
    FxContext* context = nullptr;
    EXPECT_EQ(fxCreateContext(&def, &context), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(context, nullptr);
    return fxGetLastErrorMessage();
}

} // namespace

TEST(UnitsAndAxes, wrongOnesAreRefusedWithTheRemedy)
{
    for (const double wrong : {0.0, -1.0, 1e-4, 1e7, std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()})
    {
        FxContextDef def = fxDefaultContextDef();
        def.unitsPerMeter = wrong;
        EXPECT_NE(refusal(def).find("def.unitsPerMeter"), std::string::npos);
        EXPECT_NE(refusal(def).find("100 for centimeters"), std::string::npos);
    }
    FxContextDef doubled = fxDefaultContextDef();
    doubled.forwardAxis = FX_AXIS_NEGATIVE_X;
    EXPECT_NE(refusal(doubled).find("give one along X, one along Y and one along Z"), std::string::npos);
    FxContextDef none = fxDefaultContextDef();
    none.upAxis = 6;
    EXPECT_NE(refusal(none).find("def.upAxis (FxAxis) is 6"), std::string::npos) << refusal(none);
    FxContextDef reserved = fxDefaultContextDef();
    reserved.reserved = 1;
    EXPECT_NE(refusal(reserved).find("def.reserved"), std::string::npos);
}

TEST(UnitsAndAxes, theSameSceneHasTheSameSimulationInEveryWorld)
{
    const auto hashOf = [](const HostConvention& host) {
        HostScene played(host);
        played.add(fx::test::kSparks);
        played.add(kHail);
        played.add(kDebris);
        played.play(40);
        return played.hash();
    };
    const uint64_t expected = hashOf(kLibraryWorld);
    for (const HostConvention& host : kExactWorlds)
        EXPECT_EQ(hashOf(host), expected) << host;
}

TEST(UnitsAndAxes, thePresentTransformAndWindAreThoseOfTheHost)
{
    uint64_t expected = 0;
    std::vector<HostConvention> hosts(kExactWorlds.begin(), kExactWorlds.end());
    hosts.insert(hosts.begin(), kLibraryWorld);
    for (const HostConvention& host : hosts) {
        SCOPED_TRACE(host);
        HostScene moved(host);
        const FxInstanceId id = moved.add(fx::test::kSparks);
        moved.play(5);
        double position[3];
        host.set(position, host.vector({-4.0, 2.0, 1.0}));
        const glm::quat turn = host.rotation(glm::quat(0.6f, 0.0f, 0.8f, 0.0f));
        const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
        ASSERT_EQ(fxScene_SetTransform(moved.scene, id, position, xyzw, 1.0f), FX_OK);
        moved.play(5);
        FxInstanceParameters parameters = fxDefaultInstanceParameters();
        host.set(parameters.wind, host.vector({0.0, 4.0, 8.0}));
        ASSERT_EQ(fxScene_SetParameters(moved.scene, id, &parameters), FX_OK);
        moved.play(5);
        FxInstanceInfo info{};
        info.structSize = sizeof info;
        ASSERT_EQ(fxScene_GetInstanceInfo(moved.scene, id, &info), FX_OK);
        EXPECT_EQ(glm::make_vec3(info.position), host.vector({-4.0, 2.0, 1.0}));
        // the same wind by its name
        FxParameterId wind{};
        const FxPresetId preset = info.preset;
        ASSERT_EQ(fxFindParameter(moved.context, preset, "wind", &wind), FX_OK);
        glm::vec3 value;
        ASSERT_EQ(fxScene_GetParameter(moved.scene, id, wind, FX_PARAMETER_FLOAT3, &value), FX_OK);
        EXPECT_EQ(glm::dvec3(value), host.vector({0.0, 4.0, 8.0}));
        value = glm::vec3(host.vector({1.0, 2.0, 3.0}));
        ASSERT_EQ(fxScene_SetParameter(moved.scene, id, wind, FX_PARAMETER_FLOAT3, &value), FX_OK);
        FxParameterInfo row{};
        row.structSize = sizeof row;
        ASSERT_EQ(fxGetParameterInfo(moved.context, preset, 1, &row), FX_OK);
        EXPECT_EQ(double(row.maximum), 1000.0 * host.unitsPerMeter);
        EXPECT_EQ(double(row.minimum), -1000.0 * host.unitsPerMeter);
        moved.play(5);
        if (expected == 0)
            expected = moved.hash();
        EXPECT_EQ(moved.hash(), expected);
        // ranges are those of meters
        value = glm::vec3(float(1001.0 * host.unitsPerMeter), 0.0f, 0.0f);
        EXPECT_EQ(fxScene_SetParameter(moved.scene, id, wind, FX_PARAMETER_FLOAT3, &value),
                  FX_ERROR_INVALID_ARGUMENT);
        position[0] = 1.01e9 * host.unitsPerMeter;
        EXPECT_EQ(fxScene_SetTransform(moved.scene, id, position, xyzw, 1.0f), FX_ERROR_INVALID_ARGUMENT);
    }
}

TEST(UnitsAndAxes, withoutSettingsGravityPullsDownInEveryWorld)
{
    std::vector<HostConvention> hosts(kRoundedWorlds.begin(), kRoundedWorlds.end());
    hosts.push_back({"kilometers", 1e-3, FX_AXIS_X, FX_AXIS_Z, FX_AXIS_Y});
    for (const HostConvention& host : hosts) {
        FxContext* context = nullptr;
        const FxContextDef contextDef = host.contextDef();
        ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK) << fxGetLastErrorMessage();
        const FxSceneDef def = fxDefaultSceneDef();
        FxScene* scene = nullptr;
        ASSERT_EQ(fxCreateScene(context, &def, &scene), FX_OK) << fxGetLastErrorMessage();
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = fx::test::loadText(context, R"({"version": 1, "ground": false, "emitters": [{
            "emission": {"bursts": [{"time": 0, "count": 1}]}, "lifetime": 9, "speed": 0, "radius": 0.1,
            "forces": {"gravity": 1}, "appearance": {"kind": "sprite", "alignment": "velocity"}}]})");
        FxInstanceId id{};
        ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        for (int i = 0; i < 60; ++i)
            ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        FxSnapshotId snapshot{};
        ASSERT_EQ(fxScene_AcquireSnapshot(scene, &snapshot), FX_OK);
        glm::dvec3 place;
        const char* names[] = {"x", "y", "z"};
        for (int i = 0; i < 3; ++i) {
            FxSnapshotColumn column{};
            column.structSize = sizeof column;
            ASSERT_EQ(fxScene_FindSnapshotColumn(scene, snapshot, FX_SNAPSHOT_NEWER, 0, names[i], &column),
                      FX_OK);
            place[i] = double(column.values[0]);
        }
        const glm::dvec3 fallen = host.vector({0.0, -0.5 * 9.80665, 0.0}); // after a second
        EXPECT_LT(farthest(place, fallen), 0.1 * host.unitsPerMeter) << host << place.x << place.y << place.z;
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
        EXPECT_EQ(fxDestroyContext(context), FX_OK);
    }
}

TEST(UnitsAndAxes, snapshotsAreInTheWorldOfTheHost)
{
    HostScene reference(kLibraryWorld);
    for (const std::string& preset : {fx::test::kSparks, kHail, kDebris})
        reference.add(preset);
    reference.play(20);
    const Shown expected(reference);
    ASSERT_GE(expected.groups(), 3u);
    for (const HostConvention& host : kExactWorlds) {
        SCOPED_TRACE(host);
        HostScene played(host);
        for (const std::string& preset : {fx::test::kSparks, kHail, kDebris})
            played.add(preset);
        played.play(20);
        const Shown shown(played);
        ASSERT_EQ(shown.groups(), expected.groups());
        for (uint32_t g = 0; g < shown.groups(); ++g) {
            const FxSnapshotGroup group = shown.group(g), known = expected.group(g);
            ASSERT_EQ(group.count, known.count);
            EXPECT_EQ(glm::make_vec3(group.position), host.vector(glm::make_vec3(known.position)));
            EXPECT_EQ(group.scale, known.scale);
            const glm::quat turn(group.rotation[3], group.rotation[0], group.rotation[1], group.rotation[2]);
            const glm::quat knownTurn(known.rotation[3], known.rotation[0], known.rotation[1],
                                      known.rotation[2]);
            EXPECT_EQ(turn, host.rotation(knownTurn));
            const glm::dvec3 a = host.vector(glm::make_vec3(known.boundsMin));
            const glm::dvec3 b = host.vector(glm::make_vec3(known.boundsMax));
            if (known.count > 0) {
                EXPECT_EQ(glm::dvec3(glm::make_vec3(group.boundsMin)), glm::min(a, b));
                EXPECT_EQ(glm::dvec3(glm::make_vec3(group.boundsMax)), glm::max(a, b));
            }
            for (uint32_t row = 0; row < group.count; ++row) {
                const glm::dvec3 local = shown.vector(g, "x", row), knownLocal = expected.vector(g, "x", row);
                ASSERT_EQ(local, host.vector(knownLocal));
                // the placement leads to the same point of the world
                const glm::vec3 offset = turn * (group.scale * glm::vec3(local));
                const glm::vec3 knownOffset = knownTurn * (known.scale * glm::vec3(knownLocal));
                EXPECT_LT(farthest(glm::dvec3(offset), host.vector(knownOffset)), 1e-4 * host.unitsPerMeter);
            }
            for (uint32_t c = 0; c < group.columnCount; ++c) {
                const FxSnapshotColumn column = shown.column(g, c), was = expected.column(g, c);
                ASSERT_EQ(column.count, was.count);
                const std::string name = column.name, unit = column.unit;
                const bool isRadius = name == "radius";
                for (uint32_t row = 0; column.values && row < column.count; ++row) {
                    const double value = double(was.values[row]), u = host.unitsPerMeter;
                    if (isRadius || name == "crossSection") {
                        ASSERT_EQ(double(column.values[row]), value * (isRadius ? u : u * u)) << name;
                    } else if (name == "vx") {
                        ASSERT_EQ(shown.vector(g, "vx", row), host.vector(expected.vector(g, "vx", row)));
                    } else if (unit != "m" && unit != "m/s" && name[0] != 'q') {
                        ASSERT_EQ(double(column.values[row]), value) << name;
                    }
                }
            }
        }
    }
}

TEST(UnitsAndAxes, eventsAreInTheWorldOfTheHost)
{
    HostScene reference(kLibraryWorld);
    reference.add(fx::test::kSparks);
    reference.play(60);
    const std::vector<FxEvent> expected = reference.events();
    const auto isCollision = [](const FxEvent& event) { return event.kind == FX_EVENT_COLLIDED; };
    ASSERT_GT(std::count_if(expected.begin(), expected.end(), isCollision), 10);
    for (const HostConvention& host : kExactWorlds) {
        SCOPED_TRACE(host);
        HostScene played(host);
        played.add(fx::test::kSparks);
        played.play(60);
        const std::vector<FxEvent> events = played.events();
        ASSERT_EQ(events.size(), expected.size());
        for (size_t i = 0; i < events.size(); ++i) {
            ASSERT_EQ(events[i].tick, expected[i].tick);
            ASSERT_EQ(glm::make_vec3(events[i].position), host.vector(glm::make_vec3(expected[i].position)));
            ASSERT_EQ(glm::dvec3(glm::make_vec3(events[i].velocity)),
                      host.vector(glm::make_vec3(expected[i].velocity)));
            ASSERT_EQ(glm::dvec3(glm::make_vec3(events[i].normal)),
                      host.direction(glm::make_vec3(expected[i].normal)));
            ASSERT_EQ(double(events[i].speed), double(expected[i].speed) * host.unitsPerMeter);
        }
    }
}

TEST(UnitsAndAxes, camerasOfCullingAndItsReportsAreThoseOfTheHost)
{
    std::vector<HostConvention> hosts(kExactWorlds.begin(), kExactWorlds.end());
    hosts.insert(hosts.begin(), kLibraryWorld);
    float reach = 0.0f;
    FxVisibility expected{};
    const FxActivationHints anyDistance = fxDefaultActivationHints();
    for (const HostConvention& host : hosts) {
        SCOPED_TRACE(host);
        HostScene watched(host, false);
        const FxInstanceId id = watched.add(kBounded);
        FxFocus focus = fxDefaultFocus();
        host.set(focus.origin, host.vector(kHostPlace + glm::dvec3(0.0, 0.0, 10.0)));
        const glm::mat4 view = host.ofWorld(glm::mat4(1.0f), true);
        const glm::mat4 projection = host.projection(glm::perspective(1.0f, 1.5f, 0.125f, 64.0f));
        std::copy_n(glm::value_ptr(view), 16, focus.view);
        std::copy_n(glm::value_ptr(projection), 16, focus.projection);
        focus.margin = float(0.5 * host.unitsPerMeter);
        focus.maxDistance = 40.0 * host.unitsPerMeter;
        ASSERT_EQ(fxScene_SetFocus(watched.scene, &focus, 1), FX_OK) << fxGetLastErrorMessage();
        watched.play(10);
        FxInstanceActivity activity{};
        activity.structSize = sizeof activity;
        ASSERT_EQ(fxScene_GetInstanceActivity(watched.scene, id, &activity), FX_OK);
        EXPECT_EQ(activity.state, uint32_t(FX_INSTANCE_ACTIVE));
        if (reach == 0.0f)
            reach = activity.reach;
        EXPECT_LT(reach, 10.0f); // [m], not unknown
        EXPECT_EQ(activity.reach, float(double(reach) * host.unitsPerMeter));
        FxFrameDef camera = fxDefaultFrameDef();
        std::copy_n(focus.origin, 3, camera.origin);
        std::copy_n(focus.view, 16, camera.view);
        std::copy_n(focus.projection, 16, camera.projection);
        camera.width = camera.height = 64;
        FxVisibility report{};
        report.structSize = sizeof report;
        ASSERT_EQ(fxScene_ExplainVisibility(watched.scene, id, &camera, &report), FX_OK)
            << fxGetLastErrorMessage();
        EXPECT_EQ(report.cause, uint32_t(FX_VISIBILITY_IN_VIEW));
        if (expected.structSize == 0)
            expected = report;
        EXPECT_EQ(report.radius, float(double(expected.radius) * host.unitsPerMeter));
        EXPECT_EQ(report.distance, float(double(expected.distance) * host.unitsPerMeter));
        EXPECT_EQ(report.pixels, expected.pixels);
        // 50 m away is too far for the camera, and 8 m for the hint
        host.set(focus.origin, host.vector(kHostPlace + glm::dvec3(0.0, 0.0, 50.0)));
        ASSERT_EQ(fxScene_SetFocus(watched.scene, &focus, 1), FX_OK);
        watched.play(2);
        ASSERT_EQ(fxScene_GetInstanceActivity(watched.scene, id, &activity), FX_OK);
        EXPECT_EQ(activity.reason, uint32_t(FX_REASON_TOO_FAR));
        host.set(focus.origin, host.vector(kHostPlace + glm::dvec3(0.0, 0.0, 12.0)));
        FxActivationHints hints = fxDefaultActivationHints();
        hints.maxDistance = float(4.0 * host.unitsPerMeter);
        ASSERT_EQ(fxScene_SetFocus(watched.scene, &focus, 1), FX_OK);
        ASSERT_EQ(fxScene_SetActivationHints(watched.scene, id, &hints), FX_OK);
        watched.play(2);
        ASSERT_EQ(fxScene_GetInstanceActivity(watched.scene, id, &activity), FX_OK);
        EXPECT_EQ(activity.reason, uint32_t(FX_REASON_TOO_FAR));
        hints.maxDistance = float(40.0 * host.unitsPerMeter);
        ASSERT_EQ(fxScene_SetActivationHints(watched.scene, id, &hints), FX_OK);
        watched.play(2);
        ASSERT_EQ(fxScene_GetInstanceActivity(watched.scene, id, &activity), FX_OK);
        EXPECT_NE(activity.reason, uint32_t(FX_REASON_TOO_FAR));
        // beside the frustum, within a margin or not
        focus.maxDistance = 0.0;
        host.set(focus.origin, host.vector(kHostPlace + glm::dvec3(60.0, 0.0, 10.0)));
        for (const double margin : {80.0, 30.0}) {
            focus.margin = float(margin * host.unitsPerMeter);
            ASSERT_EQ(fxScene_SetFocus(watched.scene, &focus, 1), FX_OK);
            ASSERT_EQ(fxScene_SetActivationHints(watched.scene, id, &anyDistance), FX_OK);
            watched.play(3);
            ASSERT_EQ(fxScene_GetInstanceActivity(watched.scene, id, &activity), FX_OK);
            EXPECT_EQ(activity.reason, uint32_t(margin > 50.0 ? FX_REASON_NONE : FX_REASON_OUTSIDE))
                << margin;
        }
    }
}

TEST(UnitsAndAxes, aMatrixThatMirrorsTheWorldIsRefused)
{
    const HostConvention unity = kExactWorlds[0];
    HostScene watched(unity, false);
    FxFocus focus = fxDefaultFocus();
    const glm::mat4 projection = glm::perspective(1.0f, 1.5f, 0.125f, 64.0f);
    std::copy_n(glm::value_ptr(projection), 16, focus.projection);
    EXPECT_EQ(fxScene_SetFocus(watched.scene, &focus, 1),
              FX_ERROR_INVALID_ARGUMENT); // the identity of Unity's axes
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("looks along -z"), std::string::npos)
        << fxGetLastErrorMessage();
    focus.view[10] = -1.0f;
    EXPECT_EQ(fxScene_SetFocus(watched.scene, &focus, 1), FX_OK) << fxGetLastErrorMessage();
}

TEST(UnitsAndAxes, aSavedStateContinuesInAnotherWorld)
{
    HostScene saved(kExactWorlds[2]), restored(kLibraryWorld);
    const FxInstanceId id = saved.add(fx::test::kSparks);
    fx::test::loadText(restored.context, fx::test::kSparks);
    saved.play(20);
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(saved.scene, nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(saved.scene, state.data(), size, &size), FX_OK);
    ASSERT_EQ(fxScene_RestoreState(restored.scene, state.data(), size), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(restored.hash(), saved.hash());
    saved.play(20);
    restored.play(20);
    EXPECT_EQ(restored.hash(), saved.hash());
    FxInstanceInfo there{}, here{};
    there.structSize = here.structSize = sizeof there;
    FxInstanceId one{};
    uint32_t count = 0;
    ASSERT_EQ(fxScene_GetInstances(restored.scene, &one, 1, &count), FX_OK);
    ASSERT_EQ(fxScene_GetInstanceInfo(saved.scene, id, &there), FX_OK);
    ASSERT_EQ(fxScene_GetInstanceInfo(restored.scene, one, &here), FX_OK);
    EXPECT_EQ(glm::make_vec3(here.position), kHostPlace);
    EXPECT_EQ(glm::make_vec3(there.position), kExactWorlds[2].vector(kHostPlace));
}

TEST(UnitsAndAxes, anOlderHeaderHasTheWorldOfTheLibrary)
{
    FxContextDef def = fxDefaultContextDef();
    def.structSize = offsetof(FxContextDef, unitsPerMeter);
    def.unitsPerMeter = 0.0; // not read
    FxContext* context = nullptr;
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK) << fxGetLastErrorMessage();
    EXPECT_TRUE(context->world.isLibraryWorld());
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}

TEST(UnitsAndAxes, previewsOfPresetsAreInTheWorldOfTheHost)
{
    for (const HostConvention& host : kExactWorlds) {
        HostScene scene(host, false);
        FxPresetPreview preview{};
        preview.structSize = sizeof preview;
        const FxPresetId preset = fx::test::loadText(
            scene.context, R"({"version": 1, "emitters": [], "preview": {"camera": {"position": [1, 2, 3],
            "target": [0, 0.5, -1]}, "lighting": {"sunDirection": [0, 3, 4]}}})");
        ASSERT_EQ(fxGetPresetPreview(scene.context, preset, &preview), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(glm::make_vec3(preview.cameraPosition), host.vector({1.0, 2.0, 3.0})) << host;
        EXPECT_EQ(glm::make_vec3(preview.cameraTarget), host.vector({0.0, 0.5, -1.0})) << host;
        const glm::dvec3 sun(glm::make_vec3(preview.sunDirection));
        EXPECT_LT(farthest(sun, host.direction({0.0, 0.6, 0.8})), 1e-7) << host;
    }
}

TEST(UserData, canBeChangedWhileTheInstanceRuns)
{
    HostScene played(kLibraryWorld, false);
    const FxInstanceId id = played.add(fx::test::kDrop);
    played.play(2);
    const uint64_t before = played.hash();
    ASSERT_EQ(fxScene_SetUserData(played.scene, id, 77), FX_OK);
    uint64_t number = 0;
    ASSERT_EQ(fxScene_GetUserData(played.scene, id, &number), FX_OK);
    EXPECT_EQ(number, 77u);
    EXPECT_EQ(played.hash(), before);
    EXPECT_EQ(played.events().front().userData, 5u); // recorded before
    size_t size = 0;
    ASSERT_EQ(fxScene_SaveState(played.scene, nullptr, 0, &size), FX_OK);
    std::vector<std::byte> state(size);
    ASSERT_EQ(fxScene_SaveState(played.scene, state.data(), size, &size), FX_OK);
    ASSERT_EQ(fxScene_SetUserData(played.scene, id, 1), FX_OK);
    ASSERT_EQ(fxScene_RestoreState(played.scene, state.data(), size), FX_OK);
    ASSERT_EQ(fxScene_GetUserData(played.scene, id, &number), FX_OK);
    EXPECT_EQ(number, 77u);
    played.play(60);
    const std::vector<FxEvent> events = played.events();
    ASSERT_FALSE(events.empty());
    for (const FxEvent& event : events)
        EXPECT_EQ(event.userData, 77u);
    EXPECT_EQ(fxScene_SetUserData(played.scene, FxInstanceId{1}, 3), FX_ERROR_STALE_ID);
    EXPECT_EQ(fxScene_SetUserData(nullptr, id, 3), FX_ERROR_INVALID_ARGUMENT);
}
