/// @file particle_program.h
/// Compiled form of an emitter's definition: stored attributes, motion and published columns. The program is
/// built once and shared by all steps.
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

/// Attributes of a particle. An attribute is not stored if its value is equal for all particles of an
/// emitter.
namespace stored {
enum : size_t
{
    X, ///< [m] local position; for closed-form motion: position where the motion began
    Y,
    Z,
    VelocityX, ///< [m/s] velocity
    VelocityY,
    VelocityZ,
    PerLife,    ///< [1/s] reciprocal of the lifetime
    Radius,     ///< [m] radius at birth
    Amount,     ///< [m2] cross section of a medium at birth, or [1] opacity at birth
    Excess,     ///< [K] difference between the temperature at birth and the temperature of the air
    Angle,      ///< [rad] angle of rotation at birth
    Spin,       ///< [rad/s]
    Frame,      ///< [1] frame of the flipbook texture at birth
    Brightness, ///< [1]
    AxisX,      ///< unit vector along the axis about which a mesh rotates
    AxisY,
    AxisZ,
    TintRed, ///< [1] factor on the color
    TintGreen,
    TintBlue,
    Count
};
}

constexpr float kNoLife = 1e30f; ///< [1/s] value of PerLife for a lifetime of 0

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

/// factor larger than the relative rounding errors of times and drawn values
constexpr float kRoundedUp = 1.001f;

struct ParticleProgram
{
    explicit ParticleProgram(const EmitterSettings& definition);

    const EmitterSettings& def;
    uint64_t number; ///< unique number of the program in this process, from 1
    bool ballistic;  ///< true if motion has a closed form, because only gravity, linear drag and wind act
    bool brief;      ///< true if no lifetime exceeds 3 s, so that ages fit into 32 bits of ticks
    bool mortal;     ///< true if a module may kill particles
    std::array<bool, stored::Count> stores{};
    std::array<float, stored::Count> constant{}; ///< values of attributes that are not stored
    base::Ticks longestLife;

    /// modules in the order of their phases; empty if motion has a closed form
    std::vector<std::shared_ptr<const TileOp>> ops;
    bool keepsFlags = false;

    base::ColumnSet published = 0;       ///< set of published columns of the kind "particle"
    RampCurves byLife;                   ///< curves of the appearance over life
    std::unique_ptr<RampCurves> bySpeed; ///< curves of the appearance over speed; null: not used
    // [s] The bounds of a sprite are extended to each side by its speed times `along` or `across`.
    float along = 0;  ///< [s] for sprites that are aligned with their velocity
    float across = 0; ///< [s] for rotated sprites; divided by `corner`
    float corner; ///< [1] distance of the farthest drawn corner from the center, divided by the half height
    /// True if there are no optional columns, appearance depends only on life, and colors need no clamping
    /// for binary16.
    bool plain;

    /// GPU program, created by SharedProgram; null if only the CPU can compute the emitter.
    std::shared_ptr<const base::GpuParticleProgram> gpu;
};

/// Work of emitters in units of base::WorkBudget, see docs/howto/bounded-updates.md.
namespace emitter_work {
constexpr double kBirth = 3.0; ///< work for each particle that is born
constexpr double kEvent = 3.0; ///< work for each event, times the number of rules that may apply to it
constexpr double kKept = 0.25; ///< work for each particle in a sub-step
/// additional work for each particle with integrated motion; the work of forces is not included
constexpr double kMoved = 3.0;
constexpr double kForce = 1.0;  ///< work for each module and particle
constexpr double kOctave = 2.0; ///< work for each octave of turbulence and particle
constexpr double kScan = 1.0;   ///< work for each particle whose events are collected
constexpr double kListed = 0.5; ///< work of finding a particle of a medium, once per step
constexpr double kMedium = 5.5; ///< work of publishing a particle of a medium, once per step
constexpr double kDrawn = 0.5;  ///< work of publishing a particle that is not a medium, once per step
constexpr double kTrail = 8.0;  ///< work for each particle with a trail in a sub-step
constexpr double kPoint = 3.0;  ///< work for each point of a trail, once per step
constexpr double kLight = 3.0;  ///< work for each particle that emits light, once per step
} // namespace emitter_work

/// [unit of base::WorkBudget] Work of one particle in a sub-step.
double stepWork(const ParticleProgram& program);
/// [unit of base::WorkBudget] Work of publishing a particle, once per step.
double shownWork(AppearanceKind kind);

/// [byte] Data per row that a step and a publication read and write, without births.
size_t bytesMoved(const ParticleProgram& program);

/// [1/s] Reciprocal of a lifetime [s]. NaN and negative lifetimes count as 0, infinite lifetimes as 1e9 s.
float perLifeOf(float seconds);

/// [1] Distance of the farthest drawn corner from the center, divided by the half height.
float cornerOf(const EmitterAppearance& appearance);

} // namespace fx::sim
