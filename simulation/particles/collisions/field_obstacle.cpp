#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/collisions/obstacles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

namespace fx::sim {

namespace {

/// Triangles through their field of distances: those of the preset, or the host's.
class FieldObstacle final : public Obstacle
{
public:
    explicit FieldObstacle(const CollisionDef& def) : field_(def.field)
    {
        if (!field_)
            return;
        base::Placement placement;
        placement.position = field_->origin() - glm::dvec3(def.position);
        own_.emplace(*field_, placement);
    }

    bool isThere(const StepContext& step) const override { return colliderOf(step) != nullptr; }
    Clearance clearance(const StepContext& step, const glm::vec3& p) const override
    {
        const DistanceField::Sample s = colliderOf(step)->sample(p);
        return {s.distance, s.normal};
    }
    LegContact meet(const StepContext& step, const ContactLeg& leg) const override
    {
        const Collider::Hit hit = colliderOf(step)->sweep(leg.from, leg.to);
        if (!hit.found)
            return {};
        return {true, hit.share, leg.from + hit.share * (leg.to - leg.from), hit.normal};
    }

    /// What the host gives: while there is nothing, there is nothing to do.
    bool describe(base::GpuModules& out) const override
    {
        out.dependsOnHost = true;
        return !own_;
    }

private:
    const Collider* colliderOf(const StepContext& step) const { return own_ ? &*own_ : step.collider; }

    std::shared_ptr<const DistanceField> field_;
    std::optional<Collider> own_;
};

/// What the host says for itself.
class HookObstacle final : public Obstacle
{
public:
    bool isThere(const StepContext& step) const override
    {
        return step.contactHook != nullptr && step.contactHook->meet != nullptr;
    }
    Clearance clearance(const StepContext&, const glm::vec3&) const override
    {
        return {1e30f, glm::vec3(0.0f)}; // it is only asked about ways
    }
    LegContact meet(const StepContext& step, const ContactLeg& leg) const override
    {
        const float from[3] = {leg.from.x, leg.from.y, leg.from.z}, to[3] = {leg.to.x, leg.to.y, leg.to.z};
        float share = 1.0f, normal[3] = {0.0f, 0.0f, 0.0f};
        if (step.contactHook->meet(step.contactHook->user, from, to, &share, normal) == 0)
            return {};
        const glm::vec3 n(normal[0], normal[1], normal[2]);
        const float size = glm::length(n);
        if (!(share >= 0.0f && share <= 1.0f) || !(size > 0.0f && size < 1e30f))
            return {}; // not an answer
        return {true, share, leg.from + share * (leg.to - leg.from), n / size};
    }
    bool describe(base::GpuModules& out) const override
    {
        out.dependsOnHost = true;
        return true;
    }
};

} // namespace

std::unique_ptr<Obstacle> makeFieldObstacle(const CollisionDef& def)
{
    if (def.kind == ObstacleKind::Hook)
        return std::make_unique<HookObstacle>();
    return std::make_unique<FieldObstacle>(def);
}

std::unique_ptr<Obstacle> makeObstacle(const CollisionDef& def)
{
    switch (def.kind) {
    case ObstacleKind::Sphere:
        return makeSphereObstacle(def);
    case ObstacleKind::Box:
        return makeBoxObstacle(def);
    case ObstacleKind::HeightField:
        return makeHeightObstacle(def);
    case ObstacleKind::Mesh:
    case ObstacleKind::Scene:
    case ObstacleKind::Hook:
        return makeFieldObstacle(def);
    case ObstacleKind::Depth:
        return makeDepthObstacle(def);
    case ObstacleKind::Plane:
    case ObstacleKind::Ground:
        break;
    }
    return makePlaneObstacle(def);
}

} // namespace fx::sim
