/// @file fragments_def.h
/// Definition of a burst of incandescent fragments. All lengths are in the instance's local space.
#pragma once

#include "foundation/math/curve.h"
#include "foundation/snapshot/blob_kind.h"
#include "simulation/solver/solver.h"

#include <glm/vec3.hpp>

#include <string>

namespace fx::sim {

/// Directions in which fragments fly.
enum class FragmentShape : uint8_t
{
    Sphere,
    Hemisphere, ///< uniform over the upper hemisphere
    Cone,       ///< within `angle` of +Y
};

/// Distribution of fragment sizes; see fragment_sizes.h.
enum class SizeLaw : uint8_t
{
    Mott,
    PowerLaw,
};

/// Material and drag of fragments.
struct FragmentMatter
{
    float density = 7850.0f;      ///< [kg/m3] > 0; steel
    float specificHeat = 490.0f;  ///< [J/(kg K)] > 0
    float emissivity = 0.85f;     ///< [1] 0 .. 1; default: oxidized steel
    float dragCoefficient = 1.0f; ///< [1] >= 0; default: a tumbling fragment; a smooth ball has 0.47
    float gravity = 1.0f;         ///< [1] multiple of the world's gravity
    float bounce = 0.35f;         ///< [1] restitution at the ground, 0 .. 1
    float friction = 0.4f; ///< [1] fraction of the tangential velocity that is lost at a bounce, 0 .. 1
};

/// The smoke behind a hot fragment. The fragment emits one blob for each distance `spacing` along its path.
struct TrailDef
{
    float spacing = 0.2f;             ///< [m] distance between blobs; 0: no smoke
    float idle = 0.0f;                ///< [m/s] smallest speed by which the emission of smoke is computed
    uint32_t maxBlobs = 4096;         ///< maximum number of living blobs
    float coldest = 650.0f;           ///< [K] temperature below which a fragment emits no smoke
    base::Range lifetime{1.5f, 3.0f}; ///< [s] > 0
    base::Range radius{0.06f, 0.1f};  ///< [m] radius of a blob at birth, behind the largest fragment
    /// [1] optical depth along a diameter at birth, behind a fragment at its initial temperature
    float opticalDepth = 0.5f;
    float temperature = 900.0f; ///< [K] temperature of a blob at birth
    float mixing = 5.0f;        ///< [1/s] rate at which the temperature approaches the temperature of the air
    float spreading = 0.02f;    ///< [m2/s] growth rate of the square of the radius
    float inherited = 0.15f;    ///< [1] fraction of the fragment's velocity that a blob inherits
    float drag = 4.0f;          ///< [1/s] rate at which the velocity approaches the velocity of the air
    float buoyancy = 1.0f;      ///< [1] multiple of the buoyancy force
    float curlStrength = 0.35f; ///< [m/s] speed of the turbulence
    float curlScale = 0.7f;     ///< [m]
    float curlRate = 0.4f;      ///< [1/s]
    base::ColorCurve albedoOverLife{std::array{0.35f, 0.34f, 0.33f}};
    float detailAmount = 0.6f; ///< see blob_constant
    float detailScale = 1.2f;
    float anisotropy = 0.3f;
};

/// Work of fragments and their smoke in units of base::WorkBudget, see docs/howto/bounded-updates.md.
namespace fragment_work {
constexpr double kMoved = 24.0; ///< work for each fragment and each blob of smoke in a sub-step
constexpr double kBirth = 20.0; ///< work for each fragment or blob that is born
constexpr double kShown = 11.0; ///< work of publishing a fragment or blob, once per step
} // namespace fragment_work

/// A burst of fragments. All fragments start at the same time.
struct FragmentsDef final : SolverDef
{
    std::string name;
    uint32_t count = 100;      ///< 1 .. 8192
    float start = 0.0f;        ///< [s]
    glm::vec3 position{0.0f};  ///< [m] center of the ball in which the fragments start
    float originRadius = 0.2f; ///< [m] radius of the ball in which the fragments start
    FragmentShape shape = FragmentShape::Sphere;
    float angle = 0.5235988f;        ///< [rad] half angle of the cone
    base::Range speed{10.0f, 30.0f}; ///< [m/s]

    SizeLaw sizeLaw = SizeLaw::Mott;
    base::Range size{0.004f, 0.05f}; ///< [m] smallest and largest diameter
    float meanSize = 0.015f;         ///< [m] for SizeLaw::Mott: diameter of a fragment of mean mass
    /// [1] Exponent of the power law, > 0. The number of fragments larger than d is proportional to
    /// d^-exponent.
    float exponent = 2.5f;

    base::Range temperature{1300.0f, 1700.0f}; ///< [K] temperature of fragments at the start
    base::Range lifetime{6.0f, 9.0f};          ///< [s] time after which the fragment is removed
    FragmentMatter matter;
    TrailDef trail;

    float visibleSize = 1.0f;   ///< [1] drawn radius divided by the radius of the fragment
    float shutter = 0.0166667f; ///< [s]
    float heat = 0.0f;          ///< see EmitterDef

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return count + (trail.spacing > 0.0f ? trail.maxBlobs : 0); }
    uint64_t bytes() const override;
    double workOf(const StepLoad& load) const override;
    bool publishes(const base::KindDesc& kind) const override { return kind == base::kBlobKind; }
    bool bendsLight() const override { return heat > 0.0f; }
    bool collides() const override { return true; }
    float reach(float gravity, float wind, float seconds) const override;
};

} // namespace fx::sim
