// The functions of fx_view_setup.h.
#include "fxsdk/api/acquired_snapshots.h"
#include "fxsdk/api/check.h"
#include "fxsdk/api/context.h"
#include "fxsdk/api/guarded.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_preset.h"
#include "fxsdk/fx_view_setup.h"
#include "fxsdk/scene/effect_framing.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace {

using fx::api::HostWorld;
using fx::base::Code;
using fx::base::Result;
using fx::base::Status;

constexpr double kFarthest = 1e9; // [m]
constexpr double kNearest = 1e-6; // [m]

/// A camera in meters, in the axes of the library.
struct Camera
{
    glm::dvec3 eye, target; ///< [m]
    float fovY;             ///< [rad]
};

Status checkFrame(const HostWorld& world, float nearDistance, const FxFrameDef& frame)
{
    fx::api::Checks check;
    check.range(nearDistance, world.fromMeters(1e-4f), world.fromMeters(1e6f), "nearDistance");
    check.range(frame.width, 1, 16384, "ioFrame.width");
    check.range(frame.height, 1, 16384, "ioFrame.height");
    check.range(frame.depthConvention, uint32_t(FX_DEPTH_STANDARD), uint32_t(FX_DEPTH_REVERSED),
                "ioFrame.depthConvention");
    check.flag(frame.zeroToOne, "ioFrame.zeroToOne");
    return check.status();
}

/// Writes the rows right, up and back of an eye that looks from one place to another.
void writeView(const HostWorld& world, const Camera& camera, float* out)
{
    const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
    glm::dvec3 right = glm::cross(glm::dvec3(0.0, 1.0, 0.0), back);
    if (glm::length(right) < 1e-6)
        right = {1.0, 0.0, 0.0};
    right = glm::normalize(right);
    const glm::dvec3 rows[] = {right, glm::cross(back, right), back};
    std::fill_n(out, 16, 0.0f);
    out[15] = 1.0f;
    for (int row = 0; row < 3; ++row) {
        float axis[3];
        world.writeDirection(glm::vec3(rows[row]), axis);
        for (int column = 0; column < 3; ++column)
            out[4 * column + row] = axis[column];
    }
}

/// Writes a perspective without a far plane. Depth is (m10 z + m14) / -z at the place z < 0, of which the
/// near plane and infinity have to get the ends of the range.
void writeProjection(float fovY, float nearDistance, const FxFrameDef& frame, float* out)
{
    const float focal = 1.0f / std::tan(0.5f * fovY);
    const float lowest = frame.zeroToOne ? 0.0f : -1.0f;
    const bool isReversed = frame.depthConvention == FX_DEPTH_REVERSED;
    const float atNear = isReversed ? 1.0f : lowest;
    const float atInfinity = isReversed ? lowest : 1.0f;
    std::fill_n(out, 16, 0.0f);
    out[0] = focal * float(frame.height) / float(frame.width);
    out[5] = focal;
    out[10] = -atInfinity;
    out[11] = -1.0f;
    out[14] = (atNear - atInfinity) * nearDistance;
}

/// @param find returns the camera, given the aspect of the frame
template <class Find>
Status setCamera(const HostWorld& world, float nearDistance, FxFrameDef* ioFrame, Find&& find)
{
    FxFrameDef frame;
    if (Status status = fx::api::readStruct(ioFrame, "ioFrame", fxDefaultFrameDef(), frame); !status)
        return status;
    if (Status status = checkFrame(world, nearDistance, frame); !status)
        return status;
    const Result<Camera> camera = find(double(frame.width) / double(frame.height));
    if (!camera)
        return camera.status();
    if (!(glm::distance(camera->eye, camera->target) >= kNearest))
        return fx::api::invalid("the eye is at the place at which it looks: give another target, or another "
                                "camera in the preview of the preset");
    world.writePosition(camera->eye, frame.origin);
    writeView(world, *camera, frame.view);
    writeProjection(camera->fovY, nearDistance, frame, frame.projection);
    return fx::api::writeStruct(frame, ioFrame, "ioFrame");
}

Result<Camera> givenCamera(const HostWorld& world, const double* eye, const double* target, float fovY)
{
    const double farthest = world.fromMeters(kFarthest);
    fx::api::Checks check;
    check.notNull(eye, "eye");
    check.notNull(target, "target");
    if (!check.status())
        return check.status();
    check.range3(eye, -farthest, farthest, "eye");
    check.range3(target, -farthest, farthest, "target");
    check.range(fovY, 0.01f, 3.1f, "fovY (in radians)");
    if (!check.status())
        return check.status();
    return Camera{world.position(eye), world.position(target), fovY};
}

/// The camera of the author, where the instance is.
Camera authorsCamera(const fx::sim::PreviewDef& preview, const fx::base::Placement& placement)
{
    const auto placed = [&](const glm::dvec3& place) {
        return placement.position + glm::dquat(placement.rotation) * (double(placement.scale) * place);
    };
    return {placed(preview.cameraPosition), placed(preview.cameraTarget), glm::radians(preview.fovYDegrees)};
}

/// A camera that sees what the last update has shown of the instance.
Result<Camera> framingCamera(FxScene& scene, fx::scene::LocalId id, double aspect)
{
    fx::scene::EffectFraming framing(&scene.context->memory);
    framing.nextMoment();
    {
        const fx::api::AcquiredSnapshots shown(scene.scene);
        if (shown.newer())
            framing.add(*shown.newer(), id);
    }
    if (framing.isEmpty())
        return Status(Code::NotFound,
                      "the instance shows nothing at the last update, and its preset has no camera: call "
                      "fxScene_Update before, fxScene_ExplainVisibility, or fxSetFrameCamera");
    const float fovY = glm::radians(fx::sim::PreviewDef().fovYDegrees);
    const auto camera =
        framing.place(double(fovY), aspect, scene.scene.placementOf(id).position.y, kFarthest);
    return Camera{camera.position, camera.target, fovY};
}

} // namespace

FxResult fxSetFrameCamera(FxContext* context, const double eye[3], const double target[3], float fovY,
                          float nearDistance, FxFrameDef* ioFrame)
{
    return fx::api::guarded(__func__, fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        return setCamera(context->world, nearDistance, ioFrame,
                         [&](double) { return givenCamera(context->world, eye, target, fovY); });
    });
}

FxResult fxScene_SetFrameCamera(FxScene* scene, FxInstanceId instance, float nearDistance,
                                FxFrameDef* ioFrame)
{
    return fx::api::withInstance(__func__, scene, instance, [&](fx::scene::LocalId id) -> Status {
        return setCamera(scene->context->world, nearDistance, ioFrame, [&](double aspect) -> Result<Camera> {
            const fx::sim::PreviewDef& preview = scene->scene.effectOf(id)->preview;
            return preview.hasCamera ? authorsCamera(preview, scene->scene.placementOf(id))
                                     : framingCamera(*scene, id, aspect);
        });
    });
}

FxResult fxSetPreviewSettings(FxContext* context, FxPresetId preset, FxViewSettings* ioSettings)
{
    return fx::api::guarded(__func__, fx::api::logOf(context), [&]() -> Status {
        if (!context)
            return fx::api::invalid("context is null");
        FxViewSettings settings;
        if (Status status = fx::api::readStruct(ioSettings, "ioSettings", fxDefaultViewSettings(), settings);
            !status)
            return status;
        const auto effect = context->findPreset(preset);
        if (!effect)
            return effect.status();
        const fx::sim::PreviewDef& preview = (*effect)->preview;
        settings.composition = FX_COMPOSITION_AUTOMATIC;
        settings.multipleScattering = 3; // as presets request
        settings.exposureEv100 = preview.exposureEv100;
        settings.groundAlbedo = preview.groundAlbedo;
        context->world.writeDirection(preview.sunDirection, settings.sunDirection);
        std::copy_n(glm::value_ptr(preview.sunIlluminance), 3, settings.sunIlluminance);
        std::copy_n(glm::value_ptr(preview.skyLuminance), 3, settings.skyLuminance);
        return fx::api::writeStruct(settings, ioSettings, "ioSettings");
    });
}
