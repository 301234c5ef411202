/// @file emitter_settings.h
/// Definition of one emitter as plain data: births, motion and appearance of its particles. All lengths in
/// the instance's local space.
#pragma once

#include "foundation/math/curve.h"
#include "foundation/snapshot/blob_kind.h"
#include "simulation/motion/ambient_air.h"
#include "simulation/particles/emitter_appearance.h"
#include "simulation/particles/event_rule.h"
#include "simulation/particles/ribbon_def.h"
#include "simulation/particles/tile.h"

#include <glm/vec3.hpp>

#include <memory>
#include <string>
#include <vector>

namespace fx::sim {

/// Where particles are born.
enum class EmitterShape : uint8_t
{
    Point,
    Sphere, ///< uniformly in the ball of radius size.x
    Box,    ///< uniformly in the box of half extents size
    Cone,   ///< on the disc of radius size.x, moving within `angle` of the axis +Y
};

/// A burst: a number of births at one moment, or at several moments at equal intervals.
struct Burst
{
    float time = 0; ///< [s] after the start, >= 0
    uint32_t count = 0;
    uint32_t cycles = 1;   ///< how often it happens, 0: for ever
    float interval = 0;    ///< [s] between two cycles, > 0 for several cycles
    float probability = 1; ///< [1] 0..1 that a cycle happens at all, drawn for each
};

/// A birth rate over an interval of local time.
struct Emission
{
    float rate = 0;            ///< [1/s] >= 0
    float start = 0;           ///< [s]
    float duration = 0;        ///< [s], +infinity for ever
    std::vector<Burst> bursts; ///< in declaration order

    /// Multiplies the rate, t in [0, 1] from the start to the end of a finite duration. The rate runs
    /// straight between the curve's samples.
    base::ScalarCurve rateOverTime{std::array{1.0f}};
};

/// Forces on each particle; the sum of accelerations, with drag and buoyancy relative to the moving air.
struct EmitterForces
{
    float gravity = 1.0f;      ///< [1] multiple of the world's gravity
    float drag = 0.0f;         ///< [1/s] rate at which velocity approaches the wind's, exact exponential
    float buoyancy = 0.0f;     ///< [1] multiple of (T / T_air - 1) * g upwards
    glm::vec3 wind{0.0f};      ///< [m/s]
    float curlStrength = 0.0f; ///< [m/s] speed scale of the divergence-free noise that is added to the wind
    float curlScale = 1.0f;    ///< [m] length of one noise period
    float curlRate = 0.0f;     ///< [1/s] noise periods per second
    float bounce = -1.0f;      ///< [1] restitution at the ground and at the host's geometry, 0..1; negative:
                               ///< particles pass
    float friction = 0.0f;     ///< [1] tangential velocity lost at a bounce, 0..1
    float updraft = 0.0f;      ///< [1] share of the air's velocity around the gases of the effect, 0..4
    uint32_t curlOctaves = 1;  ///< each next one has half the strength and scale and twice the rate, 1..8
};

/// Processor of the particles of a drawn emitter.
enum class ComputeOn : uint8_t
{
    Cpu,
    Gpu,  ///< the GPU wherever it can, see gpuObstacle()
    Auto, ///< the same for capacities of at least kManyParticles
};
constexpr uint32_t kManyParticles = 10'000;

struct EmitterSettings
{
    std::string name;
    base::MediaLayer layer = base::MediaLayer::Smoke;
    uint32_t maxParticles = 1024;
    ComputeOn compute = ComputeOn::Cpu;

    EmitterShape shape = EmitterShape::Point;
    glm::vec3 position{0.0f}; ///< [m] center of the shape
    glm::vec3 size{0.0f};     ///< [m] see EmitterShape
    float angle = 0.0f;       ///< [rad] half angle of the cone, 0..pi
    Emission emission;
    /// True: particles keep their world position when the host moves the instance; false: they move with it.
    bool inWorld = false;
    float inheritVelocity = 0.0f; ///< [1] 0..1 of the velocity with which the host moves it; with inWorld

    base::Range lifetime{1, 1};            ///< [s] > 0
    std::shared_ptr<const ShapeOp> births; ///< where and whereto particles are born, instead of `shape`
    base::Range speed{0, 0}; ///< [m/s] along the shape's direction: radially for sphere and point, +Y for box
    base::Range radius{0.5f, 0.5f}; ///< [m] > 0
    base::Range crossSection{
        1, 1}; ///< [m2] >= 0, or of optical depth through the center when opticalDepth is set
    bool opticalDepthGiven = true; ///< `crossSection` holds the optical depth along a diameter at birth size
    base::Range temperature{293, 293}; ///< [K]
    EmitterForces forces;
    /// Run after the forces above, in order within their phase. None: with gravity, drag and wind alone
    /// motion has a closed form.
    std::vector<std::shared_ptr<const TileOp>> modules;
    bool meetsDepth = false; ///< some obstacle is ObstacleKind::Depth, which works on the GPU only

    // Over life, t in [0, 1]; multiply the values drawn at birth.
    base::ScalarCurve sizeOverLife{std::array{1.0f}};
    base::ScalarCurve opacityOverLife{std::array{1.0f}};             ///< multiplies the cross section
    base::ScalarCurve temperatureOverLife{std::array{1.0f}};         ///< multiplies (T - T_air)
    base::ColorCurve albedoOverLife{std::array{0.0f, 0.0f, 0.0f}};   ///< [0, 1] single scattering albedo
    base::ColorCurve emissionOverLife{std::array{0.0f, 0.0f, 0.0f}}; ///< [cd/m2] besides the black body

    std::vector<EventRule> events; ///< rules by which events of its particles cause births in other emitters
    bool fed = false;              ///< events of other emitters' particles give birth in this one
    bool tinted = false;           ///< its particles may inherit a color

    RibbonDef trail;
    LightDef light;
    EmitterAppearance appearance; ///< how particles are drawn; the members below are those of a medium
    float fireShare = 0.0f;       ///< [0, 1] part of the medium accounted to the fire layer
    float heat = 0.0f;            ///< [1] how strongly the excess temperature bends light (shimmer), 0 none
    float detailAmount = 0.0f;    ///< see blob_constant
    float detailScale = 1.5f;
    float anisotropy = 0.0f;
    float shutter = 0.0f; ///< [s]

    /// Motion has a closed form: gravity, linear drag and wind alone.
    bool isBallistic() const
    {
        return modules.empty() && forces.buoyancy == 0.0f && !(forces.curlStrength > 0.0f) &&
               !(forces.updraft > 0.0f) && forces.bounce < 0.0f;
    }
};

} // namespace fx::sim
