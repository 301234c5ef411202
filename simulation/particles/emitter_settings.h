/// @file emitter_settings.h
/// Definition of one emitter as plain data: births, motion and appearance of its particles. All lengths are
/// in the instance's local space.
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

/// Shapes of births.
enum class EmitterShape : uint8_t
{
    Point,
    Sphere, ///< births are uniform in the ball of radius size.x
    Box,    ///< births are uniform in the box with the half extents `size`
    Cone,   ///< births are on the disc of radius size.x and move in directions within `angle` of the axis +Y
};

/// A burst: a number of births at one time, or at several times at equal intervals.
struct Burst
{
    float time = 0; ///< [s] time after the start of the emitter, >= 0
    uint32_t count = 0;
    uint32_t cycles = 1; ///< number of cycles, each with `count` births; 0: the number of cycles is unlimited
    float interval = 0;  ///< [s] between two cycles, > 0 for several cycles
    float probability = 1; ///< [1] 0..1, probability of each cycle
};

/// A birth rate over an interval of local time.
struct Emission
{
    float rate = 0;            ///< [1/s] >= 0
    float start = 0;           ///< [s]
    float duration = 0;        ///< [s], +infinity: forever
    std::vector<Burst> bursts; ///< in declaration order

    /// Factor on the rate. The curve's parameter t in [0, 1] runs from the start to the end of a finite
    /// duration. Between the samples of the curve, the rate is linear.
    base::ScalarCurve rateOverTime{std::array{1.0f}};
};

/// Forces on each particle. Accelerations are added; drag and buoyancy are relative to the moving air.
struct EmitterForces
{
    float gravity = 1.0f; ///< [1] factor on the world's gravity
    float drag = 0.0f; ///< [1/s] rate of linear drag towards the wind, integrated exactly by an exponential
    /// [1] Buoyancy: the upward acceleration is this factor times (T / T_air - 1) g, where T is the
    /// temperature of the particle.
    float buoyancy = 0.0f;
    glm::vec3 wind{0.0f};      ///< [m/s]
    float curlStrength = 0.0f; ///< [m/s] speed of the divergence-free noise that is added to the wind
    float curlScale = 1.0f;    ///< [m] length of one noise period
    float curlRate = 0.0f;     ///< [1/s] number of noise periods per second
    /// [1] Restitution at the ground and at the host's geometry, 0..1; negative: particles pass through both.
    float bounce = -1.0f;
    float friction = 0.0f; ///< [1] fraction of the tangential velocity that is lost at a bounce, 0..1
    /// [1] Factor, 0..4, on the air flow caused by the gases of the effect. The product moves the particles.
    float updraft = 0.0f;
    /// Number of octaves of the noise, 1..8. Each octave has half the strength, half the scale and twice the
    /// rate of the previous octave.
    uint32_t curlOctaves = 1;
};

/// Processor that computes the particles of an emitter.
enum class ComputeOn : uint8_t
{
    Cpu,
    Gpu,  ///< the GPU if gpuObstacle() reports no obstacle, else the CPU
    Auto, ///< like Gpu if the capacity is at least kManyParticles, else like Cpu
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
    /// True: particles keep their world position when the host moves the instance. False: particles move with
    /// the instance.
    bool inWorld = false;
    /// [1] fraction of the instance's velocity that births inherit, 0..1; used if inWorld is set
    float inheritVelocity = 0.0f;

    base::Range lifetime{1, 1}; ///< [s] > 0
    /// Shape that gives position and direction of births; null: `shape` is used.
    std::shared_ptr<const ShapeOp> births;
    /// [m/s] speed along the direction of the shape: radial for sphere and point, +Y for box
    base::Range speed{0, 0};
    base::Range radius{0.5f, 0.5f}; ///< [m] > 0
    /// [m2] cross section at birth, >= 0. If opticalDepthGiven is set: [1] optical depth along a diameter at
    /// birth.
    base::Range crossSection{1, 1};
    bool opticalDepthGiven = true;     ///< true: `crossSection` is an optical depth
    base::Range temperature{293, 293}; ///< [K]
    EmitterForces forces;
    /// Modules executed after the forces above, in order within their phase. Without modules, and with
    /// gravity, drag and wind alone, motion has a closed form.
    std::vector<std::shared_ptr<const TileOp>> modules;
    /// True if an obstacle is of the kind ObstacleKind::Depth, which only the GPU supports.
    bool meetsDepth = false;

    // Curves over life, t in [0, 1]; the curves multiply the values drawn at birth.
    base::ScalarCurve sizeOverLife{std::array{1.0f}};
    base::ScalarCurve opacityOverLife{std::array{1.0f}};           ///< multiplies the cross section
    base::ScalarCurve temperatureOverLife{std::array{1.0f}};       ///< multiplies (T - T_air)
    base::ColorCurve albedoOverLife{std::array{0.0f, 0.0f, 0.0f}}; ///< [0, 1] single scattering albedo
    /// [cd/m2] emission in addition to black-body radiation
    base::ColorCurve emissionOverLife{std::array{0.0f, 0.0f, 0.0f}};

    /// rules by which events of the emitter's particles cause births in other emitters
    std::vector<EventRule> events;
    bool fed = false;    ///< true: events of other emitters' particles cause births in this emitter
    bool tinted = false; ///< true: particles may inherit a color

    RibbonDef trail;
    LightDef light;
    EmitterAppearance appearance; ///< how particles are drawn; the members below apply to media
    /// [1] fraction of the medium that counts as fire in the layers of the picture, 0..1
    float fireShare = 0.0f;
    float heat = 0.0f;         ///< [1] strength of refraction (heat shimmer) per excess temperature; 0: none
    float detailAmount = 0.0f; ///< see blob_constant
    float detailScale = 1.5f;
    float anisotropy = 0.0f;
    float shutter = 0.0f; ///< [s]

    /// True if motion has a closed form, because only gravity, linear drag and wind act.
    bool isBallistic() const
    {
        return modules.empty() && forces.buoyancy == 0.0f && !(forces.curlStrength > 0.0f) &&
               !(forces.updraft > 0.0f) && forces.bounce < 0.0f;
    }
};

} // namespace fx::sim
