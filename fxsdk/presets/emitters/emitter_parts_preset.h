/// @file emitter_parts_preset.h
/// Parts of the reader of a preset's "emitters", and their lint warnings. Each reader adds findings for
/// faults that the schema cannot exclude, and omits the faulty part from the emitter.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/collision/distance_field.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/fields/field_grid.h"
#include "simulation/solver/effect_def.h"

#include <memory>

namespace fx::preset {

/// shape, position, size, ...: EmitterDef::shape and related members, or EmitterDef::births for other shapes.
void readEmitterShape(const PresetValue& element, sim::EmitterDef& emitter);
/// rate, bursts, ...
void readEmitterEmission(const PresetValue& emission, sim::Emission& out);
/// forces and collisions; modules in the order gusts, drag, vortices, attractors, fields, surfaces,
/// obstacles.
void readEmitterForces(const PresetValue& element, sim::EmitterDef& emitter);
/// appearance
void readEmitterAppearance(const PresetValue& appearance, sim::EmitterAppearance& out);
/// trail
void readEmitterTrail(const PresetValue& trail, sim::RibbonDef& out);
/// light
void readEmitterLight(const PresetValue& element, sim::LightDef& out);

/// Reads the events of all emitters of the preset `root`, which `effect` holds as its first solvers, and puts
/// the solvers in order. Adds findings for names that no emitter has, for circles, and for emitters in which
/// nothing would ever be born.
void linkEmitterEvents(const PresetValue& root, sim::EffectDef& effect);

// Lint warnings: members that are valid and have no effect, or cost more than expected.
void lintForces(const PresetValue& element, bool hasGround);
void lintShape(const PresetValue& element);
void lintAppearance(const PresetValue& element, const sim::EmitterDef& emitter);

/// Warns of emitters whose particles, including births by events, exceed the capacity, and of memory above 1
/// GiB.
void lintCapacity(const PresetValue& root, const sim::EffectDef& effect);

/// Warns that collisions with the depth texture of a view (shape "depth") have no effect when the CPU
/// computes the emitter, with the reason for the CPU.
/// @param root the preset; the first solvers of `effect` are its emitters, linked by their events
void warnOfDepthOnCpu(const PresetValue& root, const sim::EffectDef& effect);

// Assets that members name; null after a finding.
std::shared_ptr<const sim::FieldGrid> readGrid(const PresetValue& value, const char* member,
                                               uint32_t channels);
/// Distances to the mesh of `file`, in cells of `cellSize`.
std::shared_ptr<const sim::DistanceField> readMeshField(const PresetValue& value);

} // namespace fx::preset
