#include "foundation/snapshot/gpu_modules.h"
#include "simulation/particles/collisions/obstacles.h"

namespace fx::sim {

namespace {

/// The surfaces of a view's depth texture. Only the GPU has it: on the CPU particles move freely.
class DepthObstacle final : public Obstacle
{
public:
    explicit DepthObstacle(const CollisionDef& def) : thickness_(def.thickness), margin_(def.margin) {}

    bool isThere(const StepContext&) const override { return false; }
    Clearance clearance(const StepContext&, const glm::vec3&) const override
    {
        return {1e30f, glm::vec3(0.0f)};
    }
    LegContact meet(const StepContext&, const ContactLeg&) const override { return {}; }
    bool describe(base::GpuModules& out) const override
    {
        out.add(base::GpuModule::Depth, {thickness_, margin_});
        return true;
    }

private:
    float thickness_; ///< [m]
    float margin_;    ///< [m]
};

} // namespace

std::unique_ptr<Obstacle> makeDepthObstacle(const CollisionDef& def)
{
    return std::make_unique<DepthObstacle>(def);
}

} // namespace fx::sim
