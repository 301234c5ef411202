// The functions of fx_visibility.h.
#include "fxsdk/api/acquired_snapshots.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/api/view_object.h"
#include "fxsdk/fx_visibility.h"
#include "rendering/frame/view_block.h"
#include "rendering/frame/view_volume.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace {

using fx::base::Status;
using fx::render::CameraGeometry;
using fx::scene::InstanceState;

/// [pixel] A disk of this radius covers 1/255 of a pixel.
constexpr float kLeastPixels = 0.0353f;

/// A camera, and the height of its picture.
struct Watcher
{
    CameraGeometry camera;
    float height;  ///< [pixel]
    uint32_t mask; ///< FxFrameDef::visibilityMask
};

Status readCamera(const FxScene& scene, const FxFrameDef* given, std::optional<Watcher>& out)
{
    if (!given)
        return {};
    FxFrameDef known;
    if (Status status = fx::api::readStruct(given, "camera", fxDefaultFrameDef(), known); !status)
        return status;
    FxFrameDef camera = fxDefaultFrameDef(); // without targets, which are not used
    std::copy_n(known.origin, 3, camera.origin);
    std::copy_n(known.view, 16, camera.view);
    std::copy_n(known.projection, 16, camera.projection);
    camera.depthConvention = known.depthConvention;
    camera.zeroToOne = known.zeroToOne;
    camera.target = FX_TARGET_FRAMEBUFFER;
    camera.width = 1;
    camera.height = known.height;
    fx::render::FrameRequest request;
    if (Status status = fx::api::convertFrame(scene.context->world, camera, request); !status)
        return status;
    out = Watcher{fx::render::cameraGeometry(request.camera), float(known.height), known.visibilityMask};
    return {};
}

/// Looks at the spheres around the groups of one instance.
class GroupReport
{
public:
    explicit GroupReport(const std::optional<Watcher>& watcher) : watcher_(watcher) {}

    void add(const fx::base::GroupInfo& info)
    {
        any_ = true;
        if (info.bounds.empty()) { // nothing is known: it may be anywhere
            inView_ = inFront_ = isLarge_ = true;
            return;
        }
        const float radius = 0.5f * glm::length(info.bounds.max - info.bounds.min) * info.placement.scale;
        const glm::dvec3 center =
            info.placement.position +
            glm::dvec3(info.placement.rotation *
                       (0.5f * (info.bounds.min + info.bounds.max) * info.placement.scale));
        if (watcher_)
            look(glm::vec3(center - watcher_->camera.eye), radius);
        radius_ = std::max(radius_, radius);
    }

    FxVisibilityCause cause() const
    {
        if (!any_)
            return FX_VISIBILITY_NO_PARTICLES;
        if (!watcher_ || (inView_ && isLarge_))
            return FX_VISIBILITY_IN_VIEW;
        if (!inFront_)
            return FX_VISIBILITY_BEHIND;
        return inView_ ? FX_VISIBILITY_TOO_SMALL : FX_VISIBILITY_BESIDE;
    }

    void describe(const fx::api::HostWorld& world, FxVisibility& io) const
    {
        io.radius = world.fromMeters(radius_);
        io.distance = world.fromMeters(distance_);
        io.pixels = pixels_;
    }

private:
    void look(const glm::vec3& center, float radius)
    {
        const CameraGeometry& camera = watcher_->camera;
        const float distance = glm::length(center);
        const float slope = camera.orthographic ? 1.0f : std::max(distance, camera.nearDistance);
        const float pixels = radius * 0.5f * watcher_->height * std::abs(camera.clipScale.y) / slope;
        if (radius >= radius_) {
            distance_ = distance;
            pixels_ = pixels;
        }
        inFront_ |= glm::dot(center, camera.forward) + radius >= camera.nearDistance;
        if (!fx::render::ViewVolume(camera).touches(center, radius))
            return;
        inView_ = true;
        isLarge_ |= pixels >= kLeastPixels;
    }

    const std::optional<Watcher>& watcher_;
    bool any_ = false, inView_ = false, inFront_ = false, isLarge_ = false;
    float radius_ = 0.0f, distance_ = 0.0f, pixels_ = 0.0f; ///< of the largest sphere
};

FxVisibilityCause causeOf(InstanceState state, bool isMasked, const GroupReport& groups)
{
    if (isMasked && state != InstanceState::Dormant && state != InstanceState::Finished)
        return FX_VISIBILITY_MASKED;
    switch (state) {
    case InstanceState::Dormant:
        return FX_VISIBILITY_NOT_STARTED;
    case InstanceState::Finished:
        return FX_VISIBILITY_ENDED;
    case InstanceState::Hidden:
        return FX_VISIBILITY_HIDDEN;
    case InstanceState::Waking:
        return FX_VISIBILITY_CATCHING_UP;
    case InstanceState::Resting:
        return FX_VISIBILITY_NO_PARTICLES;
    case InstanceState::Active:
        break;
    }
    return groups.cause();
}

/// Whether a group has elements that are drawn.
bool isDrawn(const fx::base::SnapshotGroup& group, const fx::base::KindDesc& kind)
{
    return group.count() > 0 && kind.name != fx::base::kLightKind.name;
}

} // namespace

FxResult fxScene_ExplainVisibility(FxScene* scene, FxInstanceId instance, const FxFrameDef* camera,
                                   FxVisibility* ioVisibility)
{
    const auto explain = [&](fx::scene::LocalId id) -> Status {
        std::optional<Watcher> watcher;
        if (Status status = readCamera(*scene, camera, watcher); !status)
            return status;
        const fx::scene::Scene::Activity activity = scene->scene.activity(id);
        GroupReport groups(watcher);
        const fx::api::AcquiredSnapshots shown(scene->scene);
        for (size_t g = 0; shown.newer() && g < shown.newer()->groupCount(); ++g) {
            if (shown.newer()->name(g).instance != id)
                continue;
            const fx::base::SnapshotGroup& group = shown.newer()->group(g);
            if (isDrawn(group, shown.newer()->schema().kind(group.info().kind)))
                groups.add(group.info());
        }
        FxVisibility report{};
        const bool isMasked = watcher && (watcher->mask & scene->scene.visibilityMask(id)) == 0;
        report.cause = uint32_t(causeOf(activity.state, isMasked, groups));
        report.state = uint32_t(activity.state);
        report.reason = uint32_t(activity.reason);
        report.particles = activity.particles;
        groups.describe(scene->context->world, report);
        return fx::api::writeStruct(report, ioVisibility, "ioVisibility");
    };
    return fx::api::withInstance("fxScene_ExplainVisibility", scene, instance, explain);
}

const char* fxGetVisibilityText(uint32_t cause)
{
    static constexpr const char* kTexts[] = {
        "Particles are in view: if nothing is seen, look for a surface of the host before them, for an "
        "exposure "
        "that makes them black, and for smoke without light.",
        "The effect has not started: wait for its start time, and call fxScene_Update with a time above 0.",
        "The effect has ended: create another instance, or choose a preset that does not end.",
        "Culling hides the effect: FxVisibility::reason states why; see fxScene_SetFocus, "
        "fxScene_SetActivationHints and fxScene_SetBudget.",
        "The past of the effect is being simulated: call fxScene_Update until it is done.",
        "The effect has no particles at this moment: no birth is due yet, or intensity or emitting is 0.",
        "The effect is behind the camera or before the near plane: the camera looks along its -Z; check the "
        "signs of the view matrix, and that it is not the matrix from eye to world.",
        "The effect is beside the view: check the position, the view matrix, and FxContextDef::unitsPerMeter "
        "and "
        "axes.",
        "The effect is smaller than a pixel: check the position, the scale, and FxContextDef::unitsPerMeter.",
        "The visibility masks of the instance and of the frame share no bit: see fxScene_SetVisibilityMask "
        "and "
        "FxFrameDef::visibilityMask.",
    };
    return cause < std::size(kTexts) ? kTexts[cause] : "unknown cause";
}
