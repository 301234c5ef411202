// Conversion of units and axes of the host, function by function.
#include "foundation/snapshot/particle_kind.h"
#include "fxsdk/api/check.h"
#include "fxsdk/api/host_snapshot.h"
#include "fxsdk/api/host_world.h"
#include "fxsdk/api/view_object.h"
#include "tests/api/host_convention.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory_resource>
#include <string>

using fx::api::HostWorld;
using fx::test::allWorlds;
using fx::test::HostConvention;
using fx::test::kExactWorlds;
using fx::test::kLibraryWorld;

namespace {

const glm::quat kTurn(0.48f, 0.36f, 0.48f, -0.64f);
const glm::dvec3 kPlace(3.0, 0.5, -2.0);

HostWorld worldOf(const HostConvention& convention)
{
    return HostWorld(convention.contextDef());
}

glm::mat4 someView()
{
    return glm::translate(glm::mat4_cast(kTurn), glm::vec3(1.0f, -2.0f, 0.5f));
}

template <class Vector>
double farthest(const Vector& a, const Vector& b)
{
    return double(glm::length(a - b));
}

} // namespace

TEST(HostWorld, theWorldOfTheLibraryKeepsEveryBit)
{
    const HostWorld world = worldOf(kLibraryWorld);
    EXPECT_TRUE(world.isLibraryWorld());
    EXPECT_FALSE(worldOf(kExactWorlds[0]).isLibraryWorld());
    const double given[] = {-0.0, 1e-300, 12345.678901234567};
    const float small[] = {-0.0f, 1.1e-40f, 3.1415927f, -0.0f};
    const auto same = [](const void* a, const void* b, size_t size) { return std::memcmp(a, b, size) == 0; };
    EXPECT_TRUE(same(glm::value_ptr(world.position(given)), given, sizeof given));
    EXPECT_TRUE(same(glm::value_ptr(world.vector(small)), small, 3 * sizeof(float)));
    EXPECT_TRUE(same(glm::value_ptr(world.direction(small)), small, 3 * sizeof(float)));
    const glm::quat turn = world.rotation(small);
    const float xyzw[] = {turn.x, turn.y, turn.z, turn.w};
    EXPECT_TRUE(same(xyzw, small, sizeof small));
    const glm::mat4 view = someView(), projection = glm::perspective(1.0f, 1.5f, 0.1f, 77.0f);
    EXPECT_TRUE(same(glm::value_ptr(world.view(glm::value_ptr(view))), &view, sizeof view));
    EXPECT_TRUE(same(glm::value_ptr(world.ofWorld(glm::value_ptr(view))), &view, sizeof view));
    EXPECT_TRUE(same(glm::value_ptr(world.projection(glm::value_ptr(projection))), &projection, sizeof view));
    float out[4];
    world.writeVector({-0.0f, 1.1e-40f, 3.1415927f}, out);
    EXPECT_TRUE(same(out, small, 3 * sizeof(float)));
    world.writeRotation(turn, out);
    EXPECT_TRUE(same(out, small, sizeof small));
}

TEST(HostWorld, allConversionsAgreeWithVectorsAlongTheAxesAndHaveAnInverse)
{
    const std::vector<HostConvention> worlds = allWorlds();
    ASSERT_EQ(worlds.size(), 48u);
    for (const HostConvention& host : worlds) {
        SCOPED_TRACE(host.right * 100 + host.up * 10 + host.forward);
        const HostWorld world = worldOf(host);
        double position[3];
        world.writePosition(kPlace, position);
        EXPECT_LT(farthest(glm::make_vec3(position), host.vector(kPlace)), 1e-9);
        EXPECT_LT(farthest(world.position(position), kPlace), 1e-12);
        float vector[3], xyzw[4];
        world.writeVector(glm::vec3(kPlace), vector);
        EXPECT_LT(farthest(glm::dvec3(glm::make_vec3(vector)), host.vector(kPlace)), 1e-4);
        EXPECT_LT(farthest(glm::dvec3(world.vector(vector)), kPlace), 1e-6);
        world.writeDirection(glm::vec3(kPlace), vector);
        EXPECT_EQ(glm::dvec3(glm::make_vec3(vector)), host.direction(kPlace));
        EXPECT_EQ(world.direction(vector), glm::vec3(kPlace));
        world.writeRotation(kTurn, xyzw);
        EXPECT_EQ(world.rotation(xyzw), kTurn);
        // a point that turns about the origin, in numbers of the host
        const glm::quat turn(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
        const glm::dvec3 turned = glm::dvec3(kTurn * glm::vec3(kPlace));
        EXPECT_LT(farthest(glm::dvec3(turn * glm::vec3(host.direction(kPlace))), host.direction(turned)),
                  1e-5);
    }
}

TEST(HostWorld, aCameraSeesAPointAtThePixelWhereTheHostSeesIt)
{
    const glm::mat4 perspective = glm::perspective(1.0f, 1.5f, 0.1f, 77.0f);
    const glm::mat4 orthographic = glm::ortho(-3.0f, 4.0f, -2.0f, 1.0f, 0.5f, 60.0f);
    for (const HostConvention& host : allWorlds())
        for (const glm::mat4& projection : {perspective, orthographic}) {
            const HostWorld world = worldOf(host);
            const glm::mat4 view = host.ofWorld(someView(), true),
                            hostProjection = host.projection(projection);
            const glm::vec4 seen = hostProjection * view * glm::vec4(glm::vec3(host.vector(kPlace)), 1.0f);
            const glm::vec4 drawn = world.projection(glm::value_ptr(hostProjection)) *
                                    world.view(glm::value_ptr(view)) * glm::vec4(glm::vec3(kPlace), 1.0f);
            EXPECT_LT(farthest(seen / seen.w, drawn / drawn.w), 1e-5);
            EXPECT_EQ(fx::api::viewFault(glm::value_ptr(world.view(glm::value_ptr(view)))), nullptr);
        }
}

TEST(HostWorld, boundsContainTheSamePointsAndStayEmpty)
{
    const HostWorld world = worldOf(kExactWorlds[5]);
    const fx::base::Bounds bounds = world.bounds({{-1, -2, -3}, {4, 5, 6}});
    const glm::vec3 first(kExactWorlds[5].vector({-1, -2, -3})), last(kExactWorlds[5].vector({4, 5, 6}));
    EXPECT_EQ(bounds.min, glm::min(first, last));
    EXPECT_EQ(bounds.max, glm::max(first, last));
    EXPECT_TRUE(world.bounds({}).empty());
}

TEST(HostWorld, everyColumnWithALengthHasAMeaning)
{
    FxContext* context = nullptr;
    const FxContextDef def = fxDefaultContextDef();
    ASSERT_EQ(fxCreateContext(&def, &context), FX_OK);
    std::map<std::string, fx::api::Meaning> meanings;
    for (fx::base::KindId id = 0; id < context->schema.size(); ++id) {
        const fx::base::KindDesc& kind = context->schema.kind(id);
        for (const auto descs : {kind.columns, kind.constants})
            for (size_t i = 0; i < descs.size();) {
                const fx::api::Meaning meaning = fx::api::meaningOf(descs, i);
                meanings[std::string(descs[i].name)] = meaning;
                const std::string_view unit = descs[i].unit;
                const bool isLength = unit == "m" || unit == "m2" || unit == "m/s";
                EXPECT_TRUE(!isLength || meaning != fx::api::Meaning::Number)
                    << kind.name << " " << descs[i].name;
                const std::array known{"1", "m", "m2", "m/s", "s", "K", "rad", "cd", "cd/m2"};
                EXPECT_NE(std::find(known.begin(), known.end(), unit), known.end())
                    << kind.name << " " << unit;
                i += meaning == fx::api::Meaning::Quaternion                                         ? 4
                     : meaning == fx::api::Meaning::Vector || meaning == fx::api::Meaning::Direction ? 3
                                                                                                     : 1;
            }
    }
    using fx::api::Meaning;
    EXPECT_EQ(meanings["x"], Meaning::Vector);
    EXPECT_EQ(meanings["vx"], Meaning::Vector);
    EXPECT_EQ(meanings["radius"], Meaning::Length);
    EXPECT_EQ(meanings["crossSection"], Meaning::Area);
    EXPECT_EQ(meanings["axisX"], Meaning::Direction);
    EXPECT_EQ(meanings["qx"], Meaning::Quaternion);
    EXPECT_EQ(meanings["rotationX"], Meaning::Quaternion);
    EXPECT_EQ(meanings["originX"], Meaning::Vector);
    EXPECT_EQ(meanings["emissionR"], Meaning::Number);
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}

TEST(HostWorld, aSnapshotIsConvertedByTheMeaningOfItsColumns)
{
    namespace column = fx::base::particle_column;
    namespace constant = fx::base::particle_constant;
    fx::base::SnapshotSchema schema;
    const fx::base::KindId particle = schema.add(fx::base::kParticleKind);
    const fx::base::KindId ribbon = schema.add(fx::base::kRibbonKind);
    fx::base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    snapshot.begin(10, 1);
    const auto setVector = [](fx::base::SnapshotGroup& io, size_t first, const glm::dvec3& value) {
        for (int i = 0; i < 3; ++i)
            io.editColumn(first + size_t(i))[0] = float(value[i]);
    };
    fx::base::SnapshotGroup& mesh = snapshot.addGroup(particle, 1);
    mesh.editInfo().count = 1;
    setVector(mesh, column::PositionX, kPlace);
    setVector(mesh, column::VelocityX, 2.0 * kPlace);
    setVector(mesh, column::OrientationX, {kTurn.x, kTurn.y, kTurn.z});
    mesh.editColumn(column::OrientationW)[0] = kTurn.w;
    mesh.editColumn(column::Radius)[0] = 0.5f;
    mesh.editColumn(column::Age)[0] = 0.75f;
    mesh.editColumn64(column::Color)[0] = 7;
    mesh.editConstants()[constant::AxisX] = 0.6f;
    mesh.editConstants()[constant::AxisY] = 0.8f;
    mesh.editConstants()[constant::Softness] = 0.25f;
    mesh.editConstants()[constant::Luminance] = 3.0f;
    for (const float arcPerTile : {2.0f, 0.0f}) {
        fx::base::SnapshotGroup& strip = snapshot.addGroup(ribbon, 1);
        strip.editInfo().count = 1;
        strip.editColumn(fx::base::ribbon_column::Arc)[0] = 0.75f;
        strip.editConstants()[constant::ArcPerTile] = arcPerTile;
    }

    const HostConvention host = kExactWorlds[2];
    const auto copy = fx::api::toHostWorld(worldOf(host), snapshot, std::pmr::get_default_resource());
    ASSERT_EQ(copy->groupCount(), 3u);
    const fx::base::SnapshotGroup& out = copy->group(0);
    const auto vectorAt = [&](size_t first) {
        return glm::dvec3(out.column(first)[0], out.column(first + 1)[0], out.column(first + 2)[0]);
    };
    EXPECT_EQ(vectorAt(column::PositionX), host.vector(kPlace));
    EXPECT_EQ(vectorAt(column::VelocityX), host.vector(2.0 * kPlace));
    const glm::quat turn = host.rotation(kTurn);
    EXPECT_EQ(vectorAt(column::OrientationX), glm::dvec3(turn.x, turn.y, turn.z));
    EXPECT_EQ(out.column(column::OrientationW)[0], kTurn.w);
    EXPECT_EQ(out.column(column::Radius)[0], 64.0f);
    EXPECT_EQ(out.column(column::Age)[0], 0.75f);
    EXPECT_EQ(out.column64(column::Color)[0], 7u);
    const auto constants = out.constants();
    EXPECT_EQ(glm::make_vec3(&constants[constant::AxisX]), glm::vec3(host.direction({0.6f, 0.8f, 0.0})));
    EXPECT_EQ(constants[constant::Softness], 32.0f);
    EXPECT_EQ(constants[constant::Luminance], 3.0f);
    EXPECT_EQ(copy->group(1).column(fx::base::ribbon_column::Arc)[0], 96.0f); // [m]
    EXPECT_EQ(copy->group(2).column(fx::base::ribbon_column::Arc)[0], 0.75f); // a share of the strip
}

TEST(HostWorld, aFrameIsConvertedAsAWhole)
{
    for (const HostConvention& host : allWorlds()) {
        FxFrameDef def = fxDefaultFrameDef();
        host.set(def.origin, host.vector({1e4, 20.0, -3e3}));
        const glm::mat4 view = host.ofWorld(someView(), true);
        const glm::mat4 projection = host.projection(glm::perspective(1.0f, 1.5f, 0.1f, 77.0f));
        glm::mat4 shadow(0.02f);
        shadow[1] = {0.01f, 0.03f, -0.04f, 0.0f};
        shadow[3] = {0.5f, 0.25f, 0.125f, 1.0f};
        std::copy_n(glm::value_ptr(view), 16, def.view);
        std::copy_n(glm::value_ptr(projection), 16, def.projection);
        std::copy_n(glm::value_ptr(host.ofWorld(shadow, false)), 16, def.sunShadowMatrix);
        def.sunShadowEdge = float(0.25 * host.unitsPerMeter);
        def.rangeNear = float(2.0 * host.unitsPerMeter);
        def.rangeFar = float(5.0 * host.unitsPerMeter);
        def.colorTexture = 1;
        def.width = def.height = 8;
        fx::render::FrameRequest request;
        const fx::base::Status status = fx::api::convertFrame(worldOf(host), def, request);
        ASSERT_TRUE(status.ok()) << status.message();
        EXPECT_LT(farthest(request.camera.origin, glm::dvec3(1e4, 20.0, -3e3)), 1e-9);
        for (int i = 0; i < 4; ++i) {
            EXPECT_LT(farthest(request.sunShadow.fromWorld[i], shadow[i]), 1e-6);
            EXPECT_LT(farthest(request.camera.view[i], someView()[i]), 1e-6);
        }
        EXPECT_FLOAT_EQ(request.sunShadow.edge, 0.25f);
        EXPECT_FLOAT_EQ(request.range.from, 2.0f);
        EXPECT_FLOAT_EQ(request.range.to, 5.0f);
    }
}

TEST(HostWorld, aProjectionIsCheckedInMeters)
{
    const auto convert = [](double unitsPerMeter, const glm::mat4& projection) {
        const HostConvention host{"", unitsPerMeter, FX_AXIS_X, FX_AXIS_Y, FX_AXIS_NEGATIVE_Z};
        FxFrameDef def = fxDefaultFrameDef();
        std::copy_n(glm::value_ptr(projection), 16, def.projection);
        def.colorTexture = 1;
        def.width = def.height = 8;
        fx::render::FrameRequest request;
        return fx::api::convertFrame(worldOf(host), def, request);
    };
    const glm::mat4 wide = glm::ortho(-1e4f, 1e4f, -1e4f, 1e4f, 10.0f, 1e6f); // a square of 200 m in cm
    EXPECT_TRUE(convert(100.0, wide).ok());
    const glm::mat4 rolled = wide * glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0, 0, 1));
    EXPECT_NE(convert(100.0, rolled).message().find("rolls or shears"), std::string::npos);
    glm::mat4 offset = glm::perspective(1.0f, 1.5f, 1e-4f, 1.0f); // in kilometers
    EXPECT_TRUE(convert(1e-3, offset).ok());
    offset[3].x = 5e-5f; // 5 cm
    EXPECT_NE(convert(1e-3, offset).message().find("moves the eye"), std::string::npos);
}

TEST(HostWorld, rangesEndWhereTheHostSaysInEveryUnit)
{
    const auto endOf = [](double unitsPerMeter, float rangeFar) {
        const HostConvention host{"", unitsPerMeter, FX_AXIS_X, FX_AXIS_Y, FX_AXIS_NEGATIVE_Z};
        FxFrameDef def = fxDefaultFrameDef();
        const glm::mat4 projection = glm::perspective(1.0f, 1.5f, 0.1f, 77.0f);
        std::copy_n(glm::value_ptr(projection), 16, def.projection);
        def.rangeFar = rangeFar;
        def.colorTexture = 1;
        def.width = def.height = 8;
        fx::render::FrameRequest request;
        EXPECT_TRUE(fx::api::convertFrame(worldOf(host), def, request).ok());
        return request.range.to;
    };
    const float all = fx::render::DepthRange().to;
    EXPECT_FLOAT_EQ(endOf(1e6, 2e9f), 2000.0f); // micrometers
    EXPECT_EQ(endOf(1e6, 1e9f), all);
    EXPECT_EQ(endOf(1e6, 1e15f), all);
    EXPECT_EQ(endOf(1.0, 1e9f), all);
    EXPECT_EQ(endOf(1e-3, 1e9f), all);
    EXPECT_FLOAT_EQ(endOf(1e-3, 2.0f), 2000.0f);
}
