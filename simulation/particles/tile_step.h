/// @file tile_step.h
/// Steps particles whose motion has no closed form: loads them into a tile, runs all modules on it, and
/// stores it.
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
/// each contact while the modules run. It is called by several threads at once.
class TileWatch : public ContactListener
{
public:
    virtual void see(const TileContext& context, const Tile& tile, const ParticleStore& store) = 0;
};

/// One step of one emitter. Rows may be stepped by several threads at once.
class TileStep
{
public:
    /// Prepares a step: calls prepare() of all modules.
    TileStep(const ParticleProgram& program, const StepContext& step);

    /// Steps those rows in [begin, end) of `store` that are in its window. `begin` is a multiple of
    /// kTilePadding.
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
