/// @file particle_program.h
/// Compiled form of an emitter's definition: stored attributes, motion and published columns. Built once,
/// shared by all steps.
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

/// Attributes of a particle. Values that are equal for all particles of an emitter are not stored.
namespace stored {
enum : size_t
{
    X, ///< [m] local; ballistic: where motion began
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
    Frame,      ///< [1] of the texture at birth
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

constexpr float kRoundedUp = 1.001f; ///< factor above the rounding of times and drawn values

struct ParticleProgram
{
    explicit ParticleProgram(const EmitterSettings& definition);

    const EmitterSettings& def;
    uint64_t number; ///< of the programs of the process, from 1
    bool ballistic;  ///< motion has a closed form: gravity, linear drag, wind
    bool brief;      ///< no life exceeds 3 s: ages fit into 32 bits of ticks
    bool mortal;     ///< a module may end lives
    std::array<bool, stored::Count> stores{};
    std::array<float, stored::Count> constant{}; ///< values of attributes that are not stored
    base::Ticks longestLife;

    std::vector<std::shared_ptr<const TileOp>> ops; ///< in order of phase; empty when ballistic
    bool keepsFlags = false;

    base::ColumnSet published = 0;       ///< columns of the kind "particle"
    RampCurves byLife;                   ///< over life
    std::unique_ptr<RampCurves> bySpeed; ///< over speed, null when not used
    // [s] by so much times their speed sprites are longer to each side, for bounds:
    float along = 0;  ///< those that lie along their velocity
    float across = 0; ///< those that are turned; over `corner`, which multiplies radii
    float corner;     ///< [1] distance of the farthest drawn corner from the center, over the half height
    bool plain; ///< no optional columns, appearance over life alone, colors need no bounds to be binary16

    /// Null where only the CPU can compute it; SharedProgram makes it.
    std::shared_ptr<const base::GpuParticleProgram> gpu;
};

/// Work of emitters in units of base::WorkBudget, see docs/howto/bounded-updates.md.
namespace emitter_work {
constexpr double kBirth = 3.0;  ///< of each particle that is born
constexpr double kEvent = 3.0;  ///< of each event, for each rule that may answer it
constexpr double kKept = 0.25;  ///< of each particle in a sub-step
constexpr double kMoved = 3.0;  ///< of each particle whose motion is integrated, forces apart
constexpr double kForce = 1.0;  ///< of each module
constexpr double kOctave = 2.0; ///< of each octave of turbulence
constexpr double kScan = 1.0;   ///< of each particle whose events are collected
constexpr double kListed = 0.5; ///< of each particle of a medium, once a step: to find it
constexpr double kMedium = 5.5; ///< and to show it
constexpr double kDrawn = 0.5;  ///< of each other one that is drawn
constexpr double kTrail = 8.0;  ///< of each particle with a trail in a sub-step
constexpr double kPoint = 3.0;  ///< of each point of a trail, once a step
constexpr double kLight = 3.0;  ///< of each particle that sheds light, once a step
} // namespace emitter_work

/// [unit] of base::WorkBudget that one particle counts in a sub-step.
double stepWork(const ParticleProgram& program);
/// Work of publishing a particle, once a step.
double shownWork(AppearanceKind kind);

/// [byte] that a step and a publication read and write of each row, births left out.
size_t bytesMoved(const ParticleProgram& program);

/// [1/s] one over a lifetime in seconds; NaN and negative ones are none, infinite ones are 1e9 s.
float perLifeOf(float seconds);

/// [1] Distance of the farthest drawn corner from the center, over the half height.
float cornerOf(const EmitterAppearance& appearance);

} // namespace fx::sim
