#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/collisions/obstacles.h"
#include "simulation/particles/fields/turn.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

class PlaneObstacle final : public Obstacle
{
public:
    explicit PlaneObstacle(const CollisionDef& def)
        : isGround_(def.kind == ObstacleKind::Ground),
          normal_(isGround_ ? glm::vec3(0.0f, 1.0f, 0.0f) : unitOrUp(def.axis)), margin_(def.margin),
          offset_(glm::dot(glm::dvec3(normal_), glm::dvec3(def.position)))
    {}

    bool isThere(const StepContext& step) const override { return !isGround_ || step.groundHeight > -1e30f; }
    Clearance clearance(const StepContext& step, const glm::vec3& p) const override
    {
        return {float(distance(step, p)), normal_};
    }
    LegContact meet(const StepContext& step, const ContactLeg& leg) const override
    {
        const glm::dvec3 n(normal_);
        const double d = distance(step, leg.from);
        const double v = glm::dot(n, glm::dvec3(leg.velocity));
        const double a = 0.5 * glm::dot(n, glm::dvec3(leg.acceleration));
        double time = 0.0; // of the first contact
        if (d > 0.0 || v > 0.0 || (v == 0.0 && a >= 0.0)) {
            time = fallTime(std::max(d, 0.0), v, a);
            if (!(time <= double(leg.seconds)))
                return {};
        }
        const float share = float(time / double(leg.seconds));
        return {true, std::min(share, 1.0f), leg.at(float(time)), normal_};
    }
    Outline outline(const StepContext& step) const override
    {
        return {Outline::Plane, normal_, float(offsetOf(step)), false};
    }

    bool describe(base::GpuModules& out) const override
    {
        const double offset = isGround_ ? 0.0 : offset_ + double(margin_);
        const float high = float(offset), middle = float(offset - double(high)); // in three parts: exact
        const float low = float(offset - double(high) - double(middle));
        out.add(isGround_ ? base::GpuModule::Ground : base::GpuModule::Plane,
                {normal_.x, normal_.y, normal_.z, high, middle, low, margin_});
        return true;
    }

private:
    /// First t >= 0 at which d + v t + a t^2 falls to 0; infinite when it never does.
    static double fallTime(double d, double v, double a)
    {
        constexpr double kNever = INFINITY;
        const double inside = v * v - 4.0 * a * d;
        if (inside < 0.0)
            return kNever;
        const double root = std::sqrt(inside);
        if (v < 0.0)
            return 2.0 * d / (root - v); // the first root, also for a = 0
        return a < 0.0 ? (v + root) / (-2.0 * a) : kNever;
    }
    double offsetOf(const StepContext& step) const
    {
        return (isGround_ ? double(step.groundHeight) : offset_) + double(margin_);
    }
    double distance(const StepContext& step, const glm::vec3& p) const
    {
        return glm::dot(glm::dvec3(normal_), glm::dvec3(p)) - offsetOf(step);
    }

    bool isGround_;
    glm::vec3 normal_;
    float margin_;
    double offset_; ///< [m]
};

} // namespace

std::unique_ptr<Obstacle> makePlaneObstacle(const CollisionDef& def)
{
    return std::make_unique<PlaneObstacle>(def);
}

} // namespace fx::sim
