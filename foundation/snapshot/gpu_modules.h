/// @file gpu_modules.h
/// Modules of motion without a closed form: a list from which a compute shader is assembled, and the steps
/// that it takes.
///
/// shaders/gpu_particles/gpu_particle_forces.glsl and gpu_particle_contacts.glsl implement the modules and
/// explain their numbers.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace fx::base {

enum class GpuModule : uint32_t
{
    Gravity, ///< and the wind that is the same everywhere
    Lift,    ///< gravity against buoyancy: in place of Gravity
    Curl,    ///< one octave
    Gust,
    QuadraticDrag,
    Vortex,
    HoldingVortex, ///< constrains particles to their circles
    Spring,        ///< attractors, by how they change with distance
    Constant,
    Inverse,
    InverseSquare,
    FieldAir, ///< vectors on a grid that are velocities of the air
    FieldForce,
    ConformSphere,
    ConformBox,
    Bounce, ///< at the ground plane, once a step
    // Obstacles that are met in order of time.
    Plane,
    Ground,
    Sphere,
    Box,
    Depth, ///< surfaces in a view's depth texture, see rendering/gpu_particles/gpu_depth.h
};
constexpr GpuModule kFirstGpuContact = GpuModule::Bounce;
constexpr GpuModule kFirstGpuObstacle = GpuModule::Plane;

struct GpuModuleUse
{
    GpuModule module;
    uint32_t numbers; ///< place of its first number in GpuModules::numbers
    uint32_t word;    ///< offset of its first word in the data of a step

    bool operator==(const GpuModuleUse&) const = default;
};

constexpr uint32_t kGpuStepHead = 12; ///< words of a step that every emitter has, see GpuStepWords

/// Descriptions of all modules of an emitter, in the order in which they run.
class GpuModules
{
public:
    /// @param words that it writes for each step
    void add(GpuModule module, std::initializer_list<float> numbersOfIt, uint32_t words = 0)
    {
        uses.push_back({module, uint32_t(numbers.size()), kGpuStepHead + stepWords});
        numbers.insert(numbers.end(), numbersOfIt);
        stepWords += words;
    }

    std::vector<GpuModuleUse> uses;
    std::vector<float> numbers;
    uint32_t stepWords = 0; ///< besides the head
    bool kills = false;     ///< particles may die before their time
    bool sticks = false;    ///< particles may come to rest permanently
    /// It collides with the host's geometry; if a scene has some, the emitter runs on the CPU.
    bool dependsOnHost = false;
};

/// The head of a step as the GPU reads it.
struct GpuStepWords
{
    int64_t endAge;   ///< [tick] since the step ended
    uint32_t ticks;   ///< its length
    float seconds;    ///< [s] the same
    float gravity[3]; ///< [m/s2]
    float wind[3];    ///< [m/s]
    float ground;     ///< [m] height of the ground plane, -infinity for none
    uint32_t unused;
};
static_assert(sizeof(GpuStepWords) == 4 * kGpuStepHead);

/// Steps of equal length that follow each other under equal conditions.
struct GpuStepRun
{
    int64_t age;      ///< [tick] time since the first of these steps began
    int64_t length;   ///< [tick] of each
    uint64_t history; ///< hash of all inputs of the steps before the first of these steps
    uint32_t count;
    float ground;     ///< [m]
    float gravity[3]; ///< [m/s2]
    float wind[3];    ///< [m/s]

    int64_t endAge() const { return age - length * int64_t(count); } ///< [tick]
};
static_assert(sizeof(GpuStepRun) == 56);

/// Step up to which an emitter has been computed.
struct GpuStepMark
{
    uint64_t history =
        0;           ///< key of the run of steps that contains the last step; 0: no step has been computed
    int64_t now = 0; ///< [tick] local time at the end of that step
};

} // namespace fx::base
