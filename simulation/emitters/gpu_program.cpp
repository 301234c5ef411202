#include "simulation/emitters/gpu_program.h"

#include "foundation/math/elementary.h"
#include "simulation/emitters/gpu_replay.h"
#include "simulation/particles/fields/turn.h"
#include "simulation/particles/particle_program.h"
#include "simulation/particles/shapes/shape_sample.h"

#include <algorithm>
#include <iterator>

#ifndef FXSDK_GPU_PARTICLES
#define FXSDK_GPU_PARTICLES 0
#endif

namespace fx::sim {

namespace {

constexpr uint32_t kMostRows = 65535u * 256u; // of the work groups that every OpenGL 4.5 can be asked for
constexpr float kPi = 3.14159265f;

bool changesRate(const Emission& emission)
{
    const auto& curve = emission.rateOverTime;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        if (curve.at(float(i) / float(base::kCurveSamples))[0] != curve.at(0.0f)[0])
            return emission.rate > 0.0f;
    return false;
}

bool isKnown(const ShapeOp& births)
{
    const ShapeDef* const shape = shapeOf(births);
    return shape && shape->kind < ShapeKind::Mesh &&
           (shape->kind != ShapeKind::Cone || !(shape->height > 0.0f));
}

/// What the emitter does besides being drawn, or does in a way that no shader knows.
std::string_view obstacleOfModules(const EmitterDef& def)
{
    if (def.births && !isKnown(*def.births))
        return "its shape is a mesh, a spline, a volume or a cone with a height";
    if (!def.modules.empty())
        return "forces or collisions beyond gravity, drag and a constant wind act on it";
    if (def.forces.curlStrength > 0.0f)
        return "turbulence acts on it";
    if (def.forces.buoyancy != 0.0f)
        return "buoyancy acts on it";
    if (def.forces.bounce >= 0.0f)
        return "it meets the ground";
    return changesRate(def.emission) ? "its rate of births changes" : "";
}

/// {min, max} as particles are drawn from it: the same number twice where nothing is drawn.
void setRange(float (&out)[2], const base::Range& range)
{
    out[0] = range.min;
    out[1] = range.max > range.min ? range.max : range.min;
}

/// What the members of an emitter say of its shape, as a ShapeDef.
ShapeDef plainShapeOf(const EmitterDef& def)
{
    ShapeDef shape;
    shape.kind = ShapeKind(uint8_t(def.shape));
    shape.position = def.position;
    shape.size = def.size;
    shape.angle = def.angle;
    return shape;
}

base::GpuShape gpuShapeOf(const ShapeDef& shape)
{
    switch (shape.kind) {
    case ShapeKind::Sphere:
        return base::GpuShape::Ball;
    case ShapeKind::Box:
        return shape.onSurface ? base::GpuShape::BoxFaces : base::GpuShape::Box;
    case ShapeKind::Cone:
        return base::GpuShape::Cone;
    case ShapeKind::Line:
        return base::GpuShape::Line;
    case ShapeKind::Disc:
        return base::GpuShape::Disc;
    case ShapeKind::Torus:
        return base::GpuShape::Torus;
    default:
        return base::GpuShape::Point;
    }
}

void setShape(const ShapeDef& shape, base::GpuParticleNumbers& n)
{
    const glm::vec3 axis = unitOrUp(shape.axis);
    for (int a = 0; a < 3; ++a) {
        n.position[a] = shape.position[a];
        n.size[a] = shape.size[a];
        n.axis[a] = axis[a];
    }
    const float angle = std::clamp(shape.angle, 0.0f, kPi);
    n.cosLimit = shape.kind == ShapeKind::Cone
                     ? float(base::sinCosTurns(double(angle) / 6.283185307179586).cos)
                     : -1.0f;
    n.inner = shape.onSurface ? 1.0f : std::clamp(shape.inner, 0.0f, 1.0f);
    n.tube = std::clamp(shape.tube, 0.0f, std::max(shape.size.x, 0.0f));
}

void setCurves(float (&out)[5][base::kGpuCurveSamples], const base::ColorCurve& color,
               const base::ScalarCurve& opacity, const base::ScalarCurve& size)
{
    for (size_t c = 0; c < 3; ++c)
        std::ranges::copy(samplesOf(color, c), out[c]);
    std::ranges::copy(samplesOf(opacity, 0), out[3]);
    std::ranges::copy(samplesOf(size, 0), out[4]);
}

base::GpuParticleNumbers numbersOf(const EmitterDef& def, const ParticleProgram& program)
{
    const EmitterLook& look = def.look;
    base::GpuParticleNumbers n{};
    setShape(def.births ? *shapeOf(*def.births) : plainShapeOf(def), n);
    // Speeds are not drawn like the others: a range that falls is a range too.
    n.speed[0] = def.speed.min;
    n.speed[1] =
        def.speed.max > def.speed.min || program.stores[stored::PerLife] ? def.speed.max : def.speed.min;
    setRange(n.lifetime, def.lifetime);
    n.perLife = program.constant[stored::PerLife];
    setRange(n.radius, def.radius);
    setRange(n.opacity, look.opacity);
    setRange(n.brightness, look.brightness);
    setRange(n.angle, look.angle);
    setRange(n.spin, look.spin);
    setRange(n.frame, look.firstFrame);
    n.drag = def.forces.drag > 0.0f ? std::min(def.forces.drag, 1e6f) : 0.0f;
    n.perDrag = n.drag > 0.0f ? 1.0f / n.drag : 0.0f;
    n.frames = float(look.tileColumns * look.tileRows);
    n.framesPerSecond = look.framesPerSecond;
    n.perFastest = look.fastest > 0.0f ? 1.0f / look.fastest : 0.0f;
    setCurves(n.lifeCurves, look.colorOverLife, def.opacityOverLife, def.sizeOverLife);
    setCurves(n.speedCurves, look.colorOverSpeed, look.opacityOverSpeed, look.sizeOverSpeed);
    return n;
}

/// The emitter itself goes along, so that its rows can be made anywhere and at any time.
class EmitterGpuProgram final : public base::GpuParticleProgram
{
public:
    explicit EmitterGpuProgram(const EmitterDef& def)
        : def_(def), program_((def_.compute = ComputeOn::Cpu, def_))
    {
        numbers = numbersOf(def_, program_);
        const ShapeDef shape = def_.births ? *shapeOf(*def_.births) : plainShapeOf(def_);
        features.shape = gpuShapeOf(shape);
        features.turned = numbers.axis[1] != 1.0f;
        features.frames = def_.look.frames == FrameClock::OverLife    ? base::GpuFrames::OverLife
                          : def_.look.frames == FrameClock::PerSecond ? base::GpuFrames::PerSecond
                                                                      : base::GpuFrames::First;
        features.brief = program_.brief;
        features.lifeVaries = program_.stores[stored::PerLife];
        features.drags = numbers.drag > 0.0f;
        features.bySpeed = program_.bySpeed != nullptr;
        features.columns = program_.published;
        rows = std::max(def_.maxParticles, 1u);
        float size = 0.0f;
        for (const float sample : numbers.lifeCurves[4])
            size += sample / float(base::kGpuCurveSamples);
        meanRadius = 0.5f * (numbers.radius[0] + numbers.radius[1]) * size;
    }

    void replay(const base::SnapshotGroup& group, base::FrameSnapshot& out) const override
    {
        replayGroup(program_, group, out);
    }

private:
    EmitterDef def_;
    ParticleProgram program_;
};

} // namespace

std::string_view gpuObstacle(const EmitterDef& def)
{
    if (!FXSDK_GPU_PARTICLES)
        return "the library was built without FXSDK_GPU_PARTICLES";
    if (def.compute == ComputeOn::Cpu)
        return "its preset does not ask for the GPU";
    if (def.compute == ComputeOn::Auto && def.maxParticles < kManyParticles)
        return "it has too few particles to be worth it";
    if (def.look.kind == Appearance::Medium)
        return "media are lit on the CPU";
    if (def.look.kind == Appearance::None)
        return "it is not drawn";
    if (def.fed || !def.events.empty())
        return "it takes part in events";
    if (def.trail.lifetime > 0.0f)
        return "its particles leave trails";
    if (def.inWorld)
        return "its particles stay behind in the world";
    if (def.light.given)
        return "its particles are lights for the host";
    if (def.maxParticles > kMostRows)
        return "it has more particles than one dispatch reaches";
    return obstacleOfModules(def);
}

std::shared_ptr<const base::GpuParticleProgram> makeGpuProgram(const EmitterDef& def)
{
    return std::make_shared<const EmitterGpuProgram>(def);
}

} // namespace fx::sim
