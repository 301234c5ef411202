#include "simulation/particles/shapes/shape_sample.h"

#include "foundation/math/elementary.h"
#include "simulation/particles/fields/spline_path.h"
#include "simulation/particles/fields/turn.h"
#include "simulation/particles/shapes/mesh_sampler.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

using Uniform = std::array<float, 4>;

constexpr float kPi = 3.14159265f;
constexpr float kSteepest = 1.55f; ///< [rad] half angle of a cone with a height
constexpr glm::vec3 kUp{0.0f, 1.0f, 0.0f};

/// The point of the unit circle around +Y at `turns`.
glm::vec3 onCircle(float turns)
{
    const base::SinCos azimuth = base::sinCosTurns(double(turns));
    return {float(azimuth.cos), 0.0f, float(azimuth.sin)};
}

/// A direction within the angle of +Y whose cosine is `cosLimit`.
glm::vec3 coneDirection(float u1, float u2, float cosLimit)
{
    const float cosine = 1.0f - u1 * (1.0f - cosLimit); // (1)
    const float sine = std::sqrt(std::max((1.0f - cosine) * (1.0f + cosine), 0.0f));
    const base::SinCos azimuth = base::sinCosTurns(double(u2));
    return {sine * float(azimuth.cos), cosine, sine * float(azimuth.sin)};
}

/// Share of the radius that stays empty.
float innerShare(const ShapeDef& def)
{
    return def.onSurface ? 1.0f : std::clamp(def.inner, 0.0f, 1.0f);
}

/// Radius in the unit disc with an empty middle.
float discRadius(float u, float k)
{
    return std::sqrt(k * k + u * (1.0f - k * k)); // (2)
}

ShapePlace sampleSphere(const ShapeDef& def, const Uniform& u)
{
    const glm::vec3 outward = coneDirection(u[0], u[1], -1.0f);
    const double k = double(innerShare(def));
    const double radius = base::cubeRoot(k * k * k + double(u[2]) * (1.0 - k * k * k)); // (2)
    return {def.size.x * float(radius) * outward, outward};
}

ShapePlace sampleBox(const ShapeDef& def, const Uniform& u)
{
    const glm::vec3 unit(2.0f * u[0] - 1.0f, 2.0f * u[1] - 1.0f, 2.0f * u[2] - 1.0f);
    if (!def.onSurface)
        return {def.size * unit, kUp};
    const glm::vec3 area(def.size.y * def.size.z, def.size.z * def.size.x, def.size.x * def.size.y);
    const float sum = area.x + area.y + area.z;
    const float pick = 2.0f * u[3] * sum; // (6) two faces an axis
    const float side = pick < sum ? 1.0f : -1.0f;
    const float rest = pick < sum ? pick : pick - sum;
    const int axis = rest < area.x ? 0 : (rest < area.x + area.y ? 1 : 2);
    glm::vec3 place = def.size * unit, normal(0.0f);
    place[axis] = side * def.size[axis];
    normal[axis] = side;
    return {place, normal};
}

ShapePlace sampleDisc(const ShapeDef& def, const Uniform& u)
{
    return {def.size.x * discRadius(u[1], innerShare(def)) * onCircle(u[0]), kUp};
}

/// In the cone above the disc, or on its side.
ShapePlace sampleTallCone(const ShapeDef& def, const Uniform& u)
{
    const double tangent = slopeOf(def);
    const double low = double(def.size.x), high = low + double(def.height) * tangent;
    double z = double(u[1]) * double(def.height), wide = low;
    if (tangent > 1e-6) { // (3)
        wide = def.onSurface
                   ? std::sqrt(low * low + double(u[1]) * (high * high - low * low))
                   : base::cubeRoot(low * low * low + double(u[1]) * (high * high * high - low * low * low));
        z = (wide - low) / tangent;
    }
    const float radius = float(wide) * discRadius(u[2], innerShare(def));
    const glm::vec3 place = radius * onCircle(u[0]) + glm::vec3(0.0f, float(z), 0.0f);
    const float tip = tangent > 1e-6 ? float(low / tangent) : 0.0f; // below the disc
    const glm::vec3 away = tangent > 1e-6 ? place + glm::vec3(0.0f, tip, 0.0f) : kUp;
    const float distance = glm::length(away);
    return {place, distance > 0.0f ? away / distance : kUp};
}

ShapePlace sampleCone(const ShapeDef& def, const Uniform& u, const Uniform& heading)
{
    if (def.height > 0.0f)
        return sampleTallCone(def, u);
    const float angle = std::clamp(def.angle, 0.0f, kPi);
    const float cosLimit = float(base::sinCosTurns(double(angle) / 6.283185307179586).cos);
    return {sampleDisc(def, u).position, coneDirection(heading[0], heading[1], cosLimit)};
}

ShapePlace sampleTorus(const ShapeDef& def, const Uniform& u)
{
    const float circle = def.size.x, tube = std::clamp(def.tube, 0.0f, circle);
    const float r = tube * discRadius(u[2], innerShare(def)); // (5)
    const base::SinCos around = base::sinCosTurns(double(u[1]));
    const float lean = circle > 0.0f ? r / circle : 0.0f;
    float cosine = float(around.cos);
    if (u[3] < 0.5f * (1.0f - lean * cosine)) // (4)
        cosine = 0.0f - cosine;
    const glm::vec3 out = onCircle(u[0]);
    const glm::vec3 direction = cosine * out + float(around.sin) * kUp;
    return {circle * out + r * direction, direction};
}

/// 48 random bits.
double fine(float high, float low)
{
    return double(high) + 0x1p-24 * double(low);
}

ShapePlace sampleMesh(const MeshSampler& mesh, const Uniform& u, const Uniform& heading)
{
    const MeshSampler::Triangle& t = mesh.triangles[mesh.table.draw(fine(u[0], heading[2]), u[1])];
    const float r = std::sqrt(u[2]);
    return {t.corner + r * (1.0f - u[3]) * t.side[0] + r * u[3] * t.side[1], t.normal}; // (1)
}

ShapePlace sampleVolume(const VolumeSampler& volume, const Uniform& u, const Uniform& heading)
{
    const uint32_t node = volume.table.draw(fine(u[0], heading[2]), u[1]);
    const glm::vec3 within(u[2] - 0.5f, u[3] - 0.5f, heading[3] - 0.5f);
    return {volume.low + volume.cell * (volume.nodes[node] + within), kUp}; // (2)
}

/// Around the origin, along +Y.
ShapePlace sampleUpright(const ShapeDef& def, const Uniform& u, const Uniform& heading)
{
    switch (def.kind) {
    case ShapeKind::Sphere:
        return sampleSphere(def, u);
    case ShapeKind::Box:
        return sampleBox(def, u);
    case ShapeKind::Cone:
        return sampleCone(def, u, heading);
    case ShapeKind::Line:
        return {def.size.x * (2.0f * u[0] - 1.0f) * kUp, onCircle(heading[0])};
    case ShapeKind::Disc:
        return sampleDisc(def, u);
    case ShapeKind::Torus:
        return sampleTorus(def, u);
    case ShapeKind::Mesh:
        return sampleMesh(*def.mesh, u, heading);
    case ShapeKind::Spline: {
        const SplinePath::Place place = def.spline->at(u[0]);
        return {place.position, place.tangent};
    }
    case ShapeKind::Volume:
        return sampleVolume(*def.volume, u, heading);
    case ShapeKind::Point:
        break;
    }
    return {glm::vec3(0.0f), coneDirection(heading[0], heading[1], -1.0f)};
}

float extentOf(const MeshSampler& mesh)
{
    float most = 0;
    for (const MeshSampler::Triangle& t : mesh.triangles)
        for (const glm::vec3& corner : {t.corner, t.corner + t.side[0], t.corner + t.side[1]})
            most = std::max(most, glm::length(corner));
    return most;
}

float extentOf(const VolumeSampler& volume)
{
    float most = 0;
    for (const glm::vec3& node : volume.nodes)
        most = std::max(most, glm::length(glm::abs(volume.low + volume.cell * node) + 0.5f * volume.cell));
    return most;
}

/// [m] from the center of an upright shape to its farthest place.
float extentOf(const ShapeDef& def)
{
    switch (def.kind) {
    case ShapeKind::Mesh:
        return extentOf(*def.mesh);
    case ShapeKind::Volume:
        return extentOf(*def.volume);
    case ShapeKind::Spline: // nothing of it is farther from its begin than its length
        return glm::length(def.spline->at(0.0f).position) + float(def.spline->length());
    default: {
        const float slope = float(slopeOf(def));
        return glm::length(def.size) + std::max(def.tube, 0.0f) +
               std::max(def.height, 0.0f) * std::sqrt(1.0f + slope * slope);
    }
    }
}

/// A shape in the form that tile.h requires.
class ShapeSampler final : public ShapeOp
{
public:
    explicit ShapeSampler(const ShapeDef& def) : def_(def) {}

    void sample(const Births& births) const override
    {
        for (uint32_t i = 0; i < births.count; ++i) {
            const auto four = [i](const float* const* from) {
                return Uniform{from[0][i], from[1][i], from[2][i], from[3][i]};
            };
            const ShapePlace place = sampleShape(def_, four(births.place), four(births.heading));
            for (int k = 0; k < 3; ++k) {
                births.position[k][i] = place.position[k];
                births.direction[k][i] = place.direction[k];
            }
        }
    }

    float extent() const override { return 1.00001f * (glm::length(def_.position) + extentOf(def_)); }
    const ShapeDef& def() const { return def_; }

private:
    ShapeDef def_;
};

} // namespace

double slopeOf(const ShapeDef& def)
{
    const base::SinCos half =
        base::sinCosTurns(double(std::clamp(def.angle, 0.0f, kSteepest)) / 6.283185307179586);
    return half.sin / half.cos;
}

ShapePlace sampleShape(const ShapeDef& def, const Uniform& place, const Uniform& heading)
{
    const ShapePlace upright = sampleUpright(def, place, heading);
    const glm::vec3 axis = unitOrUp(def.axis);
    return {def.position + turnFromY(axis, upright.position), turnFromY(axis, upright.direction)};
}

std::unique_ptr<ShapeOp> makeShapeOp(const ShapeDef& def)
{
    return std::make_unique<ShapeSampler>(def);
}

const ShapeDef* shapeOf(const ShapeOp& shape)
{
    const auto* sampler = dynamic_cast<const ShapeSampler*>(&shape);
    return sampler ? &sampler->def() : nullptr;
}

} // namespace fx::sim
