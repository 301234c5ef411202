/// @file block_parts_preset.h
/// Parts of the reader of a preset's "blocks". Each reader adds findings for faults that the schema cannot
/// exclude, and omits the faulty part.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/blocks/blocks_def.h"

#include <memory>
#include <span>
#include <vector>

namespace fx::preset {

/// Reads the types of `element` and completes them.
void readBlockTypes(const PresetValue& element, std::vector<sim::BlockType>& out);

/// Reads the member "blocks" of `element`.
void readBlockList(const PresetValue& element, std::span<const sim::BlockType> types,
                   std::vector<sim::BlockPlacement>& out);

/// Reads the member "builder" of `element`, which has the member "of", as blocks.
void readBuiltBlocks(const PresetValue& element, std::span<const sim::BlockType> types,
                     std::vector<sim::BlockPlacement>& out);

/// Reads the member "of" of `element` as indices of types.
std::vector<uint32_t> readBlockNames(const PresetValue& element, std::span<const sim::BlockType> types);

sim::BlockTurn readBlockTurn(const PresetValue& element);

/// Reads the member "emitter" of `element`, a medium without events, trails, lights and detail.
/// @param detail which it gets
/// @return null with a finding for another emitter
std::shared_ptr<const sim::EmitterDef> readBlockEmitter(const PresetValue& element,
                                                        const sim::FieldDetail& detail = {});

} // namespace fx::preset
