#include "benchmarks/bench/particles/bench_emitters.h"

#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/collisions/collision_op.h"
#include "simulation/particles/particle_program.h"

#include <array>
#include <limits>

namespace fx::cli {
namespace {

base::ColorCurve fireColors()
{
    const std::array<base::CurveKey<3>, 4> keys{{{0.0f, {1.0f, 0.9f, 0.6f}},
                                                 {0.25f, {1.0f, 0.45f, 0.1f}},
                                                 {0.5f, {0.5f, 0.12f, 0.05f}},
                                                 {1.0f, {0.1f, 0.1f, 0.1f}}}};
    return base::ColorCurve(std::span<const base::CurveKey<3>>(keys));
}

base::ScalarCurve fade()
{
    const std::array<base::CurveKey<1>, 4> keys{
        {{0.0f, {0.0f}}, {0.125f, {1.0f}}, {0.5f, {0.7f}}, {1.0f, {0.0f}}}};
    return base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
}

base::ScalarCurve growth()
{
    const std::array<base::CurveKey<1>, 3> keys{{{0.0f, {0.4f}}, {0.25f, {1.0f}}, {1.0f, {2.0f}}}};
    return base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
}

void makeLean(sim::EmitterDef& def)
{
    def.appearance.kind = sim::AppearanceKind::Sprite;
    def.appearance.colorOverLife = fireColors();
    def.opacityOverLife = fade();
    def.sizeOverLife = growth();
    def.lifetime = {2.0f, 2.0f};
    def.speed = {2.0f, 6.0f};
    def.radius = {0.05f, 0.05f};
    def.forces.drag = 0.75f;
}

void makeTypical(sim::EmitterDef& def)
{
    makeLean(def);
    def.shape = sim::EmitterShape::Cone;
    def.size = {0.5f, 0.0f, 0.0f};
    def.angle = 0.6f;
    def.lifetime = {1.0f, 3.0f};
    def.radius = {0.03f, 0.08f};
    def.forces.wind = {1.0f, 0.0f, 0.5f};
    def.appearance.angle = {0.0f, 6.28f};
    def.appearance.spin = {-3.0f, 3.0f};
    def.appearance.tileColumns = 4;
    def.appearance.tileRows = 4;
    def.appearance.frames = sim::FrameClock::OverLife;
}

void makeHeavy(sim::EmitterDef& def)
{
    makeTypical(def);
    def.forces.curlStrength = 2.0f;
    def.forces.curlScale = 0.7f;
    def.forces.curlRate = 0.3f;
    def.forces.bounce = 0.4f;
    def.forces.friction = 0.2f;
    def.appearance.fastest = 6.0f;
    def.appearance.sizeOverSpeed = growth();
}

} // namespace

std::shared_ptr<const sim::EffectDef> benchEffect(std::string_view variant, uint32_t count, bool gpu,
                                                  bool depth)
{
    auto def = std::make_unique<sim::EmitterDef>();
    if (variant == "heavy")
        makeHeavy(*def);
    else if (variant == "typical")
        makeTypical(*def);
    else
        makeLean(*def);
    const float meanLife = 0.5f * (def->lifetime.min + def->lifetime.max);
    def->emission.rate = float(count) / meanLife;
    def->emission.duration = std::numeric_limits<float>::infinity();
    def->maxParticles =
        uint32_t(double(count) * double(def->lifetime.max / meanLife) * (gpu ? 1.02 : 1.001)) + 4;
    if (gpu) // with room for the births of a step, so that none can be dropped
        def->compute = sim::ComputeOn::Gpu;
    if (depth) {
        sim::CollisionDef seen;
        seen.kind = sim::ObstacleKind::Depth;
        def->modules.push_back(sim::makeCollisionOp({&seen, 1}));
    }
    auto effect = std::make_shared<sim::EffectDef>();
    effect->solvers.push_back(std::move(def));
    return effect;
}

double bytesPerParticle(const sim::EffectDef& effect)
{
    const auto& def = static_cast<const sim::EmitterDef&>(*effect.solvers.front());
    const sim::ParticleProgram program(def);
    const double rows = double(def.maxParticles) * double(def.lifetime.min + def.lifetime.max) * 0.5 /
                        (double(def.maxParticles) * double(def.lifetime.max));
    return double(sim::bytesMoved(program)) / rows; // empty rows are moved too
}

} // namespace fx::cli
