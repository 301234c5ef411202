/// @file blocks_def.h
/// An effect of blocks: hierarchies of self-similar blocks of medium.
///
/// Only instances of blocks are simulated. What a block consists of is published once for each type and phase
/// that is in use, see foundation/snapshot/block_kind.h. The content is a function of the local time alone.
#pragma once

#include "simulation/blocks/block_turn.h"
#include "simulation/blocks/block_type.h"
#include "simulation/detail/field_detail.h"
#include "simulation/emitters/emitter_def.h"

#include <memory>
#include <string>
#include <vector>

namespace fx::sim {

struct BlocksDef final : SolverDef
{
    std::string name;
    std::vector<BlockType> types; ///< complete, see completeTypes()

    // The blocks of the effect: either `blocks`, or an emitter.
    std::vector<BlockPlacement> blocks;
    /// A medium, each particle of which is a block. The radius of the particle is the radius of the block,
    /// its optical depth the factor of the block's density.
    std::shared_ptr<const EmitterDef> emitter;
    std::vector<uint32_t> emitted; ///< types of the emitter's blocks, of which each block has one at random
    BlockTurn turn = BlockTurn::Upright;

    uint32_t maxParticles = 1u << 18; ///< largest number of balls that a snapshot expands to
    float density = 1.0f;             ///< [1] factor of optical depths
    float anisotropy = 0.0f;          ///< [1] mean cosine of the scattering angle
    float fireShare = 0.0f;           ///< [1] part of static balls accounted to the fire layer
    base::MediaLayer layer = base::MediaLayer::Smoke;
    /// Of the field of all balls. Where blocks come from an emitter, it has the same detail.
    FieldDetail detail;

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    /// Largest number of balls of one snapshot.
    uint32_t capacity() const override;
    uint64_t bytes() const override;
    double workOf(const StepLoad& load) const override;
    bool publishes(const base::KindDesc& kind) const override;
    Influence influence() const override { return emitter ? emitter->influence() : Influence{}; }
    CatchUp catchUp() const override { return emitter ? emitter->catchUp() : CatchUp::Analytic; }
    bool collides() const override { return emitter && emitter->collides(); }
    bool dependsOnPlacement() const override { return emitter && emitter->dependsOnPlacement(); }
    bool followsThermals() const override { return emitter && emitter->followsThermals(); }
    float reach(float gravity, float wind, float seconds) const override;

    /// True if the content of a type changes with time.
    bool isAnimated() const;
    /// [byte] Memory of the lists and loops that all instances share.
    uint64_t sharedBytes() const;
    /// Largest number of balls of all blocks, without the limit maxParticles.
    uint64_t expandedCount() const;
    /// [m] Mean radius of the balls of all blocks, by their cross section; blocks of an emitter have the mean
    /// radius of its particles.
    float ballRadius() const;
    uint64_t hash() const; ///< of the types and of the list of blocks
};

} // namespace fx::sim
