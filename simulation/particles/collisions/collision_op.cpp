#include "simulation/particles/collisions/collision_op.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simulation/particles/collisions/collision_op.cpp"
#include <hwy/foreach_target.h> // before everything that is compiled for each target

#include "foundation/simd/instruction_set.h"
#include "simulation/particles/collisions/contact_path.h"
#include "simulation/particles/forces/tile_lanes-inl.h"
#include "simulation/particles/gpu_module_source.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace fx::sim::modules::HWY_NAMESPACE {
namespace {

/// A ball around the way of each row: center and radius.
struct WayBall
{
    HWY_INLINE WayBall(const Tile& tile, uint32_t i)
    {
        const Float3 from{loadRow(tile.fromX + i), loadRow(tile.fromY + i), loadRow(tile.fromZ + i)};
        const Float3 to = loadPosition(tile, i), way = minus(to, from);
        const Float3 sag = minus(times(loadVelocity(tile, i), loadRow(tile.seconds + i)), way);
        center = times(plus(from, to), all(0.5f));
        // The parabola leaves its chord by at most |v1 T - (x1 - x0)| / 4.
        const Float slack = hn::Add(hn::Mul(hn::Sqrt(dot(center, center)), all(1e-5f)), all(1e-4f));
        radius = hn::Add(hn::Add(hn::Mul(hn::Sqrt(dot(way, way)), all(0.5001f)),
                                 hn::Mul(hn::Sqrt(dot(sag, sag)), all(0.2501f))),
                         slack);
    }
    Float3 center;
    Float radius;
};

/// Adds 1 to the rows of `ioNear` that the obstacle may concern; rounding is covered by the ball's slack.
void markNear(const Obstacle::Outline& outline, const Tile& tile, float* ioNear)
{
    const Float one = all(1.0f);
    for (uint32_t i = 0; i < tile.padded; i += uint32_t(hn::Lanes(Floats()))) {
        const WayBall ball(tile, i);
        Float distance = hn::Zero(Floats());
        if (outline.form == Obstacle::Outline::Plane) {
            distance = hn::Sub(dot(ball.center, all(outline.center)), all(outline.size));
        } else if (outline.form == Obstacle::Outline::Ball) {
            const Float3 out = minus(ball.center, all(outline.center));
            distance = hn::Sub(hn::Sqrt(dot(out, out)), all(outline.size));
            if (outline.isHollow)
                distance = hn::Neg(distance);
        }
        addRow(ioNear + i, hn::IfThenElseZero(hn::Le(distance, ball.radius), one));
    }
}

} // namespace
} // namespace fx::sim::modules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fx::sim {

namespace modules {
namespace {
HWY_EXPORT(markNear);
}
} // namespace modules

namespace {

class CollisionOp final : public TileOp, public GpuModuleSource
{
public:
    explicit CollisionOp(std::span<const CollisionDef> defs)
    {
        for (const CollisionDef& def : defs.first(std::min(defs.size(), kMaxObstacles))) {
            entries_.push_back({makeObstacle(def), def.response, std::clamp(def.restitution, 0.0f, 1.0f),
                                std::clamp(def.friction, 0.0f, 1.0f)});
            dependsOnScene_ =
                dependsOnScene_ || def.kind == ObstacleKind::Scene || def.kind == ObstacleKind::Hook;
            const bool isMet = def.kind != ObstacleKind::Depth; // on the CPU
            holds_ = holds_ || (isMet && def.response == ContactResponse::Stick);
        }
    }

    TileBound bound() const override { return {0.0f}; } // no contact makes anything faster
    TilePhase phase() const override { return TilePhase::Contact; }
    bool collides() const override { return dependsOnScene_; }
    bool keepsFlags() const override { return holds_; }
    bool describe(base::GpuModules& out) const override
    {
        for (const ObstacleEntry& entry : entries_) {
            const size_t before = out.uses.size();
            if (!entry.obstacle->describe(out))
                return false;
            if (out.uses.size() == before)
                continue; // it is not there
            out.numbers.insert(out.numbers.end(),
                               {float(uint8_t(entry.response)), entry.restitution, entry.friction});
            if (out.uses.back().module == base::GpuModule::Depth)
                continue; // what a view shows ends no instance
            out.kills = out.kills || entry.response == ContactResponse::Kill;
            out.sticks = out.sticks || entry.response == ContactResponse::Stick;
        }
        return true;
    }
    void run(const TileContext& context, const void*, Tile& tile) const override
    {
        alignas(64) float near[kTileRows] = {};
        base::applyInstructionSetLimit();
        for (const ObstacleEntry& entry : entries_)
            if (entry.obstacle->isThere(context.step)) {
                using namespace modules;
                HWY_DYNAMIC_DISPATCH(markNear)(entry.obstacle->outline(context.step), tile, near);
            }
        constexpr uint32_t kSkipped = tile_flag::Stuck | tile_flag::Empty | tile_flag::Killed;
        for (uint32_t i = 0; i < tile.count; ++i)
            if (near[i] > 0.0f && tile.seconds[i] > 0.0f && (tile.flags[i] & kSkipped) == 0)
                runRow(context, tile, i);
    }

private:
    void runRow(const TileContext& context, Tile& tile, uint32_t i) const
    {
        ContactState free;
        free.position = {tile.x[i], tile.y[i], tile.z[i]};
        free.velocity = {tile.vx[i], tile.vy[i], tile.vz[i]};
        const glm::vec3 from(tile.fromX[i], tile.fromY[i], tile.fromZ[i]);
        ContactList contacts;
        const ContactState end = followPath(entries_, context.step, from, free, tile.seconds[i],
                                            context.listener ? &contacts : nullptr);
        tile.x[i] = end.position.x;
        tile.y[i] = end.position.y;
        tile.z[i] = end.position.z;
        tile.vx[i] = end.velocity.x;
        tile.vy[i] = end.velocity.y;
        tile.vz[i] = end.velocity.z;
        if (!end.isHit)
            return;
        for (uint32_t k = 0; k < contacts.count; ++k)
            context.listener->touch(context, tile, i, contacts.contacts[k]);
        if ((tile.flags[i] & tile_flag::Hit) == 0 || end.isKilled)
            tile.contact[i] = end.contact;
        tile.flags[i] |= tile_flag::Hit | tile_flag::Collided;
        if (end.isKilled)
            tile.flags[i] |= tile_flag::Killed;
        if (end.isStuck)
            tile.flags[i] |= tile_flag::Stuck;
    }

    std::vector<ObstacleEntry> entries_;
    bool dependsOnScene_ = false;
    bool holds_ = false;
};

} // namespace

std::unique_ptr<TileOp> makeCollisionOp(std::span<const CollisionDef> defs)
{
    return std::make_unique<CollisionOp>(defs);
}

} // namespace fx::sim
#endif
