/// @file blocks_technique.h
/// The preset member "blocks" (blocks.schema.json).
#pragma once

#include "foundation/snapshot/block_kind.h"
#include "fxsdk/presets/technique.h"

namespace fx::preset {

std::string_view blocksSchema();

/// Adds the blocks that `element` describes to `effect`, or findings about them.
void buildBlocks(const PresetValue& element, sim::EffectDef& effect);

/// Warns of blocks that expand to more balls than maxParticles, and of types that no block has.
void lintBlocks(const PresetValue& root, const sim::EffectDef& effect);

/// Estimates the births of blocks.
void estimateBlocks(const PresetValue& root, const sim::EffectDef& effect, std::span<SolverCost> ioCosts);

inline constexpr const base::KindDesc* kBlocksKinds[] = {&base::kBlobKind, &base::kBlockKind,
                                                         &base::kBlockBallKind, &base::kBlockMaterialKind,
                                                         &base::kMaterialKind};

inline constexpr Technique kBlocksTechnique{
    .name = "blocks",
    .presetMember = "blocks",
    .schema = blocksSchema,
    .build = buildBlocks,
    .lint = lintBlocks,
    .estimate = estimateBlocks,
    .kinds = kBlocksKinds,
};

} // namespace fx::preset
