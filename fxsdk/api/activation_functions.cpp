// The functions of fx_activation.h.
#include "fxsdk/api/check_projection.h"
#include "fxsdk/api/scene_object.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/fx_activation.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace {

using fx::activation::Frustum;
using fx::api::HostWorld;
using fx::base::Status;

static_assert(int(FX_REASON_OUTSIDE) == int(fx::scene::Reason::Outside));
static_assert(int(FX_REASON_BUDGET) == int(fx::scene::Reason::Budget));
static_assert(int(FX_REASON_ENDED) == int(fx::scene::Reason::Ended));
static_assert(int(FX_CATCH_UP_AUTHORITATIVE) == int(fx::sim::CatchUp::Authoritative));

constexpr uint32_t kMaxFoci = 64;
constexpr float kMaxPixels = 65'536;
constexpr double kFarthest = 1e9; // [m]

Status checkFocus(const HostWorld& world, const FxFocus& focus)
{
    const double farthest = world.fromMeters(kFarthest);
    fx::api::Checks check;
    check.range(focus.height, 1.0f, kMaxPixels, "foci.height");
    check.range3(focus.origin, -farthest, farthest, "foci.origin");
    check.noFault(fx::api::viewFault(glm::value_ptr(world.view(focus.view))), "foci.view");
    check.noFault(fx::api::projectionFault(glm::value_ptr(world.projection(focus.projection))),
                  "foci.projection");
    check.range(focus.maxDistance, 0.0, farthest, "foci.maxDistance");
    check.range(focus.margin, 0.0f, world.fromMeters(1e6f), "foci.margin");
    check.range(focus.minPixels, 0.0f, kMaxPixels, "foci.minPixels");
    return check.status();
}

Frustum toFrustum(const HostWorld& world, const FxFocus& focus)
{
    Frustum::Limits limits;
    if (focus.maxDistance > 0)
        limits.maxDistance = world.toMeters(focus.maxDistance);
    limits.margin = world.toMeters(double(focus.margin));
    limits.minPixels = double(focus.minPixels);
    limits.height = double(focus.height);
    return {world.position(focus.origin), world.view(focus.view), world.projection(focus.projection), limits};
}

/// Cameras of any version of FxFocus: they lie structSize apart.
Status readFoci(const HostWorld& world, const FxFocus* foci, uint32_t count, std::pmr::vector<Frustum>& out)
{
    const auto* at = reinterpret_cast<const unsigned char*>(foci);
    for (uint32_t i = 0; i < count; ++i) {
        const auto* given = reinterpret_cast<const FxFocus*>(at);
        FxFocus known;
        if (Status status = fx::api::readStruct(given, "foci", fxDefaultFocus(), known); !status)
            return status;
        if (Status status = checkFocus(world, known); !status)
            return status;
        out.push_back(toFrustum(world, known));
        at += given->structSize;
    }
    return {};
}

FxFrameStats gatherStats(const FxScene& object)
{
    const fx::scene::Scene& scene = object.scene;
    const fx::scene::SceneCounters counters = scene.counters();
    const fx::scene::UpdateCounters& update = scene.lastUpdate();
    FxFrameStats stats{};
    stats.instances = counters.instances;
    stats.dormant = counters.dormant;
    stats.active = counters.active;
    stats.finished = counters.finished;
    stats.waking = counters.waking;
    stats.resting = counters.resting;
    stats.hidden = counters.hidden;
    stats.beyondBudget = update.denied;
    stats.wentOut = update.hidden;
    stats.cameBack = update.returned;
    stats.judged = update.judged;
    stats.simulations = counters.simulations;
    stats.particles = scene.particles();
    stats.particleSteps = update.work.particleSteps;
    stats.subSteps = update.work.subSteps;
    stats.neighborPairs = update.work.neighborPairs;
    stats.born = update.work.born;
    stats.dropped = update.work.dropped;
    stats.clamped = update.work.clamped;
    stats.catchUpParticleSteps = update.catchUpParticleSteps;
    stats.catchUpTicks = update.catchUpTicks;
    stats.debtTicks = update.work.debt;
    stats.allocations = object.updateAllocations;
    stats.nanosecondsPerParticle = scene.nanosecondsPerParticle();
    stats.estimatedMilliseconds = double(stats.particles) * stats.nanosecondsPerParticle * 1e-6;
    return stats;
}

FxInstanceActivity toApi(const HostWorld& world, const fx::scene::Scene::Activity& known)
{
    FxInstanceActivity activity{};
    activity.state = uint32_t(known.state);
    activity.reason = uint32_t(known.reason);
    activity.policy = uint32_t(known.policy);
    activity.particles = known.particles;
    activity.significance = float(known.significance);
    activity.milliseconds = float(known.milliseconds);
    activity.reach = float(world.fromMeters(std::min(known.reach, std::numeric_limits<double>::infinity())));
    activity.lagTicks = known.lag;
    return activity;
}

} // namespace

FxResult fxScene_SetFocus(FxScene* scene, const FxFocus* foci, uint32_t count)
{
    return fx::api::insideScene("fxScene_SetFocus", scene, [&]() -> Status {
        fx::api::Checks check;
        check.range(count, 0u, kMaxFoci, "count");
        if (count > 0)
            check.notNull(foci, "foci");
        if (!check.status())
            return check.status();
        scene->foci.clear();
        scene->foci.reserve(count);
        if (Status status = readFoci(scene->context->world, foci, count, scene->foci); !status)
            return status;
        scene->scene.setFocus(scene->foci);
        return {};
    });
}

FxResult fxScene_SetActivationHints(FxScene* scene, FxInstanceId instance, const FxActivationHints* hints)
{
    const auto set = [&](fx::scene::LocalId id) -> Status {
        FxActivationHints known;
        if (Status status = fx::api::readStruct(hints, "hints", fxDefaultActivationHints(), known); !status)
            return status;
        fx::api::Checks check;
        check.range(known.priority, 0.0f, 1e6f, "hints.priority");
        const HostWorld& world = scene->context->world;
        check.range(known.maxDistance, 0.0f, world.fromMeters(float(kFarthest)), "hints.maxDistance");
        check.flag(known.occluded, "hints.occluded");
        if (check.status())
            scene->scene.setHints(id,
                                  {known.priority, world.toMeters(known.maxDistance), known.occluded != 0});
        return check.status();
    };
    return fx::api::withInstance("fxScene_SetActivationHints", scene, instance, set);
}

FxResult fxScene_SetBudget(FxScene* scene, const FxBudget* budget)
{
    return fx::api::insideScene("fxScene_SetBudget", scene, [&]() -> Status {
        FxBudget known;
        if (Status status = fx::api::readStruct(budget, "budget", fxDefaultBudget(), known); !status)
            return status;
        fx::api::Checks check;
        check.range(known.milliseconds, 0.0f, 1e6f, "budget.milliseconds");
        check.range(known.nanosecondsPerParticle, 0.0f, 1e9f, "budget.nanosecondsPerParticle");
        if (check.status())
            scene->scene.setBudget({known.particles, double(known.milliseconds), known.bytes,
                                    double(known.nanosecondsPerParticle)});
        return check.status();
    });
}

FxResult fxScene_GetInstanceActivity(FxScene* scene, FxInstanceId instance, FxInstanceActivity* ioActivity)
{
    const auto get = [&](fx::scene::LocalId id) -> Status {
        return fx::api::writeStruct(toApi(scene->context->world, scene->scene.activity(id)), ioActivity,
                                    "ioActivity");
    };
    return fx::api::withInstance("fxScene_GetInstanceActivity", scene, instance, get);
}

FxResult fxScene_GetFrameStats(FxScene* scene, FxFrameStats* ioStats)
{
    return fx::api::insideScene("fxScene_GetFrameStats", scene, [&]() -> Status {
        return fx::api::writeStruct(gatherStats(*scene), ioStats, "ioStats");
    });
}
