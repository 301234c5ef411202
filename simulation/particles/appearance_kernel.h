/// @file appearance_kernel.h
/// Computes the published columns of particles from their state, in one pass over memory.
///
/// @formula ballistic-motion
/// Position and velocity of a particle under gravity, linear drag and wind as a function of its age.
///
/// symbol    unit   meaning
///   x0, v0         position and velocity when its motion began
///   t        s     time since then
///   a        m/s2  gravity
///   k        1/s   drag rate
///   u        m/s   velocity of the air
///   E, G, R        as in linear-drag-step, for a step of t
/// @derivation
///   One step of linear-drag-step over the whole time, with t - G = k R:
///       x(t) = x0 + G v0 + R (a + k u)                                                     (1)
///       v(t) = E v0 + G (a + k u)                                                          (2)
///   No integration is needed, so any time is computed directly, independent of steps. When gravity or wind
///   change, x0 and v0 are set to the state at that time, and t is counted from there.
/// @source    elementary (linear ordinary differential equation)
/// @deviation none
/// @valid     as linear-drag-step
/// @accuracy  drag-coefficients and float rounding of the sums
/// @tests     tests/simulation/particles/core/test_ballistic_motion.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "simulation/particles/particle_store.h"

#include <limits>
#include <span>

namespace fx::sim {

constexpr float kLongestStep = 1.0f; ///< [s] maximum time between two snapshots
constexpr float kFarAway = std::numeric_limits<float>::infinity();

/// Data shared by all particles of an emitter in a publication.
struct AppearanceJob
{
    const ParticleProgram* program;
    const ParticleStore* store;
    RowWindow rows;
    base::Ticks now;
    base::Ticks motionBegin; ///< local time at which motion begins, for particles born before this time
    glm::vec3 pull; ///< [m/s2] acceleration a + k u of equation (1), by gravity and wind; used only for
                    ///< closed-form motion
    float secondsBack = kLongestStep; ///< [s] time since the previous snapshot, for bounds
};

/// Columns of a group of the kind "particle"; null if absent.
struct AppearanceColumns
{
    float* x;
    float* y;
    float* z;
    float* age;
    float* radius;
    uint64_t* color;
    float* velocity[3];
    float* angle;
    float* frame;
    float* orientation[4];
    uint64_t* index;
    bool stream; ///< true: columns are written with non-temporal stores
};

/// Box of the centers, and the largest half height of a drawn particle.
struct AppearanceBounds
{
    glm::vec3 low{kFarAway};
    glm::vec3 high{-kFarAway};
    float radius = 0;

    void add(const AppearanceBounds& other);
    base::Bounds box() const;
};

/// Writes the rows [begin, end). `begin` must be a multiple of kTilePadding. `end` must be a multiple of
/// kTilePadding or the window's count. All columns of empty rows are zero.
AppearanceBounds writeAppearance(const AppearanceJob& job, const AppearanceColumns& out, uint32_t begin,
                                 uint32_t end);

/// A group that writeManyAppearances() writes.
struct AppearancePart
{
    AppearanceJob job;
    float* storage;          ///< columns that the program publishes, see base::SnapshotGroup::editStorage()
    size_t group;            ///< index of the group in the snapshot
    AppearanceBounds bounds; ///< output: bounds of the particles
};

/// Writes all rows of each part, with the same bits as writeAppearance(). The function is much faster for
/// small parts, and fastest if parts of one program are consecutive.
void writeManyAppearances(std::span<AppearancePart> parts);

/// Positions and velocities of particles, for rows that are read one by one.
struct alignas(64) MotionTile
{
    float position[3][kTileRows];
    float velocity[3][kTileRows];
    float age[kTileRows];  ///< [s]
    float life[kTileRows]; ///< [1] age divided by lifetime; values >= 1 and NaN mark empty rows
};

/// Fills the first `count` rows of a MotionTile. The rows of the store begin at `row`, a multiple of
/// kTilePadding.
void readMotion(const AppearanceJob& job, uint32_t row, uint32_t count, MotionTile& out);

} // namespace fx::sim
