#include "simulation/gpu_programs/gpu_program.h"

#include "foundation/math/elementary.h"
#include "simulation/particles/fields/turn.h"
#include "simulation/particles/shapes/shape_sample.h"

#include <algorithm>
#include <limits>

namespace fx::sim {

namespace {

constexpr float kPi = 3.14159265f;

/// {min, max} as particles are drawn from it: the same number twice where nothing is drawn.
void setRange(float (&out)[2], const base::Range& range)
{
    out[0] = range.min;
    out[1] = range.max > range.min ? range.max : range.min;
}

/// What the members of an emitter say of its shape, as a ShapeDef.
ShapeDef plainShapeOf(const EmitterSettings& def)
{
    ShapeDef shape;
    shape.kind = ShapeKind(uint8_t(def.shape));
    shape.position = def.position;
    shape.size = def.size;
    shape.angle = def.angle;
    return shape;
}

base::GpuShape kindOf(const ShapeDef& shape)
{
    switch (shape.kind) {
    case ShapeKind::Sphere:
        return base::GpuShape::Ball;
    case ShapeKind::Box:
        return shape.onSurface ? base::GpuShape::BoxFaces : base::GpuShape::Box;
    case ShapeKind::Cone:
        return shape.height > 0.0f ? base::GpuShape::TallCone : base::GpuShape::Cone;
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
    n.height = shape.height;
    const double slope = slopeOf(shape);
    n.slope[0] = float(slope);
    n.slope[1] = float(slope - double(n.slope[0]));
    n.slope[2] = float(slope - double(n.slope[0]) - double(n.slope[1]));
    n.tube = shape.kind == ShapeKind::Cone ? float(shape.onSurface)
                                           : std::clamp(shape.tube, 0.0f, std::max(shape.size.x, 0.0f));
}

/// As CurveLanes evaluates them.
void setCurves(float (&out)[5][base::kGpuCurveSamples], const RampCurves& curves)
{
    constexpr size_t kPieces = base::kGpuCurvePieces;
    static_assert(kMaxRamps < kPieces && 3 * kPieces < base::kGpuCurveSamples);
    for (uint32_t c = 0; c < appearance_channel::Count; ++c) {
        if (curves.isConstant(c)) {
            std::ranges::fill(out[c], curves.byTable ? curves.start[c] : 0.0f);
            std::fill_n(out[c], kPieces, curves.start[c]);
        } else if (curves.byTable) {
            std::ranges::copy(curves.table[c], out[c]);
            continue;
        } else {
            std::copy_n(curves.pieceStart[c].begin(), kPieces, out[c]);
            std::copy_n(curves.pieceSlope[c].begin(), kPieces, out[c] + kPieces);
        }
        for (size_t k = 0; k < kPieces && !curves.byTable; ++k)
            out[c][2 * kPieces + k] =
                k <= curves.ramps ? curves.from[k] : std::numeric_limits<float>::infinity();
    }
}

} // namespace

base::GpuShape gpuShapeOf(const EmitterSettings& def)
{
    return kindOf(def.births ? *shapeOf(*def.births) : plainShapeOf(def));
}

base::GpuParticleNumbers gpuNumbersOf(const EmitterSettings& def, const ParticleProgram& program)
{
    const EmitterAppearance& appearance = def.appearance;
    base::GpuParticleNumbers n{};
    setShape(def.births ? *shapeOf(*def.births) : plainShapeOf(def), n);
    // Speeds are not drawn like the others: a range that falls is a range too.
    n.speed[0] = def.speed.min;
    n.speed[1] =
        def.speed.max > def.speed.min || program.stores[stored::PerLife] ? def.speed.max : def.speed.min;
    setRange(n.lifetime, def.lifetime);
    n.perLife = program.constant[stored::PerLife];
    setRange(n.radius, def.radius);
    setRange(n.opacity, appearance.opacity);
    setRange(n.brightness, appearance.brightness);
    setRange(n.angle, appearance.angle);
    setRange(n.spin, appearance.spin);
    setRange(n.frame, appearance.firstFrame);
    n.drag = def.forces.drag > 0.0f ? std::min(def.forces.drag, 1e6f) : 0.0f;
    n.perDrag = n.drag > 0.0f ? 1.0f / n.drag : 0.0f;
    n.frames = float(appearance.tileColumns * appearance.tileRows);
    n.framesPerSecond = appearance.framesPerSecond;
    n.perFastest = appearance.fastest > 0.0f ? 1.0f / appearance.fastest : 0.0f;
    setCurves(n.lifeCurves, program.byLife);
    if (program.bySpeed)
        setCurves(n.speedCurves, *program.bySpeed);
    return n;
}

} // namespace fx::sim
