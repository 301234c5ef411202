/// @file gpu_modules.h
/// Modules of emitters whose motion has no closed form. A compute shader is assembled from the list of
/// modules; this header also describes the data of the time steps that the shader computes.
///
/// shaders/gpu_particles/gpu_particle_forces.glsl and gpu_particle_contacts.glsl implement the modules and
/// describe their numbers.
#pragma once

#include "foundation/time/ticks.h"

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace fx::base {

enum class GpuModule : uint32_t
{
    Gravity, ///< gravity, and the uniform wind
    Lift,    ///< gravity minus buoyancy, and the uniform wind; replaces Gravity
    Curl,    ///< one octave of curl noise
    Gust,
    QuadraticDrag,
    Vortex,
    HoldingVortex, ///< a vortex that keeps particles on circles
    Spring,        ///< attractors; the force increases with distance
    Constant,
    Inverse,
    InverseSquare,
    FieldAir, ///< a vector grid with velocities of the air
    FieldForce,
    ConformSphere,
    ConformBox,
    Bounce, ///< particles bounce off the ground plane; tested once per step
    // Obstacles. Their contacts within a step are handled in order of time.
    Plane,
    Ground,
    Sphere,
    Box,
    Depth, ///< collision with the surfaces in a view's depth texture, see rendering/gpu_particles/gpu_depth.h
};
constexpr GpuModule kFirstGpuContact = GpuModule::Bounce;
constexpr GpuModule kFirstGpuObstacle = GpuModule::Plane;

struct GpuModuleUse
{
    GpuModule module;
    uint32_t numbers; ///< index of the module's first number in GpuModules::numbers
    uint32_t word;    ///< [word] offset of the module's data in the data of a step

    bool operator==(const GpuModuleUse&) const = default;
};

constexpr uint32_t kGpuStepHead = 12; ///< [word] size of GpuStepWords

/// Descriptions of all modules of an emitter, in the order in which they run.
class GpuModules
{
public:
    /// Appends a module.
    /// @param numbersOfIt constants of the module
    /// @param words number of 32-bit words of the module's data per step
    void add(GpuModule module, std::initializer_list<float> numbersOfIt, uint32_t words = 0)
    {
        uses.push_back({module, uint32_t(numbers.size()), kGpuStepHead + stepWords});
        numbers.insert(numbers.end(), numbersOfIt);
        stepWords += words;
    }

    std::vector<GpuModuleUse> uses;
    std::vector<float> numbers;
    uint32_t stepWords = 0; ///< [word] size of the data of all modules in one step, without GpuStepWords
    bool kills = false;     ///< true: particles may die before the end of their lifetime
    bool sticks = false;    ///< true: particles may come to rest permanently
    /// True: the emitter collides with the host's geometry. If the scene has geometry of the host, the
    /// emitter runs on the CPU.
    bool dependsOnHost = false;
};

/// First part of the data of a step, in the layout that the GPU reads. This part has the same layout for all
/// emitters. The data of the modules follow.
struct GpuStepWords
{
    int64_t endAge;   ///< [tick] time since the step ended
    uint32_t ticks;   ///< [tick] length of the step
    float seconds;    ///< [s] length of the step
    float gravity[3]; ///< [m/s2]
    float wind[3];    ///< [m/s]
    float ground;     ///< [m] height of the ground plane; -infinity: no ground plane
    uint32_t unused;
};
static_assert(sizeof(GpuStepWords) == 4 * kGpuStepHead);

/// Steps of equal length that follow each other under equal conditions.
struct GpuStepRun
{
    int64_t age;      ///< [tick] time since the first of these steps began
    int64_t length;   ///< [tick] length of each step
    uint64_t history; ///< hash of all inputs of the steps before the first of these steps
    uint32_t count;
    float ground;     ///< [m]
    float gravity[3]; ///< [m/s2]
    float wind[3];    ///< [m/s]

    int64_t endAge() const { return age - length * int64_t(count); } ///< [tick]
};
static_assert(sizeof(GpuStepRun) == 56);

/// The step up to which the particles of an emitter have been computed.
struct GpuStepMark
{
    /// GpuStepRun::history of the run that contains the last computed step; 0: no step has been computed.
    uint64_t history = 0;
    int64_t now = 0; ///< [tick] local time at the end of the last computed step
};

} // namespace fx::base
