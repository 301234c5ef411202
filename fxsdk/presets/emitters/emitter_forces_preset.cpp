#include "fxsdk/presets/emitters/emitter_parts_preset.h"
#include "simulation/particles/collisions/collision_op.h"
#include "simulation/particles/forces/force_ops.h"

#include <algorithm>
#include <array>

namespace fx::preset {

namespace {

using Modules = std::vector<std::shared_ptr<const sim::TileOp>>;
template <class E, size_t N>
using Names = std::array<std::pair<std::string_view, E>, N>;

constexpr Names<sim::Falloff, 4> kFalloffs{{{"spring", sim::Falloff::Spring},
                                            {"constant", sim::Falloff::Constant},
                                            {"inverse", sim::Falloff::Inverse},
                                            {"inverse-square", sim::Falloff::InverseSquare}}};
constexpr Names<sim::SurfaceKind, 3> kSurfaces{
    {{"sphere", sim::SurfaceKind::Sphere}, {"box", sim::SurfaceKind::Box}, {"mesh", sim::SurfaceKind::Mesh}}};
constexpr Names<sim::ObstacleKind, 9> kObstacles{{{"plane", sim::ObstacleKind::Plane},
                                                  {"sphere", sim::ObstacleKind::Sphere},
                                                  {"box", sim::ObstacleKind::Box},
                                                  {"mesh", sim::ObstacleKind::Mesh},
                                                  {"heights", sim::ObstacleKind::HeightField},
                                                  {"ground", sim::ObstacleKind::Ground},
                                                  {"scene", sim::ObstacleKind::Scene},
                                                  {"hook", sim::ObstacleKind::Hook},
                                                  {"depth", sim::ObstacleKind::Depth}}};
constexpr Names<sim::ContactResponse, 3> kResponses{{{"bounce", sim::ContactResponse::Bounce},
                                                     {"kill", sim::ContactResponse::Kill},
                                                     {"stick", sim::ContactResponse::Stick}}};
constexpr Names<bool, 2> kActs{{{"air", false}, {"acceleration", true}}};

template <class E, size_t N>
void readName(const PresetValue& value, const char* member, const Names<E, N>& names, E& out)
{
    value.read(member, std::span<const std::pair<std::string_view, E>>(names), out);
}

void readAxis(const PresetValue& value, glm::vec3& out)
{
    value.read("axis", out);
    if (out == glm::vec3(0.0f))
        value.error("axis", "found an axis without length; any other direction is allowed");
}

void readAir(const PresetValue& forces, Modules& out)
{
    sim::GustDef gust;
    forces.read("gust", gust.strength);
    forces.read("gustPeriod", gust.period);
    if (gust.strength != glm::vec3(0.0f))
        out.push_back(sim::makeGustOp(gust));
    float quadratic = 0.0f;
    forces.read("quadraticDrag", quadratic);
    if (quadratic > 0.0f)
        out.push_back(sim::makeQuadraticDragOp(quadratic));
}

void readVortices(const PresetValue& forces, Modules& out)
{
    for (size_t i = 0; i < forces.size("vortices"); ++i) {
        const PresetValue value = forces.element("vortices", i);
        sim::VortexDef def;
        value.read("position", def.position);
        readAxis(value, def.axis);
        value.read("radius", def.radius);
        value.read("speed", def.speed);
        value.read("lift", def.lift);
        value.read("pull", def.pull);
        value.read("hold", def.hold);
        out.push_back(sim::makeVortexOp(def));
    }
}

/// @param outObstacles receives the spheres at which attractors kill
void readAttractors(const PresetValue& forces, Modules& out, std::vector<sim::CollisionDef>& outObstacles)
{
    for (size_t i = 0; i < forces.size("attractors"); ++i) {
        const PresetValue value = forces.element("attractors", i);
        sim::AttractorDef def;
        def.softening = 0.1f;
        value.read("position", def.position);
        value.read("strength", def.strength);
        value.read("radius", def.radius);
        readName(value, "falloff", kFalloffs, def.falloff);
        value.read("softening", def.softening);
        value.read("reach", def.reach);
        value.read("killRadius", def.killRadius);
        out.push_back(sim::makeAttractorOp(def));
        if (def.killRadius <= 0.0f)
            continue;
        sim::CollisionDef sphere;
        sphere.kind = sim::ObstacleKind::Sphere;
        sphere.position = def.position;
        sphere.size = glm::vec3(def.killRadius);
        sphere.response = sim::ContactResponse::Kill;
        outObstacles.push_back(sphere);
    }
}

void readFields(const PresetValue& forces, Modules& out)
{
    for (size_t i = 0; i < forces.size("vectorFields"); ++i) {
        const PresetValue value = forces.element("vectorFields", i);
        sim::VectorFieldDef def;
        def.grid = readGrid(value, "file", 3);
        value.read("position", def.position);
        value.read("scale", def.scale);
        value.read("strength", def.strength);
        readName(value, "acts", kActs, def.isAcceleration);
        if (def.grid)
            out.push_back(sim::makeVectorFieldOp(def));
    }
}

void readSurfaces(const PresetValue& forces, Modules& out)
{
    for (size_t i = 0; i < forces.size("conform"); ++i) {
        const PresetValue value = forces.element("conform", i);
        sim::ConformDef def;
        readName(value, "shape", kSurfaces, def.kind);
        value.read("position", def.position);
        value.read("size", def.size);
        value.read("distance", def.distance);
        value.read("stiffness", def.stiffness);
        value.read("damping", def.damping);
        value.read("reach", def.reach);
        if (def.kind == sim::SurfaceKind::Mesh)
            def.field = readMeshField(value);
        if (def.kind != sim::SurfaceKind::Mesh || def.field)
            out.push_back(sim::makeConformOp(def));
    }
}

/// What an obstacle is made of. @return false after a finding
bool readObstacleSource(const PresetValue& value, sim::CollisionDef& def)
{
    if (def.kind == sim::ObstacleKind::Mesh)
        def.field = readMeshField(value);
    if (def.kind != sim::ObstacleKind::HeightField)
        return def.kind != sim::ObstacleKind::Mesh || def.field;
    def.heights = readGrid(value, "file", 1);
    const bool isSheet =
        def.heights && def.heights->nodes.y == 1 && def.heights->nodes.x >= 2 && def.heights->nodes.z >= 2;
    if (def.heights && !isSheet)
        value.error(
            "file",
            "found a grid that is no sheet; heights have one node along y and two or more along x and z");
    return isSheet;
}

void readObstacles(const PresetValue& element, std::vector<sim::CollisionDef>& out)
{
    for (size_t i = 0; i < element.size("collisions"); ++i) {
        const PresetValue value = element.element("collisions", i);
        sim::CollisionDef def;
        readName(value, "shape", kObstacles, def.kind);
        value.read("position", def.position);
        readAxis(value, def.axis);
        value.read("size", def.size);
        value.read("hollow", def.isHollow);
        value.read("margin", def.margin);
        value.read("thickness", def.thickness);
        readName(value, "response", kResponses, def.response);
        value.read("bounce", def.restitution);
        value.read("friction", def.friction);
        if (readObstacleSource(value, def))
            out.push_back(def);
    }
}

/// Where there are other obstacles, what forces/bounce means joins them: the first that is met counts.
void joinBounce(sim::EmitterForces& forces, std::vector<sim::CollisionDef>& io)
{
    if (io.empty() || forces.bounce < 0.0f)
        return;
    for (const sim::ObstacleKind kind : {sim::ObstacleKind::Ground, sim::ObstacleKind::Scene}) {
        sim::CollisionDef def;
        def.kind = kind;
        def.restitution = forces.bounce;
        def.friction = forces.friction;
        io.push_back(def);
    }
    forces.bounce = -1.0f;
}

} // namespace

void readEmitterForces(const PresetValue& element, sim::EmitterDef& emitter)
{
    const PresetValue forces = element.child("forces");
    sim::EmitterForces& out = emitter.forces;
    forces.read("gravity", out.gravity);
    forces.read("drag", out.drag);
    forces.read("buoyancy", out.buoyancy);
    forces.read("wind", out.wind);
    forces.read("curlStrength", out.curlStrength);
    forces.read("curlScale", out.curlScale);
    forces.read("curlRate", out.curlRate);
    forces.read("curlOctaves", out.curlOctaves);
    forces.read("updraft", out.updraft);
    forces.read("bounce", out.bounce);
    forces.read("friction", out.friction);
    readAir(forces, emitter.modules);
    readVortices(forces, emitter.modules);
    std::vector<sim::CollisionDef> obstacles;
    readAttractors(forces, emitter.modules, obstacles);
    readFields(forces, emitter.modules);
    readSurfaces(forces, emitter.modules);
    readObstacles(element, obstacles);
    emitter.meetsDepth = std::any_of(obstacles.begin(), obstacles.end(), [](const sim::CollisionDef& def) {
        return def.kind == sim::ObstacleKind::Depth;
    });
    joinBounce(out, obstacles);
    if (!obstacles.empty())
        emitter.modules.push_back(sim::makeCollisionOp(obstacles));
}

} // namespace fx::preset
