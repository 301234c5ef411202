/// @file tile.h
/// Working set of an emitter's modules: a tile of particles whose columns fit into the L1 cache.
///
/// An emitter whose motion has no closed form is stepped tile by tile. A tile is loaded from the store,
/// processed by all modules in the order of phases, and stored. Memory is therefore read and written once,
/// for any number of modules. Rows without a living particle are also loaded. These rows have seconds 0 and
/// the flag Empty, and their results are discarded. Modules use multiplications and additions in a fixed
/// order, without fused multiply-add and without sums over rows. Therefore every vector width gives the same
/// bits.
///
/// Threads: several threads process tiles of one step at once; modules have no mutable state.
#pragma once

#include "foundation/time/ticks.h"
#include "simulation/solver/solver.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace fx::sim {

constexpr uint32_t kTileRows = 256;
constexpr uint32_t kTilePadding = 16; ///< modules may process rows up to the next multiple of this number

/// Bits of Tile::flags. Stuck and Collided persist from step to step. The other flags are set for one step.
namespace tile_flag {
enum : uint32_t
{
    Stuck = 1,    ///< at rest permanently
    Collided = 2, ///< the particle has had a contact during its life
    Empty = 4,    ///< the row has no living particle
    Hit = 8,      ///< the particle has a contact in this step; Tile::contact is the time of the contact
    Killed = 16,  ///< a module has killed the particle in this step; Tile::contact is the time of its death
};
}

/// Working columns of a tile of particles. Arrays begin at multiples of 64 bytes; rows [count, kTileRows)
/// hold finite numbers.
struct alignas(64) Tile
{
    /// [m] Local position. Before TilePhase::Integrate, it is the position at the beginning of the step;
    /// after this phase, at the end.
    float x[kTileRows];
    float y[kTileRows];
    float z[kTileRows];
    float vx[kTileRows]; ///< [m/s] velocity
    float vy[kTileRows];
    float vz[kTileRows];
    float fromX[kTileRows]; ///< [m] position at the beginning of the row's part of the step
    float fromY[kTileRows];
    float fromZ[kTileRows];
    float fromVX[kTileRows]; ///< [m/s] velocity at the beginning of the row's part of the step
    float fromVY[kTileRows];
    float fromVZ[kTileRows];
    float ax[kTileRows]; ///< [m/s2] sum of the accelerations by all forces
    float ay[kTileRows];
    float az[kTileRows];
    float ux[kTileRows]; ///< [m/s] velocity of the air, a sum over all forces
    float uy[kTileRows];
    float uz[kTileRows];
    float drag[kTileRows]; ///< [1/s] rate of linear drag towards the air, >= 0, a sum over all forces
    /// [1/m] Coefficient q >= 0 of the quadratic drag -q |v - u| (v - u), a sum over all forces.
    float quadratic[kTileRows];
    /// [s] age at the beginning of the row's part of the step; 0 for a particle born within the step
    float age[kTileRows];
    /// [s] length of the row's part of the step; shorter for a particle born within the step, 0 if Empty
    float seconds[kTileRows];
    float life[kTileRows];   ///< [1] age / lifetime at the beginning of the row's part of the step, 0..1
    float excess[kTileRows]; ///< [K] difference between the temperatures of particle and air
    /// [1] Time of the contact as a fraction of the row's part of the step, 0..1. Set together with Hit or
    /// Killed.
    float contact[kTileRows];
    uint32_t indexLow[kTileRows]; ///< birth index, which forms the counter words 0 and 1 of base::philox
    uint32_t indexHigh[kTileRows];
    uint32_t flags[kTileRows]; ///< tile_flag
    uint32_t count;            ///< rows in use
    uint32_t padded;           ///< count rounded up to kTilePadding
    uint32_t firstRow;         ///< row of the store
};

/// One contact of a row in its part of the step.
struct TileContact
{
    float share;        ///< [1] time of the contact as a fraction of the row's part of the step, 0..1
    float speed;        ///< [m/s] speed against the surface along its normal, just before the contact, >= 0
    glm::vec3 position; ///< [m]
    glm::vec3
        velocity;     ///< [m/s] velocity just after the contact; just before the contact if the particle dies
    bool isLast;      ///< true if the particle dies or sticks at this contact
    uint32_t number;  ///< lower bound of the number of previous contacts of the row in this step
    glm::vec3 normal; ///< [1] normal of the surface, towards the particle
};

struct TileContext;

/// Interface that receives every contact when it begins. Several threads call the listener at the same time,
/// for different tiles.
class ContactListener
{
public:
    virtual ~ContactListener() = default;
    virtual void touch(const TileContext& context, const Tile& tile, uint32_t row,
                       const TileContact& contact) = 0;
};

/// Data shared by all tiles of a step.
struct TileContext
{
    const StepContext& step;
    base::Ticks end;                     ///< local time at which the step ends
    glm::vec3 wind;                      ///< [m/s] sum of the winds of effect, host and emitter
    double begin;                        ///< [s] local time at which the step begins
    float seconds;                       ///< [s] length of the step
    ContactListener* listener = nullptr; ///< receives contacts; null: contacts are not collected
};

/// Phases of the step of a tile, in which modules run.
enum class TilePhase : uint8_t
{
    /// adds to acceleration, air velocity and drag; reads position and velocity at the beginning of the step
    Force,
    Integrate, ///< built in: moves every row over its part of the step
    Contact,   ///< corrects the path from `from` to x, y, z: collisions, kill volumes
    Event,     ///< reads flags and contacts
};

/// Upper bounds of the effect of a module on a particle.
struct TileBound
{
    float acceleration = std::numeric_limits<float>::infinity(); ///< [m/s2]
    float air = 0.0f; ///< [m/s] largest velocity that the module adds to the air
    /// true if the module accelerates particles towards the velocity of the air without linear drag
    bool followsAir = false;
};

/// A compiled module. Modules are immutable. All instances and threads share them.
class TileOp
{
public:
    virtual ~TileOp() = default;
    virtual TilePhase phase() const = 0;
    /// [byte] Size of the module's data for one step. prepare() writes the data once per step, and all tiles
    /// of the step read it. The memory is aligned to 64 bytes.
    virtual size_t scratchBytes() const { return 0; }
    virtual void prepare(const TileContext&, void* /*scratch*/) const {}
    virtual void run(const TileContext& context, const void* scratch, Tile& tile) const = 0;
    /// Upper bounds of the effect of the module; unbounded by default. From these bounds, upper bounds of the
    /// distances of particles are computed.
    virtual TileBound bound() const { return {}; }
    /// True if the tile flags Stuck or Collided must be stored after the step.
    virtual bool keepsFlags() const { return false; }
    /// True if the module depends on StepContext::collider.
    virtual bool collides() const { return false; }
};

/// Computes positions and directions of many births from uniform numbers.
class ShapeOp
{
public:
    virtual ~ShapeOp() = default;

    struct Births
    {
        /// [1] Uniform random numbers in [0, 1) for the position: four arrays with one number per birth.
        const float* place[4];
        const float* heading[4]; ///< [1]
        float* position[3];      ///< [m] output: local positions
        float* direction[3];     ///< [1] output: unit vectors
        uint32_t count;
    };
    virtual void sample(const Births& births) const = 0;
    /// [m] Upper bound of the distance of births from the origin; infinite if unknown.
    virtual float extent() const { return std::numeric_limits<float>::infinity(); }
};

} // namespace fx::sim
