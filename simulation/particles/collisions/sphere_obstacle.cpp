#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/collisions/obstacles.h"
#include "simulation/particles/fields/turn.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

class SphereObstacle final : public Obstacle
{
public:
    explicit SphereObstacle(const CollisionDef& def)
        : center_(def.position), sign_(def.isHollow ? -1.0f : 1.0f),
          radius_(std::max(def.size.x + sign_ * def.margin, 0.0f))
    {}

    Clearance clearance(const StepContext&, const glm::vec3& p) const override
    {
        const glm::vec3 out = p - center_;
        return {sign_ * (glm::length(out) - radius_), sign_ * unitOrUp(out)};
    }
    LegContact meet(const StepContext&, const ContactLeg& leg) const override
    {
        const glm::dvec3 m = glm::dvec3(leg.from) - glm::dvec3(center_);
        const glm::dvec3 w = glm::dvec3(leg.to) - glm::dvec3(leg.from);
        const double radius = double(radius_);
        const double ww = glm::dot(w, w), mw = glm::dot(m, w);
        const double c = (glm::length(m) - radius) * (glm::length(m) + radius); // |m|^2 - R^2
        const double inside = mw * mw - ww * c;
        const bool isIn = sign_ * c <= 0.0; // on the wrong side of the surface, or on it
        if (!(ww > 0.0) || (isIn && sign_ * mw >= 0.0))
            return {};
        double s = 0.0;
        if (!isIn) {
            if (inside < 0.0 || (sign_ > 0.0f && mw >= 0.0))
                return {};
            s = sign_ > 0.0f ? c / (std::sqrt(inside) - mw) : (std::sqrt(inside) - mw) / ww; // (2)
            if (!(s <= 1.0))
                return {};
        }
        const glm::vec3 place(glm::dvec3(leg.from) + s * w);
        return {true, float(s), place, sign_ * unitOrUp(place - center_)};
    }
    Outline outline(const StepContext&) const override
    {
        return {Outline::Ball, center_, radius_, sign_ < 0.0f};
    }

    bool describe(base::GpuModules& out) const override
    {
        out.add(base::GpuModule::Sphere, {center_.x, center_.y, center_.z, radius_, sign_});
        return true;
    }

private:
    glm::vec3 center_;
    float sign_; ///< -1: matter is outside
    float radius_;
};

} // namespace

std::unique_ptr<Obstacle> makeSphereObstacle(const CollisionDef& def)
{
    return std::make_unique<SphereObstacle>(def);
}

} // namespace fx::sim
