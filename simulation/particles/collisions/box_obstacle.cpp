#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/collisions/obstacles.h"
#include "simulation/particles/fields/turn.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

class BoxObstacle final : public Obstacle
{
public:
    explicit BoxObstacle(const CollisionDef& def)
        : center_(def.position), axis_(unitOrUp(def.axis)), isHollow_(def.isHollow),
          half_(glm::max(def.size + (isHollow_ ? -def.margin : def.margin), glm::vec3(0.0f)))
    {}

    Clearance clearance(const StepContext&, const glm::vec3& p) const override
    {
        const glm::vec3 m = turnToY(axis_, p - center_);
        const glm::vec3 q = glm::abs(m) - half_;
        const glm::vec3 out = glm::max(q, glm::vec3(0.0f));
        const float outside = glm::length(out);
        glm::vec3 normal(0.0f);
        if (outside > 0.0f)
            normal = out / outside;
        else
            normal[largest(q)] = 1.0f;
        for (int k = 0; k < 3; ++k)
            normal[k] = std::copysign(normal[k], m[k]);
        const float distance = outside > 0.0f ? outside : q[largest(q)];
        const float sign = isHollow_ ? -1.0f : 1.0f;
        return {sign * distance, turnFromY(axis_, sign * normal)};
    }
    LegContact meet(const StepContext&, const ContactLeg& leg) const override
    {
        const glm::vec3 from = turnToY(axis_, leg.from - center_), to = turnToY(axis_, leg.to - center_);
        double enter = -INFINITY, leave = INFINITY;
        int enterAxis = 0, leaveAxis = 0;
        for (int k = 0; k < 3; ++k) { // (3)
            const double m = double(from[k]), w = double(to[k]) - m, h = double(half_[k]);
            if (w == 0.0) {
                if (std::abs(m) > h)
                    return {};
                continue;
            }
            const double first = ((w > 0.0 ? -h : h) - m) / w, last = ((w > 0.0 ? h : -h) - m) / w;
            if (first > enter) {
                enter = first;
                enterAxis = k;
            }
            if (last < leave) {
                leave = last;
                leaveAxis = k;
            }
        }
        return isHollow_ ? contactAt(leg, to - from, leave, leaveAxis, enter <= leave)
                         : contactAt(leg, to - from, enter, enterAxis, enter < leave && leave > 0.0);
    }
    Outline outline(const StepContext&) const override
    {
        return {Outline::Ball, center_, outlineRadius(), isHollow_};
    }

    bool describe(base::GpuModules& out) const override
    {
        out.add(base::GpuModule::Box, {center_.x, center_.y, center_.z, axis_.x, axis_.y, axis_.z, half_.x,
                                       half_.y, half_.z, isHollow_ ? 1.0f : 0.0f, outlineRadius()});
        return true;
    }

private:
    /// [m] of the ball around the box; of a hollow one, of the ball in it, in which nothing is near a wall.
    float outlineRadius() const
    {
        return isHollow_ ? std::min(half_.x, std::min(half_.y, half_.z)) : glm::length(half_);
    }

    static int largest(const glm::vec3& v)
    {
        return v.x >= v.y ? (v.x >= v.z ? 0 : 2) : (v.y >= v.z ? 1 : 2);
    }

    static float reachOf(const glm::vec3& p)
    {
        const glm::vec3 size = glm::abs(p);
        return size[largest(size)];
    }
    LegContact contactAt(const ContactLeg& leg, const glm::vec3& way, double s, int axis, bool isMet) const
    {
        // By rounding a way may begin a little inside of the face that it comes through, or leaves.
        const double length = double(glm::length(way)), most = double(reachOf(leg.from));
        const double slack = 1e-6 + 1e-6 * most;
        if (!isMet || !(s <= 1.0) || (!isHollow_ && s * length < -slack))
            return {};
        glm::vec3 normal(0.0f);
        normal[axis] = way[axis] > 0.0f ? -1.0f : 1.0f;
        const double share = std::clamp(s, 0.0, 1.0);
        const glm::dvec3 place = glm::dvec3(leg.from) + share * (glm::dvec3(leg.to) - glm::dvec3(leg.from));
        return {true, float(share), glm::vec3(place), turnFromY(axis_, normal)};
    }

    glm::vec3 center_;
    glm::vec3 axis_;
    bool isHollow_;
    glm::vec3 half_;
};

} // namespace

std::unique_ptr<Obstacle> makeBoxObstacle(const CollisionDef& def)
{
    return std::make_unique<BoxObstacle>(def);
}

} // namespace fx::sim
