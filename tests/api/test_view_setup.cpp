#include "fxsdk/api/check.h"
#include "fxsdk/api/check_projection.h"
#include "fxsdk/api/context.h"
#include "tests/api/api_fixture.h"
#include "tests/api/host_convention.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cstddef>
#include <cstring>
#include <limits>
#include <string>

using fx::test::HostConvention;
using fx::test::kLibraryWorld;
using ViewSetup = fx::test::ApiTest;

namespace {

constexpr float kFovY = 0.9f;
constexpr float kNear = 0.25f; // [m]
constexpr glm::dvec3 kEye{3.0, 2.0, 7.0}, kTarget{-1.0, 0.5, 2.0};

FxFrameDef sizedFrame()
{
    FxFrameDef frame = fxDefaultFrameDef();
    frame.width = 320;
    frame.height = 180;
    return frame;
}

/// A context of another world.
class World
{
public:
    explicit World(const HostConvention& host) : host_(host)
    {
        const FxContextDef def = host.contextDef();
        EXPECT_EQ(fxCreateContext(&def, &context_), FX_OK) << fxGetLastErrorMessage();
    }
    ~World() { fxDestroyContext(context_); }
    World(const World&) = delete;

    /// @param eye, target [m] in the axes of the library
    FxFrameDef framed(const glm::dvec3& eye, const glm::dvec3& target, FxFrameDef frame = sizedFrame())
    {
        double there[3], aim[3];
        host_.set(there, host_.vector(eye));
        host_.set(aim, host_.vector(target));
        EXPECT_EQ(fxSetFrameCamera(context_, there, aim, kFovY, float(kNear * host_.unitsPerMeter), &frame),
                  FX_OK)
            << fxGetLastErrorMessage();
        return frame;
    }

    /// Normalized device coordinates of a place. @param place [m] in the axes of the library
    glm::dvec3 seen(const FxFrameDef& frame, const glm::dvec3& place) const
    {
        const glm::dvec3 relative = host_.vector(place) - glm::make_vec3(frame.origin);
        const glm::dvec4 clip = glm::dmat4(glm::make_mat4(frame.projection)) *
                                glm::dmat4(glm::make_mat4(frame.view)) * glm::dvec4(relative, 1.0);
        return glm::dvec3(clip) / clip.w;
    }

    FxContext* context() { return context_; }

private:
    HostConvention host_;
    FxContext* context_ = nullptr;
};

/// A scene with instances of one preset.
struct HostView
{
    HostView(FxContext* context, const std::string& preset) : preset_(fx::test::loadText(context, preset))
    {
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context, &def, &scene), FX_OK) << fxGetLastErrorMessage();
    }
    FxInstanceId add(FxInstanceDef def)
    {
        def.preset = preset_;
        FxInstanceId instance{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &def, &instance), FX_OK) << fxGetLastErrorMessage();
        return instance;
    }
    FxScene* scene = nullptr;

private:
    FxPresetId preset_;
};

} // namespace

TEST_F(ViewSetup, aCameraIsThatOfOtherLibraries)
{
    World world(kLibraryWorld);
    const FxFrameDef frame = world.framed(kEye, kTarget);
    const glm::dmat4 wanted = glm::infinitePerspective(double(kFovY), 320.0 / 180.0, double(kNear)) *
                              glm::lookAt(kEye, kTarget, glm::dvec3(0.0, 1.0, 0.0));
    for (const glm::dvec3& place : {kTarget, glm::dvec3(0.0), glm::dvec3(-3.0, 4.0, 1.0)}) {
        const glm::dvec4 clip = wanted * glm::dvec4(place, 1.0);
        EXPECT_LT(glm::distance(world.seen(frame, place), glm::dvec3(clip) / clip.w), 1e-6);
    }
    EXPECT_EQ(frame.origin[2], 7.0);
    EXPECT_EQ(frame.width, 320);
}

TEST_F(ViewSetup, everyWorldSeesTheSamePicture)
{
    World library(kLibraryWorld);
    const FxFrameDef wanted = library.framed(kEye, kTarget);
    for (const HostConvention& host : fx::test::allWorlds()) {
        World world(host);
        const FxFrameDef frame = world.framed(kEye, kTarget);
        for (const glm::dvec3& place : {glm::dvec3(0.0), glm::dvec3(-3.0, 4.0, 1.0)})
            EXPECT_LT(glm::distance(world.seen(frame, place), library.seen(wanted, place)), 1e-5);
        EXPECT_EQ(fx::api::viewFault(glm::value_ptr(world.context()->world.view(frame.view))), nullptr);
    }
}

TEST_F(ViewSetup, everyDepthConventionIsKept)
{
    World world(kLibraryWorld);
    const glm::dvec3 ahead = glm::normalize(kTarget - kEye);
    for (const bool isReversed : {false, true})
        for (const uint32_t zeroToOne : {0u, 1u}) {
            FxFrameDef def = sizedFrame();
            def.depthConvention = isReversed ? FX_DEPTH_REVERSED : FX_DEPTH_STANDARD;
            def.zeroToOne = zeroToOne;
            const FxFrameDef frame = world.framed(kEye, kTarget, def);
            EXPECT_EQ(fx::api::projectionFault(frame.projection), nullptr);
            EXPECT_EQ(fx::api::frameProjectionFault(frame.projection, isReversed), nullptr);
            const double lowest = zeroToOne ? 0.0 : -1.0;
            EXPECT_NEAR(world.seen(frame, kEye + double(kNear) * ahead).z, isReversed ? 1.0 : lowest, 1e-5);
            EXPECT_NEAR(world.seen(frame, kEye + 1e7 * ahead).z, isReversed ? lowest : 1.0, 1e-5);
        }
}

TEST_F(ViewSetup, aCameraMayLookStraightUpAndDown)
{
    World world(kLibraryWorld);
    for (const double direction : {-1.0, 1.0}) {
        const glm::dvec3 target(0.0, 5.0 * direction, 0.0);
        const FxFrameDef frame = world.framed(glm::dvec3(0.0), target);
        const glm::dvec3 middle = world.seen(frame, target),
                         right = world.seen(frame, target + glm::dvec3(1, 0, 0));
        const glm::dvec3 high = world.seen(frame, target + glm::dvec3(0, 0, direction));
        EXPECT_LT(glm::length(glm::dvec2(middle)), 1e-6);
        EXPECT_GT(right.x, 0.1);
        EXPECT_LT(std::abs(right.y), 1e-6);
        EXPECT_GT(high.y, 0.1);
    }
}

TEST_F(ViewSetup, aRefusedCameraChangesNothing)
{
    const double eye[] = {0.0, 1.0, 5.0}, target[] = {0.0, 1.0, 0.0};
    const double nowhere[] = {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
    const auto refused = [&](FxContext* context, const double* from, const double* to, float fovY,
                             float nearDistance, FxFrameDef frame, FxResult wanted, const char* word) {
        const FxFrameDef before = frame;
        EXPECT_EQ(fxSetFrameCamera(context, from, to, fovY, nearDistance, &frame), wanted) << word;
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find(word), std::string::npos)
            << fxGetLastErrorMessage();
        EXPECT_EQ(std::memcmp(&before, &frame, sizeof frame), 0) << word;
    };
    const FxResult invalid = FX_ERROR_INVALID_ARGUMENT;
    refused(nullptr, eye, target, 1.0f, 0.1f, sizedFrame(), invalid, "context");
    refused(context_, nullptr, target, 1.0f, 0.1f, sizedFrame(), invalid, "eye");
    refused(context_, eye, nullptr, 1.0f, 0.1f, sizedFrame(), invalid, "target");
    refused(context_, nowhere, target, 1.0f, 0.1f, sizedFrame(), invalid, "eye");
    refused(context_, eye, nowhere, 1.0f, 0.1f, sizedFrame(), invalid, "target");
    refused(context_, eye, eye, 1.0f, 0.1f, sizedFrame(), invalid,
            "the eye is at the place at which it looks");
    refused(context_, eye, target, 3.2f, 0.1f, sizedFrame(), invalid, "fovY");
    refused(context_, eye, target, 50.0f, 0.1f, sizedFrame(), invalid, "fovY"); // degrees
    refused(context_, eye, target, 1.0f, 0.0f, sizedFrame(), invalid, "nearDistance");
    refused(context_, eye, target, 1.0f, 0.1f, fxDefaultFrameDef(), invalid, "width");
    FxFrameDef frame = sizedFrame();
    frame.depthConvention = 7;
    refused(context_, eye, target, 1.0f, 0.1f, frame, invalid, "depthConvention");
    frame = sizedFrame();
    frame.structSize = 3;
    refused(context_, eye, target, 1.0f, 0.1f, frame, FX_ERROR_VERSION, "structSize");
    EXPECT_EQ(fxSetFrameCamera(context_, eye, target, 1.0f, 0.1f, nullptr), invalid);
}

TEST_F(ViewSetup, placesThatDifferByRoundingAloneAreRefused)
{
    const double eye[] = {0.0, 0.0, 1e-320}, target[] = {0.0, 0.0, 0.0};
    FxFrameDef frame = sizedFrame();
    EXPECT_EQ(fxSetFrameCamera(context_, eye, target, 1.0f, 0.1f, &frame), FX_ERROR_INVALID_ARGUMENT);
}

TEST_F(ViewSetup, settingsAreThoseOfThePreview)
{
    const std::string text = R"({"version": 1, "emitters": [], "preview": {"exposureEv100": 9.5,
        "lighting": {"sunDirection": [0, 3, 4], "sunIlluminance": [5, 6, 7], "skyLuminance": [1, 2, 3],
        "groundAlbedo": 0.5}}})";
    for (const HostConvention& host : fx::test::kExactWorlds) {
        World world(host);
        const FxPresetId preset = fx::test::loadText(world.context(), text.c_str());
        FxViewSettings settings = fxDefaultViewSettings(), wanted = settings;
        settings.slabs = wanted.slabs = 6;
        wanted.composition = FX_COMPOSITION_AUTOMATIC;
        wanted.multipleScattering = 3;
        wanted.exposureEv100 = 9.5f;
        wanted.groundAlbedo = 0.5f;
        for (int i = 0; i < 3; ++i) {
            wanted.sunIlluminance[i] = 5.0f + float(i);
            wanted.skyLuminance[i] = 1.0f + float(i);
        }
        host.set(wanted.sunDirection, host.direction({0.0, 0.6f, 0.8f}));
        ASSERT_EQ(fxSetPreviewSettings(world.context(), preset, &settings), FX_OK) << fxGetLastErrorMessage();
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(settings.sunDirection[i], wanted.sunDirection[i], 1e-7f) << host;
        std::copy_n(wanted.sunDirection, 3, settings.sunDirection);
        EXPECT_EQ(std::memcmp(&settings, &wanted, sizeof settings), 0) << host;
    }
}

TEST_F(ViewSetup, anOlderViewHasNoMembersBeyondItsOwn)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.structSize = offsetof(FxViewSettings, sunDirection);
    settings.sunIlluminance[0] = -1.0f;
    ASSERT_EQ(fxSetPreviewSettings(context_, fountain_, &settings), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(settings.structSize, offsetof(FxViewSettings, sunDirection));
    EXPECT_EQ(settings.sunIlluminance[0], -1.0f);
}

TEST_F(ViewSetup, refusedSettingsDoNotChange)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.exposureEv100 = 3.0f;
    const FxViewSettings before = settings;
    EXPECT_EQ(fxSetPreviewSettings(nullptr, fountain_, &settings), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxSetPreviewSettings(context_, fountain_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxUnloadPreset(context_, fountain_), FX_OK);
    EXPECT_EQ(fxSetPreviewSettings(context_, fountain_, &settings), FX_ERROR_STALE_ID);
    EXPECT_EQ(std::memcmp(&before, &settings, sizeof settings), 0);
    settings.structSize = 5;
    EXPECT_EQ(fxSetPreviewSettings(context_, fountain_, &settings), FX_ERROR_VERSION);
}

TEST_F(ViewSetup, anInstanceIsSeenByTheCameraOfItsAuthorWhereItIs)
{
    const std::string text = R"({"version": 1, "emitters": [], "preview": {"camera": {"position": [1, 2, 3],
        "target": [0, 1, 0], "fovYDegrees": 60}}})";
    World library(kLibraryWorld);
    FxFrameDef atOrigin = sizedFrame();
    const double eye[] = {1.0, 2.0, 3.0}, target[] = {0.0, 1.0, 0.0};
    ASSERT_EQ(fxSetFrameCamera(library.context(), eye, target, 1.0471976f, 0.1f, &atOrigin), FX_OK);
    for (const HostConvention& host : fx::test::kExactWorlds) {
        World world(host);
        HostView shown(world.context(), text);
        const glm::dvec3 place(5.0, 1.0, -2.0);
        const glm::quat turn = glm::angleAxis(0.7f, glm::vec3(0.0f, 1.0f, 0.0f));
        FxInstanceDef def = fxDefaultInstanceDef();
        host.set(def.position, host.vector(place));
        const glm::quat there = host.rotation(turn);
        const float xyzw[] = {there.x, there.y, there.z, there.w};
        std::copy_n(xyzw, 4, def.rotation);
        def.scale = 2.0f;
        const FxInstanceId instance = shown.add(def);
        FxFrameDef frame = sizedFrame();
        ASSERT_EQ(fxScene_SetFrameCamera(shown.scene, instance, float(0.1 * host.unitsPerMeter), &frame),
                  FX_OK)
            << fxGetLastErrorMessage();
        // the same picture as of an instance at the origin
        for (const glm::dvec3& seen : {glm::dvec3(0.0), glm::dvec3(-0.5, 1.5, 0.5)}) {
            const glm::dvec3 moved = place + glm::dquat(turn) * (2.0 * seen);
            EXPECT_LT(
                glm::distance(glm::dvec2(world.seen(frame, moved)), glm::dvec2(library.seen(atOrigin, seen))),
                1e-5)
                << host;
        }
    }
}

TEST_F(ViewSetup, anInstanceWithoutACameraFillsThePictureWhereverItIs)
{
    for (const double size : {0.2, 3.0})
        for (const double away : {0.0, 1e5}) {
            World world(kLibraryWorld);
            HostView shown(
                world.context(),
                R"({"version": 1, "emitters": [{"shape": "box", "size": )" + std::to_string(size) +
                    R"(, "position": [0, 4, 0], "emission": {"bursts": [{"time": 0, "count": 500}]},
                "lifetime": 9, "speed": 0, "radius": 0.05, "opticalDepth": 1, "forces": {"gravity": 0}}]})");
            FxInstanceDef def = fxDefaultInstanceDef();
            def.position[0] = away;
            const FxInstanceId instance = shown.add(def);
            FxFrameDef frame = sizedFrame();
            const FxFrameDef before = frame;
            EXPECT_EQ(fxScene_SetFrameCamera(shown.scene, instance, 0.1f, &frame), FX_ERROR_NOT_FOUND);
            EXPECT_NE(std::string(fxGetLastErrorMessage()).find("fxScene_Update"), std::string::npos);
            EXPECT_EQ(std::memcmp(&before, &frame, sizeof frame), 0);
            ASSERT_EQ(fxScene_Update(shown.scene, fx::test::kFrame), FX_OK);
            ASSERT_EQ(fxScene_SetFrameCamera(shown.scene, instance, 0.1f, &frame), FX_OK)
                << fxGetLastErrorMessage();
            double widest = 0.0;
            for (int axis = 0; axis < 3; ++axis)
                for (const double side : {-size, size}) {
                    glm::dvec3 face(away, 4.0, 0.0); // corners may be cut: a few percent lie there
                    face[axis] += side;
                    const glm::dvec3 there = world.seen(frame, face);
                    EXPECT_LT(std::max(std::abs(there.x), std::abs(there.y)), 1.0);
                    widest = std::max(widest, std::abs(there.y));
                }
            EXPECT_GT(widest, 0.6); // and no farther away than it has to be
        }
}

TEST_F(ViewSetup, aCameraOfNoInstanceIsRefused)
{
    FxFrameDef frame = sizedFrame();
    EXPECT_EQ(fxScene_SetFrameCamera(nullptr, {}, 0.1f, &frame), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetFrameCamera(scene_, {}, 0.1f, &frame), FX_ERROR_STALE_ID);
    const FxInstanceId instance = addFountain();
    play(10);
    EXPECT_EQ(fxScene_SetFrameCamera(scene_, instance, -1.0f, &frame), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetFrameCamera(scene_, instance, 0.1f, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxScene_SetFrameCamera(scene_, instance, 0.1f, &frame), FX_OK) << fxGetLastErrorMessage();
    const uint64_t before = hash();
    EXPECT_EQ(fxScene_SetFrameCamera(scene_, instance, 0.1f, &frame), FX_OK);
    EXPECT_EQ(hash(), before);
}

TEST_F(ViewSetup, theCameraOfAStageIsRelativeToTheInstanceOnIt)
{
    // On its stage the effect stands elsewhere, turned and larger: the same picture of an effect at the
    // origin.
    const std::string text = R"({"version": 1, "emitters": [], "preview": {
        "camera": {"position": [4, 3, 9], "target": [1, 2, 0], "fovYDegrees": 50},
        "instance": {"position": [2, 1, -1], "rotationDegrees": [24, 30, 10], "scale": 2}}})";
    World world(kLibraryWorld);
    HostView shown(world.context(), text);
    FxFrameDef frame = sizedFrame(), onStage = sizedFrame();
    ASSERT_EQ(fxScene_SetFrameCamera(shown.scene, shown.add(fxDefaultInstanceDef()), 0.1f, &frame), FX_OK);
    const double eye[] = {4.0, 3.0, 9.0}, target[] = {1.0, 2.0, 0.0};
    ASSERT_EQ(fxSetFrameCamera(world.context(), eye, target, glm::radians(50.0f), 0.1f, &onStage), FX_OK);
    const glm::dquat turn = glm::angleAxis(glm::radians(10.0), glm::dvec3(0, 0, 1)) *
                            glm::angleAxis(glm::radians(30.0), glm::dvec3(0, 1, 0)) *
                            glm::angleAxis(glm::radians(24.0), glm::dvec3(1, 0, 0));
    const auto staged = [&](const glm::dvec3& place) { return glm::dvec3(2, 1, -1) + turn * (2.0 * place); };
    const glm::dvec3 middle(0.0);
    // up is that of the world of each, so that the picture may roll: distances to its middle are the same
    const auto away = [&](const FxFrameDef& seen, const glm::dvec3& place) {
        const glm::dvec3 there = world.seen(seen, place);
        return glm::length(glm::dvec2(there.x * 320.0 / 180.0, there.y));
    };
    for (const glm::dvec3& place : {middle, glm::dvec3(0.4, 0.3, 0.2), glm::dvec3(-0.5, 0.1, 0.4)})
        EXPECT_NEAR(away(frame, place), away(onStage, staged(place)), 1e-5);
}

TEST_F(ViewSetup, aCameraThatLooksAtItsOwnPlaceIsRefused)
{
    HostView shown(context_, R"({"version": 1, "emitters": [], "preview": {
        "camera": {"position": [1, 2, 3], "target": [1, 2, 3]}}})");
    FxFrameDef frame = sizedFrame();
    const FxFrameDef before = frame;
    EXPECT_EQ(fxScene_SetFrameCamera(shown.scene, shown.add(fxDefaultInstanceDef()), 0.1f, &frame),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(std::memcmp(&before, &frame, sizeof frame), 0);
}
