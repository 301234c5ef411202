/// @file gpu_particles.h
/// The kind "gpuParticle": the inputs from which an emitter's particles are computed, published instead of
/// the particles. Shared by the emitter that writes it and the renderer that computes rows of the kind
/// "particle" from it; neither depends on the other.
///
/// A group of this kind has one column of 64-bit words: a GpuParticleMoment, its GpuBirthRuns, its
/// GpuConditions and its GpuStepRuns, in this order. The constant data of the emitter are in the group's
/// program. The order of rows and the particle in each row equal those of the kind "particle", which the same
/// emitter publishes on the CPU; constants are those of base::particle_constant.
///
/// All structures consist of 4 and 8 byte numbers without gaps, low word first, as
/// shaders/gpu_particles/gpu_particle_words.glsl reads them.
///
/// @formula birth-runs
/// The age of a particle whose births follow each other evenly, in 32-bit arithmetic.
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
///   With exact r and f the argument of the last floor is an integer or at least 1/q >= 2^-62 below the
///   next one; rounding up adds less than (j + 1) 2^-96 < 2^-63, which reaches no integer.    (2)
///   A run may begin with any of its births: a + j s + the carry, and the fraction that is left   (3)
/// @source    elementary
/// @deviation none
/// @valid     j < 2^32, q < 2^62; one burst is a run with s = f = r = 0
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

/// Shape of the volume in which particles are born, before its rotation.
enum class GpuShape : uint32_t
{
    Point,
    Ball,     ///< of radius size[0]; empty within the share `inner` of it
    Box,      ///< half extents size, heading along +Y
    Cone,     ///< on the disc of radius size[0], heading within the angle of +Y whose cosine is cosLimit
    BoxFaces, ///< on the faces, heading outwards
    Line,     ///< along Y, size[0] to both sides
    Disc,     ///< of radius size[0], heading along +Y
    Torus,    ///< in the tube around the circle of radius size[0]
    TallCone, ///< in the cone above the disc of radius size[0], or on its side, heading away from its tip
};

/// How the frame of a flipbook texture is chosen.
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
    float axis[3];     ///< unit vector that +Y is turned onto
    float cosLimit;
    float inner;         ///< [1] share of the radius that is empty; 1: on the surface
    float tube;          ///< [m] of the torus; of cones 1: on the side
    float speed[2];      ///< [m/s]
    float lifetime[2];   ///< [s]
    float perLife;       ///< [1/s] where lifetimes do not vary
    float radius[2];     ///< [m]
    float opacity[2];    ///< [1]
    float brightness[2]; ///< [1]
    float angle[2];      ///< [rad]
    float spin[2];       ///< [rad/s]
    float frame[2];      ///< [1]
    float drag;          ///< [1/s] >= 0
    float perDrag;       ///< [s] 1 / drag, or 0
    float frames;        ///< [1] of the texture
    float framesPerSecond;
    float perFastest; ///< [s/m] 1 / the speed at which the curves over speed end
    float height;     ///< [m] of the cone
    float slope[3];   ///< [1] of its side, in three parts whose sum is exact
    /// Red, green, blue, opacity, size over life; size and opacity multiply the values drawn at birth. Either
    /// samples at equal distances, or kGpuCurvePieces linear pieces: their values extrapolated to t = 0,
    /// their slopes and their beginnings (infinite for unused pieces).
    float lifeCurves[5][kGpuCurveSamples];
    float speedCurves[5][kGpuCurveSamples];
};
static_assert(sizeof(GpuParticleNumbers) == 4 * (38 + 10 * kGpuCurveSamples));

/// Key of the compute program of an emitter. Emitters with equal features share a program.
struct GpuParticleFeatures
{
    GpuShape shape = GpuShape::Point;
    GpuFrames frames = GpuFrames::First;
    bool turned = false; ///< the axis is not +Y
    bool brief = false;  ///< ages are computed from 32 bits of ticks
    bool lifeVaries = false;
    bool drags = false;
    bool bySpeed = false;
    bool wide = false;      ///< the shape is computed in double precision, as ShapeOp has it
    bool lifeTable = false; ///< curves over life are samples, not pieces
    bool speedTable = false;
    bool steps = false;    ///< motion has no closed form: it is stepped by `modules`
    ColumnSet columns = 0; ///< of the kind "particle" that are computed
    std::vector<GpuModuleUse> modules;
    uint32_t stepWords = 0; ///< of a step, its head included

    bool operator==(const GpuParticleFeatures&) const = default;
};

/// An emitter as the GPU computes it. Immutable, shared by all groups and threads.
class GpuParticleProgram
{
public:
    virtual ~GpuParticleProgram() = default;

    GpuParticleFeatures features;
    GpuParticleNumbers numbers{};
    std::vector<float> moduleNumbers; ///< see GpuModules
    uint32_t rows = 0;                ///< computed particles
    bool kills = false;               ///< see GpuModules
    bool dependsOnHost = false;       ///< see GpuModules
    float meanRadius = 0.0f;          ///< [m] approximate radius, to estimate costs

    /// Computes the rows of `group` on the calling thread, as the emitter would have published them: adds a
    /// group of the kind "particle" to `out`, whose schema contains it. Any thread; allocates.
    virtual void replay(const SnapshotGroup& group, FrameSnapshot& out) const = 0;
    /// Appends the words of all steps of `group` that ended after `since`, in order, to `out`. Callable from
    /// any thread; allocates memory for `out` only. Only where features.steps.
    /// @param since [tick] local time
    virtual void writeSteps(const SnapshotGroup& group, int64_t since, std::vector<uint32_t>& out) const = 0;
};

/// Births at equal intervals of time, or all at the same time.
struct GpuBirthRun
{
    uint32_t reach; ///< the first birth of the run is the one with index next - reach
    uint32_t unused;
    int64_t age;          ///< [tick] of the first birth
    int64_t stride;       ///< [tick] s
    uint32_t fraction[3]; ///< [2^-96] f, lowest word first
    uint32_t rest[3];     ///< [2^-96] r of the first birth
};

/// Conditions of all particles from a time on.
struct GpuCondition
{
    int64_t age;   ///< [tick] of that moment; that of the first one is not less than any particle's
    float pull[3]; ///< [m/s2] gravity and drag against the wind together
    float unused;
};

/// The state of a group. Particle i lives in row i mod rows; the window holds the births that may live.
struct GpuParticleMoment
{
    uint64_t seed;       ///< key of base::philox
    uint64_t next;       ///< index of the next birth
    int64_t now;         ///< [tick] local time
    uint32_t solver;     ///< counter word 2 of base::philox
    uint32_t rows;       ///< as in the program
    uint32_t nextRow;    ///< next mod rows
    uint32_t window;     ///< births before `next` that may live, <= rows
    uint32_t runs;       ///< > 0 when the window is not empty; ascending
    uint32_t conditions; ///< > 0, ascending
    uint32_t stepRuns;   ///< ascending; 0 unless features.steps
    uint32_t unused;
};

static_assert(sizeof(GpuBirthRun) == 48 && sizeof(GpuCondition) == 24 && sizeof(GpuParticleMoment) == 56);

constexpr uint32_t kMaxGpuRuns = 64;
constexpr uint32_t kMaxGpuConditions = 16;
constexpr uint32_t kMaxGpuStepRuns = 512;
constexpr uint32_t kMaxGpuSteps = 4096; ///< within a life
constexpr size_t kMaxGpuWords = (sizeof(GpuParticleMoment) + kMaxGpuRuns * sizeof(GpuBirthRun) +
                                 kMaxGpuConditions * sizeof(GpuCondition)) /
                                8;
/// The same for an emitter that is stepped.
constexpr size_t kMaxSteppedGpuWords = kMaxGpuWords + kMaxGpuStepRuns * sizeof(GpuStepRun) / 8;

/// The moment and the runs of steps in the words of a group.
GpuParticleMoment gpuMomentOf(const SnapshotGroup& group);
GpuStepRun gpuStepRunOf(const SnapshotGroup& group, const GpuParticleMoment& moment, uint32_t run);
/// Number of steps of a run that had ended at or before `tick`, if the present time is `now`.
uint32_t gpuStepsBefore(const GpuStepRun& run, int64_t now, int64_t tick);
/// True when the steps of `group` continue at `mark`.
bool continuesFrom(const SnapshotGroup& group, const GpuStepMark& mark);
/// The mark after the steps of `group`.
GpuStepMark gpuMarkOf(const SnapshotGroup& group);

/// [tick] The age of birth number `j` of a run. (1)
inline int64_t gpuBirthAge(const GpuBirthRun& run, uint32_t j)
{
    __extension__ typedef unsigned __int128 Wide;
    const auto wide = [](const uint32_t* w) { return (Wide(w[2]) << 64) | (Wide(w[1]) << 32) | w[0]; };
    const Wide sum = wide(run.rest) + Wide(j) * wide(run.fraction); // < 2^128
    return run.age - int64_t(j) * run.stride - int64_t(sum >> 96);
}

/// True when a group is of the kind "gpuParticle".
bool hasGpuParticles(const FrameSnapshot& snapshot);
/// A copy of a snapshot in which all such groups are of the kind "particle". Any thread.
std::unique_ptr<FrameSnapshot> replayOnCpu(const FrameSnapshot& snapshot, std::pmr::memory_resource* memory);

} // namespace fx::base
