#include "simulation/particles/builtin_ops.h"

#include "foundation/random/philox.h"
#include "simulation/motion/curl_noise.h"
#include "simulation/particles/gpu_module_source.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <new>

namespace fx::sim {

namespace {

/// Gravity, buoyancy, wind and linear drag.
class AirOp final : public TileOp, public GpuModuleSource
{
public:
    explicit AirOp(const EmitterSettings& def) : def_(def), forces_(def.forces) {}

    TilePhase phase() const override { return TilePhase::Force; }
    bool describe(base::GpuModules& out) const override
    {
        if (forces_.buoyancy == 0.0f) {
            out.add(base::GpuModule::Gravity, {forces_.gravity});
            return true;
        }
        out.add(base::GpuModule::Lift,
                {forces_.gravity, forces_.buoyancy / kAirTemperature, def_.temperature.min - kAirTemperature,
                 def_.temperature.max - kAirTemperature});
        for (size_t i = 0; i <= base::kCurveSamples; ++i)
            out.numbers.push_back(def_.temperatureOverLife.at(float(i) / float(base::kCurveSamples))[0]);
        return true;
    }
    void run(const TileContext& context, const void*, Tile& tile) const override
    {
        const float drag = forces_.drag > 0.0f ? std::min(forces_.drag, 1e6f) : 0.0f;
        const float lift = forces_.buoyancy / kAirTemperature;
        const glm::vec3& g = context.step.gravity;
        for (uint32_t i = 0; i < tile.padded; ++i) {
            const float weight = forces_.gravity - lift * tile.excess[i]; // (T / T_air - 1) g upwards
            tile.ax[i] += weight * g.x;
            tile.ay[i] += weight * g.y;
            tile.az[i] += weight * g.z;
            tile.ux[i] += context.wind.x;
            tile.uy[i] += context.wind.y;
            tile.uz[i] += context.wind.z;
            tile.drag[i] += drag;
        }
    }

private:
    const EmitterSettings& def_; ///< outlives its program
    EmitterForces forces_;
};

/// Turbulent air.
class CurlOp final : public TileOp, public GpuModuleSource
{
public:
    explicit CurlOp(const EmitterForces& forces) : forces_(forces) {}

    TilePhase phase() const override { return TilePhase::Force; }
    size_t scratchBytes() const override { return sizeof(CurlNoise) * octaves(); }
    void prepare(const TileContext& context, void* scratch) const override
    {
        const StepContext& step = context.step;
        const base::Random4 words =
            base::philox({0, 0, step.solverIndex, uint32_t(base::RandomPurpose::Noise)}, step.seed);
        float strength = forces_.curlStrength;
        float scale = forces_.curlScale;
        double turns = context.begin * double(forces_.curlRate);
        for (uint32_t k = 0; k < octaves(); ++k) {
            new (static_cast<CurlNoise*>(scratch) + k)
                CurlNoise(words[0] + k * 0x9E3779B9u, strength, scale, turns);
            strength *= 0.5f;
            scale *= 0.5f;
            turns *= 2.0;
        }
    }
    bool describe(base::GpuModules& out) const override
    {
        for (uint32_t k = 0; k < octaves(); ++k)
            out.add(base::GpuModule::Curl, {}, kCurlWords);
        return true;
    }
    void writeWords(const void* scratch, uint32_t* out) const override
    {
        for (uint32_t k = 0; k < octaves(); ++k) {
            const CurlNoise::Parts parts = (static_cast<const CurlNoise*>(scratch) + k)->parts();
            *out++ = parts.seed;
            *out++ = std::bit_cast<uint32_t>(parts.gain);
            *out++ = std::bit_cast<uint32_t>(parts.perScale);
            for (const float* const table : {parts.cosine, parts.sine})
                for (uint32_t i = 0; i < CurlNoise::kPhases; ++i)
                    *out++ = std::bit_cast<uint32_t>(table[i]);
        }
    }
    void run(const TileContext&, const void* scratch, Tile& tile) const override
    {
        const CurlNoise* const noise = static_cast<const CurlNoise*>(scratch);
        for (uint32_t k = 0; k < octaves(); ++k)
            noise[k].addTo({tile.x, tile.y, tile.z}, {tile.ux, tile.uy, tile.uz}, tile.padded);
    }

private:
    static constexpr uint32_t kCurlWords = 3 + 2 * CurlNoise::kPhases;
    uint32_t octaves() const { return std::clamp(forces_.curlOctaves, 1u, 8u); }
    EmitterForces forces_;
};

/// Air that the gases of the effect move.
class UpdraftOp final : public TileOp
{
public:
    explicit UpdraftOp(float share) : share_(share) {}

    TilePhase phase() const override { return TilePhase::Force; }
    void run(const TileContext& context, const void*, Tile& tile) const override
    {
        for (const ThermalFlow& thermal : context.step.thermals)
            for (uint32_t i = 0; i < tile.count; ++i) {
                const glm::vec3 air =
                    thermal.velocityAbove(context.step.groundHeight, {tile.x[i], tile.y[i], tile.z[i]});
                tile.ux[i] += share_ * air.x;
                tile.uy[i] += share_ * air.y;
                tile.uz[i] += share_ * air.z;
            }
    }

private:
    float share_;
};

/// The ground plane and the host's geometry.
class GroundOp final : public TileOp, public GpuModuleSource
{
public:
    explicit GroundOp(const EmitterForces& forces)
        : restitution_(std::min(forces.bounce, 1.0f)), friction_(std::clamp(forces.friction, 0.0f, 1.0f))
    {}

    TilePhase phase() const override { return TilePhase::Contact; }
    bool collides() const override { return true; }
    bool describe(base::GpuModules& out) const override
    {
        out.add(base::GpuModule::Bounce, {restitution_, friction_});
        out.dependsOnHost = true;
        return true;
    }
    void run(const TileContext& context, const void*, Tile& tile) const override
    {
        const GroundContact ground{context.step.groundHeight, restitution_, friction_};
        if (context.listener)
            for (uint32_t i = 0; i < tile.count; ++i)
                if ((tile.flags[i] & (tile_flag::Empty | tile_flag::Stuck)) == 0)
                    report(context, ground, tile, i);
        if (!context.step.collider) {
            bounceTile(ground, tile);
            return;
        }
        for (uint32_t i = 0; i < tile.count; ++i) {
            if ((tile.flags[i] & (tile_flag::Empty | tile_flag::Stuck)) == 0)
                bounceRow(context, ground, tile, i);
        }
    }

private:
    /// Tells of the first contact of a row that has flown freely.
    void report(const TileContext& context, const GroundContact& ground, const Tile& tile, uint32_t i) const
    {
        const glm::vec3 from(tile.fromX[i], tile.fromY[i], tile.fromZ[i]);
        const glm::vec3 to(tile.x[i], tile.y[i], tile.z[i]);
        float share = 2.0f;
        glm::vec3 normal(0.0f, 1.0f, 0.0f);
        if (to.y < ground.height)
            share = from.y > to.y ? std::clamp((from.y - ground.height) / (from.y - to.y), 0.0f, 1.0f) : 0.0f;
        if (const Collider* const collider = context.step.collider) {
            const Collider::Hit hit = collider->sweep(from, to);
            if (hit.found && hit.share < share) {
                share = hit.share;
                normal = hit.normal;
            }
        }
        if (share > 1.0f)
            return;
        const glm::vec3 begin(tile.fromVX[i], tile.fromVY[i], tile.fromVZ[i]);
        const glm::vec3 velocity =
            begin + share * (glm::vec3(tile.vx[i], tile.vy[i], tile.vz[i]) - begin); // (2) of ground-bounce
        const float speed = std::max(-glm::dot(velocity, normal), 0.0f);
        const glm::vec3 along = velocity + speed * normal;
        context.listener->touch(context, tile, i,
                                {share, speed, from + share * (to - from),
                                 (1.0f - friction_) * along + restitution_ * speed * normal, false, 0,
                                 normal});
    }

    void bounceRow(const TileContext& context, const GroundContact& ground, Tile& tile, uint32_t i) const
    {
        const bool below = tile.y[i] < ground.height;
        const Collider* const collider = context.step.collider;
        if (!below && !collider)
            return;
        const glm::vec3 from(tile.fromX[i], tile.fromY[i], tile.fromZ[i]);
        MotionState after{{tile.x[i], tile.y[i], tile.z[i]}, {tile.vx[i], tile.vy[i], tile.vz[i]}};
        const float seconds = tile.seconds[i];
        if (below) {
            const glm::vec3 velocity(tile.fromVX[i], tile.fromVY[i], tile.fromVZ[i]);
            tile.contact[i] = std::clamp((from.y - ground.height) / (from.y - after.position.y), 0.0f, 1.0f);
            after = bounce({from, velocity}, after, seconds, ground);
        }
        const bool met = collider && collider->bounce(from, after.position, after.velocity,
                                                      {0.0f, ground.restitution, ground.friction}, seconds);
        if (!below && !met)
            return;
        tile.flags[i] |= tile_flag::Hit | tile_flag::Collided;
        tile.x[i] = after.position.x;
        tile.y[i] = after.position.y;
        tile.z[i] = after.position.z;
        tile.vx[i] = after.velocity.x;
        tile.vy[i] = after.velocity.y;
        tile.vz[i] = after.velocity.z;
    }

    float restitution_;
    float friction_;
};

} // namespace

void addBuiltinOps(const EmitterSettings& def, std::vector<std::shared_ptr<const TileOp>>& ops)
{
    ops.push_back(std::make_shared<AirOp>(def));
    if (def.forces.curlStrength > 0.0f)
        ops.push_back(std::make_shared<CurlOp>(def.forces));
    if (def.forces.updraft > 0.0f)
        ops.push_back(std::make_shared<UpdraftOp>(def.forces.updraft));
    if (def.forces.bounce >= 0.0f)
        ops.push_back(std::make_shared<GroundOp>(def.forces));
}

} // namespace fx::sim
