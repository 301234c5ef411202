/// @file particle_program.h
/// Compiled form of an emitter's definition: stored attributes, motion and published columns. It is built
/// once and shared by all steps.
#pragma once

#include "simulation/particles/emitter_settings.h"
#include "simulation/particles/ramp_curves.h"

#include <array>
#include <memory>
#include <vector>

namespace fx::base {
class GpuParticleProgram;
}

namespace fx::sim {

/// Attributes of a particle. An attribute with the same value for all particles of an emitter is not stored.
namespace stored {
enum : size_t
{
    X, ///< [m] local position; ballistic: position where the motion began
    Y,
    Z,
    VelocityX, ///< [m/s] velocity
    VelocityY,
    VelocityZ,
    PerLife,    ///< [1/s] one over the lifetime
    Radius,     ///< [m] at birth
    Amount,     ///< [m2] cross section of a medium, or [1] opacity, at birth
    Excess,     ///< [K] temperature above the air's at birth
    Angle,      ///< [rad] at birth
    Spin,       ///< [rad/s]
    Frame,      ///< [1] frame of the texture at birth
    Brightness, ///< [1]
    AxisX,      ///< [1] unit axis that a mesh turns about
    AxisY,
    AxisZ,
    TintRed, ///< [1] multiplies the color
    TintGreen,
    TintBlue,
    Count
};
}

constexpr float kNoLife = 1e30f; ///< [1/s] PerLife of a lifetime of 0

/// Channels of ParticleProgram::byLife.
namespace appearance_channel {
enum : uint32_t
{
    Red,
    Green,
    Blue,
    Opacity,
    Size,
    Count
};
}

constexpr float kRoundedUp = 1.001f; ///< factor that exceeds the rounding of times and drawn values

struct ParticleProgram
{
    explicit ParticleProgram(const EmitterSettings& definition);

    const EmitterSettings& def;
    uint64_t number; ///< number of the program in this process, from 1
    bool ballistic;  ///< motion has a closed form: gravity, linear drag, wind
    bool brief;      ///< no lifetime exceeds 3 s, so ages fit into 32 bits of ticks
    bool mortal;     ///< a module may kill particles
    std::array<bool, stored::Count> stores{};
    std::array<float, stored::Count> constant{}; ///< values of attributes that are not stored
    base::Ticks longestLife;

    std::vector<std::shared_ptr<const TileOp>> ops; ///< in order of phase; empty when ballistic
    bool keepsFlags = false;

    base::ColumnSet published = 0;       ///< columns of the kind "particle"
    RampCurves byLife;                   ///< over life
    std::unique_ptr<RampCurves> bySpeed; ///< over speed, null when not used
    // [s] For bounds: a sprite is extended to each side by its speed times these numbers.
    float along = 0;  ///< for sprites along their velocity
    float across = 0; ///< for rotated sprites; divided by `corner`, which multiplies radii
    float corner;     ///< [1] distance of the farthest drawn corner from the center, over the half height
    bool plain;       ///< no optional columns, appearance over life only, colors fit binary16 without bounds

    /// GPU program, created by SharedProgram; null if only the CPU can compute the emitter.
    std::shared_ptr<const base::GpuParticleProgram> gpu;
};

/// Work of emitters in units of base::WorkBudget, see docs/howto/bounded-updates.md.
namespace emitter_work {
constexpr double kBirth = 3.0;  ///< for each particle that is born
constexpr double kEvent = 3.0;  ///< for each event, per rule that may answer it
constexpr double kKept = 0.25;  ///< for each particle in a sub-step
constexpr double kMoved = 3.0;  ///< for each particle whose motion is integrated, without forces
constexpr double kForce = 1.0;  ///< for each module
constexpr double kOctave = 2.0; ///< for each octave of turbulence
constexpr double kScan = 1.0;   ///< for each particle whose events are collected
constexpr double kListed = 0.5; ///< for each particle of a medium, once a step: finding it
constexpr double kMedium = 5.5; ///< publishing it
constexpr double kDrawn = 0.5;  ///< for each other particle that is drawn
constexpr double kTrail = 8.0;  ///< for each particle with a trail in a sub-step
constexpr double kPoint = 3.0;  ///< for each point of a trail, once a step
constexpr double kLight = 3.0;  ///< for each particle that emits light, once a step
} // namespace emitter_work

/// [unit] of base::WorkBudget for one particle in a sub-step.
double stepWork(const ParticleProgram& program);
/// [unit] of base::WorkBudget for publishing a particle, once a step.
double shownWork(AppearanceKind kind);

/// [byte] that a step and a publication read and write per row, without births.
size_t bytesMoved(const ParticleProgram& program);

/// [1/s] Reciprocal of a lifetime [s]. NaN and negative lifetimes count as 0, infinite ones as 1e9 s.
float perLifeOf(float seconds);

/// [1] Distance of the farthest drawn corner from the center, over the half height.
float cornerOf(const EmitterAppearance& appearance);

} // namespace fx::sim
