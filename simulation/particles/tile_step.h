/// @file tile_step.h
/// Steps particles whose motion has no closed form. The particles are loaded into a tile, all modules process
/// the tile, and the tile is stored.
#pragma once

#include "simulation/particles/particle_store.h"

#include <span>

namespace fx::sim {

/// A module of an emitter with its prepared data for this step.
struct PreparedOp
{
    const TileOp* op;
    const void* scratch;
};

/// Interface that is called for each tile after its modules have run and before the tile is stored, and for
/// each contact while the modules run. Several threads call the interface at the same time.
class TileWatch : public ContactListener
{
public:
    virtual void see(const TileContext& context, const Tile& tile, const ParticleStore& store) = 0;
};

/// One step of one emitter. Several threads may step rows at the same time.
class TileStep
{
public:
    /// Prepares a step: calls prepare() of all modules.
    TileStep(const ParticleProgram& program, const StepContext& step);

    /// Steps the rows of `store` that are in [begin, end) and in the window of the store. `begin` must be a
    /// multiple of kTilePadding.
    void run(ParticleStore& store, uint32_t begin, uint32_t end) const;

    /// Restricts the step to particles whose index is at least `first`.
    void onlyFrom(uint64_t first) { first_ = first; }
    void watchBy(TileWatch* watch)
    {
        watch_ = watch;
        context_.listener = watch;
    }

private:
    void load(const ParticleStore& store, uint32_t row, Tile& tile) const;
    void save(const Tile& tile, ParticleStore& store) const;

    const ParticleProgram& program_;
    TileContext context_;
    std::span<PreparedOp> ops_;
    uint64_t first_ = 0;
    TileWatch* watch_ = nullptr;
};

} // namespace fx::sim
