/// @file tile.h
/// Working set of an emitter's modules: a tile of particles whose columns fit into the L1 cache.
///
/// An emitter whose motion has no closed form is stepped tile by tile. A tile is loaded from the store, all
/// modules process it in order of phase, and it is stored. Memory is therefore read and written once, for any
/// number of modules. Rows without a living particle are loaded too: they have seconds 0 and the flag Empty,
/// and their results are discarded. Arithmetic consists of multiplications and additions in a fixed order (no
/// fused multiply-add, no sums across rows), so every vector width gives the same bits.
///
/// Threads: several threads process tiles of one step at once; modules keep no mutable state.
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

/// Bits of Tile::flags. Stuck and Collided are kept from step to step; the others are set for one step.
namespace tile_flag {
enum : uint32_t
{
    Stuck = 1,    ///< at rest permanently
    Collided = 2, ///< the particle has had a contact during its life
    Empty = 4,    ///< no particle lives here
    Hit = 8,      ///< the particle has a contact in this step, at the share `contact` of its path
    Killed = 16,  ///< a module has killed the particle in this step, at the share `contact` of its path
};
}

/// Working columns of a tile of particles. Arrays begin at multiples of 64 bytes; rows [count, kTileRows)
/// hold finite numbers.
struct alignas(64) Tile
{
    /// [m] local position: before TilePhase::Integrate at the begin of the step, afterwards at its end
    float x[kTileRows];
    float y[kTileRows];
    float z[kTileRows];
    float vx[kTileRows]; ///< [m/s] velocity
    float vy[kTileRows];
    float vz[kTileRows];
    float fromX[kTileRows]; ///< [m] position at the begin of the row's part of the step
    float fromY[kTileRows];
    float fromZ[kTileRows];
    float fromVX[kTileRows]; ///< [m/s] velocity at the begin of the row's part of the step
    float fromVY[kTileRows];
    float fromVZ[kTileRows];
    float ax[kTileRows]; ///< [m/s2] sum of accelerations; forces add to it
    float ay[kTileRows];
    float az[kTileRows];
    float ux[kTileRows]; ///< [m/s] velocity of the air; forces add to it
    float uy[kTileRows];
    float uz[kTileRows];
    float drag[kTileRows]; ///< [1/s] rate of linear drag towards the air, >= 0; forces add to it
    /// [1/m] coefficient q of quadratic drag, >= 0: acceleration -q |v - u| (v - u); forces add to it
    float quadratic[kTileRows];
    /// [s] age at the begin of the row's part of the step; 0 for a row born within the step
    float age[kTileRows];
    /// [s] length of the row's part of the step; shorter for a row born within the step, 0 if Empty
    float seconds[kTileRows];
    float life[kTileRows];   ///< [1] age / lifetime at the begin of the row's part of the step, 0..1
    float excess[kTileRows]; ///< [K] temperature above that of the air
    /// [1] time of the contact as a share of the row's part of the step, 0..1; set together with Hit or
    /// Killed
    float contact[kTileRows];
    uint32_t indexLow[kTileRows]; ///< birth index; it forms the counter words 0 and 1 of base::philox
    uint32_t indexHigh[kTileRows];
    uint32_t flags[kTileRows]; ///< tile_flag
    uint32_t count;            ///< rows in use
    uint32_t padded;           ///< count rounded up to kTilePadding
    uint32_t firstRow;         ///< row of the store
};

/// One contact of a row in its part of the step.
struct TileContact
{
    float share;        ///< [1] time of the contact as a share of the row's part of the step, 0..1
    float speed;        ///< [m/s] speed against the surface along its normal, just before the contact, >= 0
    glm::vec3 position; ///< [m]
    glm::vec3 velocity; ///< [m/s] velocity just after the contact; of killed particles, just before it
    bool isLast;        ///< true if the particle dies or sticks at this contact
    uint32_t number;    ///< lower bound of the number of previous contacts of the row in this step
};

struct TileContext;

/// Interface that receives every contact when it begins. It is called by several threads at once, for
/// different tiles.
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
    float seconds;                       ///< [s] its length
    ContactListener* listener = nullptr; ///< receives contacts; null: contacts are not collected
};

/// Phases of the step of a tile, in which modules run.
enum class TilePhase : uint8_t
{
    /// adds to acceleration, air velocity and drag; reads position and velocity at the begin of the step
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
    /// true if the module accelerates particles towards the air's velocity by something other than linear
    /// drag
    bool followsAir = false;
};

/// A compiled module. It is immutable and shared by all instances and threads.
class TileOp
{
public:
    virtual ~TileOp() = default;
    virtual TilePhase phase() const = 0;
    /// [byte] Size of the memory that prepare() fills once a step and that all tiles of the step read. It is
    /// aligned to 64 bytes.
    virtual size_t scratchBytes() const { return 0; }
    virtual void prepare(const TileContext&, void* /*scratch*/) const {}
    virtual void run(const TileContext& context, const void* scratch, Tile& tile) const = 0;
    /// Upper bounds of the effect of the module, from which distances of particles are bounded; unbounded by
    /// default.
    virtual TileBound bound() const { return {}; }
    /// Whether the tile flags Stuck or Collided must be kept after the step.
    virtual bool keepsFlags() const { return false; }
    /// Whether the module depends on StepContext::collider.
    virtual bool collides() const { return false; }
};

/// Computes positions and directions of many births from uniform numbers.
class ShapeOp
{
public:
    virtual ~ShapeOp() = default;

    struct Births
    {
        /// [1] uniform random numbers in [0, 1) for the position, four per birth in one array each
        const float* place[4];
        const float* heading[4]; ///< [1]
        float* position[3];      ///< [m] out, local
        float* direction[3];     ///< [1] out, unit vectors
        uint32_t count;
    };
    virtual void sample(const Births& births) const = 0;
    /// [m] Upper bound of the distance of births from the origin; infinite when unknown.
    virtual float extent() const { return std::numeric_limits<float>::infinity(); }
};

} // namespace fx::sim
