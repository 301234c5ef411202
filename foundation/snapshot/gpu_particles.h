/// @file gpu_particles.h
/// The kind "gpuParticle": the inputs from which an emitter's particles are computed, published instead of
/// the particles. The emitter writes this kind. The renderer computes rows of the kind "particle" from a
/// group of this kind.
///
/// A group of this kind has one column of 64-bit words: a GpuParticleMoment, its GpuBirthRuns, its
/// GpuConditions and its GpuStepRuns, in this order. The constant data of the emitter are in the group's
/// program. The computed rows and their order are those that the same emitter would publish from the CPU as
/// the kind "particle". The constants of the group are those of base::particle_constant.
///
/// All structures consist of numbers of 4 and 8 bytes without gaps. The low word of an 8-byte number comes
/// first. shaders/gpu_particles/gpu_particle_words.glsl reads these layouts.
///
/// @formula birth-runs
/// The age of a particle from a run of births at equal intervals, in 32-bit arithmetic.
///
/// symbol   unit   meaning
///   D, q, R       as in birth-ticks
///   j        1    number of the birth within its run, < 2^32
///   s        tick floor(D / q)
///   f        1    (D mod q) / q, rounded up to a multiple of 2^-96
///   r        1    (-R mod q) / q, likewise
/// @derivation
///   Equation (4) of birth-ticks for m = 0, with -R = q a + q r and D = q s + q f:
///       floor((j D - R) / q) = a + j s + floor(r + j f)                                       (1)
///   With exact r and f, the argument of the last floor is an integer, or at least 1/q >= 2^-62 below the
///   next integer. Rounding r and f up adds less than (j + 1) 2^-96 < 2^-63, so the floor is kept  (2)
///   A run may begin with any birth j. Then (1) replaces a, and the fraction of r + j f replaces r  (3)
/// @source    elementary
/// @deviation none
/// @valid     j < 2^32, q < 2^62; a burst (births at one time) is a run with s = f = r = 0
/// @accuracy  exact
/// @tests     tests/simulation/test_birth_log.cpp
#pragma once

#include "foundation/math/curve.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "foundation/snapshot/gpu_modules.h"
#include "foundation/snapshot/particle_kind.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace fx::base {

inline constexpr ColumnDesc kGpuParticleColumns[] = {{"word", "1", ColumnType::U64}};
inline constexpr KindDesc kGpuParticleKind{"gpuParticle", kGpuParticleColumns, kParticleConstants, false};

/// Shape of the volume in which particles are born, before its rotation. Sizes are in GpuParticleNumbers.
enum class GpuShape : uint32_t
{
    Point,
    Ball, ///< ball of radius size[0]; empty within the radius inner * size[0]
    Box,  ///< box with the half extents `size`; initial direction +Y
    /// Births on the disc of radius size[0]; the cosine of the angle between the initial direction and +Y is
    /// at least cosLimit.
    Cone,
    BoxFaces, ///< faces of the box; initial direction outwards
    Line,     ///< line along Y from -size[0] to size[0]
    Disc,     ///< disc of radius size[0]; initial direction +Y
    Torus,    ///< circle of radius size[0] with a tube of radius `tube` around it
    /// Cone on the disc of radius size[0], or the side of this cone; initial direction away from the tip.
    TallCone,
};

/// Choice of the frame of a flipbook texture.
enum class GpuFrames : uint32_t
{
    First,
    OverLife,
    PerSecond,
};

constexpr size_t kGpuCurveSamples = kCurveSamples + 1;
constexpr size_t kGpuCurvePieces = 10;

/// Constants of an emitter. Ranges are {min, max}; min = max means a constant without a random draw.
struct GpuParticleNumbers
{
    float position[3]; ///< [m] center of the shape
    float size[3];     ///< [m]
    float axis[3];     ///< unit vector onto which +Y is rotated
    float cosLimit;
    float inner;         ///< [1] share of the radius that is empty; 1: births on the surface
    float tube;          ///< [m] Torus: radius of the tube; TallCone: 1 for births on the side, else 0
    float speed[2];      ///< [m/s]
    float lifetime[2];   ///< [s]
    float perLife;       ///< [1/s] 1 / lifetime, if all particles have the same lifetime
    float radius[2];     ///< [m]
    float opacity[2];    ///< [1]
    float brightness[2]; ///< [1]
    float angle[2];      ///< [rad]
    float spin[2];       ///< [rad/s]
    float frame[2];      ///< [1]
    float drag;          ///< [1/s] >= 0
    float perDrag;       ///< [s] 1 / drag; 0 without drag
    float frames;        ///< [1] number of frames of the texture
    float framesPerSecond;
    float perFastest; ///< [s/m] 1 / (speed at which the curves over speed end)
    float height;     ///< [m] height of the cone
    float slope[3];   ///< [1] slope of the cone's side in double precision, as the sum of three floats
    /// Red, green, blue, opacity and size over life. Size and opacity multiply the values drawn at birth. A
    /// curve is stored as samples at equal distances, or as kGpuCurvePieces linear pieces. The pieces are
    /// stored as three arrays: values extrapolated to t = 0, slopes, and the t at which each piece begins
    /// (infinite for unused pieces).
    float lifeCurves[5][kGpuCurveSamples];
    float speedCurves[5][kGpuCurveSamples];
};
static_assert(sizeof(GpuParticleNumbers) == 4 * (38 + 10 * kGpuCurveSamples));

/// Key of the compute program of an emitter. Emitters with equal features share a program.
struct GpuParticleFeatures
{
    GpuShape shape = GpuShape::Point;
    GpuFrames frames = GpuFrames::First;
    bool turned = false; ///< true: the axis is not +Y
    bool brief = false;  ///< true: ages fit in 32-bit numbers of ticks
    bool lifeVaries = false;
    bool drags = false;
    bool bySpeed = false;
    bool wide = false;      ///< true: the shape is computed in double precision, as in ShapeOp on the CPU
    bool lifeTable = false; ///< true: curves over life are stored as samples; false: as linear pieces
    bool speedTable = false;
    bool steps = false;    ///< true: motion has no closed form, so that `modules` compute it in steps
    ColumnSet columns = 0; ///< columns of the kind "particle" that are computed
    std::vector<GpuModuleUse> modules;
    uint32_t stepWords = 0; ///< [word] size of the data of a step, including GpuStepWords

    bool operator==(const GpuParticleFeatures&) const = default;
};

/// An emitter whose particles the GPU computes. Immutable; shared by all groups and threads.
class GpuParticleProgram
{
public:
    virtual ~GpuParticleProgram() = default;

    GpuParticleFeatures features;
    GpuParticleNumbers numbers{};
    std::vector<float> moduleNumbers; ///< see GpuModules
    uint32_t rows = 0;                ///< number of rows, including rows of dead particles
    bool kills = false;               ///< see GpuModules
    bool dependsOnHost = false;       ///< see GpuModules
    float meanRadius = 0.0f;          ///< [m] approximate mean radius, to estimate costs

    /// Computes the particles of `group` on the calling thread, and adds them to `out` as a group of the kind
    /// "particle". The result equals the group that the emitter would publish from the CPU. The schema of
    /// `out` must contain this kind. Callable from any thread; allocates.
    virtual void replay(const SnapshotGroup& group, FrameSnapshot& out) const = 0;
    /// Appends the words of all steps of `group` that ended after `since`, in order, to `out`. Callable from
    /// any thread; allocates memory for `out` only. Requires features.steps.
    /// @param since [tick] local time
    virtual void writeSteps(const SnapshotGroup& group, int64_t since, std::vector<uint32_t>& out) const = 0;
};

/// Consecutive births at equal intervals of time, or all at the same time.
struct GpuBirthRun
{
    /// Number of births from the first birth of the run to the next birth: the index of the first birth is
    /// GpuParticleMoment::next - reach.
    uint32_t reach;
    uint32_t unused;
    int64_t age;          ///< [tick] age of the particle of the first birth
    int64_t stride;       ///< [tick] s of formula birth-runs: the interval, rounded down
    uint32_t fraction[3]; ///< [2^-96] f of formula birth-runs, lowest word first
    uint32_t rest[3];     ///< [2^-96] r of formula birth-runs for the first birth
};

/// Acceleration of all particles from the moment of this condition until the moment of the next condition.
struct GpuCondition
{
    /// [tick] time since the moment of the condition; for the first condition, at least the age of every
    /// particle
    int64_t age;
    float pull[3]; ///< [m/s2] gravity + drag * wind
    float unused;
};

/// The state of a group. Particle i has the row i mod rows. The last `window` births may still be alive.
struct GpuParticleMoment
{
    uint64_t seed;       ///< key of base::philox
    uint64_t next;       ///< index of the next birth
    int64_t now;         ///< [tick] local time
    uint32_t solver;     ///< counter word 2 of base::philox
    uint32_t rows;       ///< number of rows, as in the program
    uint32_t nextRow;    ///< row of the next birth: next mod rows
    uint32_t window;     ///< number of births before `next` that may be alive, <= rows
    uint32_t runs;       ///< number of GpuBirthRuns, in order of time; > 0 if window > 0
    uint32_t conditions; ///< number of GpuConditions, > 0, in order of time
    uint32_t stepRuns;   ///< number of GpuStepRuns, in order of time; 0 unless features.steps
    uint32_t unused;
};

static_assert(sizeof(GpuBirthRun) == 48 && sizeof(GpuCondition) == 24 && sizeof(GpuParticleMoment) == 56);

constexpr uint32_t kMaxGpuRuns = 64;
constexpr uint32_t kMaxGpuConditions = 16;
constexpr uint32_t kMaxGpuStepRuns = 512;
constexpr uint32_t kMaxGpuSteps = 4096; ///< largest number of steps within the lifetime of a particle
constexpr size_t kMaxGpuWords = (sizeof(GpuParticleMoment) + kMaxGpuRuns * sizeof(GpuBirthRun) +
                                 kMaxGpuConditions * sizeof(GpuCondition)) /
                                8;
/// Largest number of words of an emitter whose motion is computed in steps.
constexpr size_t kMaxSteppedGpuWords = kMaxGpuWords + kMaxGpuStepRuns * sizeof(GpuStepRun) / 8;

/// Reads the moment, or the run of steps with number `run`, from the words of a group.
GpuParticleMoment gpuMomentOf(const SnapshotGroup& group);
GpuStepRun gpuStepRunOf(const SnapshotGroup& group, const GpuParticleMoment& moment, uint32_t run);
/// Number of steps of a run that ended at or before the local time `tick`, if the present local time is
/// `now`.
uint32_t gpuStepsBefore(const GpuStepRun& run, int64_t now, int64_t tick);
/// True if the state of the particles at `mark` is valid for `group`. Then only the steps after `mark` must
/// be computed.
bool continuesFrom(const SnapshotGroup& group, const GpuStepMark& mark);
/// The mark after the last step of `group`.
GpuStepMark gpuMarkOf(const SnapshotGroup& group);

/// [tick] Age of the particle of birth number `j` of a run, by equation (1) of formula birth-runs.
inline int64_t gpuBirthAge(const GpuBirthRun& run, uint32_t j)
{
    __extension__ typedef unsigned __int128 Wide;
    const auto wide = [](const uint32_t* w) { return (Wide(w[2]) << 64) | (Wide(w[1]) << 32) | w[0]; };
    const Wide sum = wide(run.rest) + Wide(j) * wide(run.fraction); // < 2^128
    return run.age - int64_t(j) * run.stride - int64_t(sum >> 96);
}

/// True when the snapshot has a group of the kind "gpuParticle".
bool hasGpuParticles(const FrameSnapshot& snapshot);
/// Returns a copy of the snapshot in which groups of the kind "gpuParticle" are replaced by computed groups
/// of the kind "particle". Callable from any thread.
std::unique_ptr<FrameSnapshot> replayOnCpu(const FrameSnapshot& snapshot, std::pmr::memory_resource* memory);

} // namespace fx::base
