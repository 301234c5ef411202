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

/// Reads shape, position, size and related members of `element`. Simple shapes are stored in
/// EmitterDef::shape and related members, all other shapes in EmitterDef::births.
void readEmitterShape(const PresetValue& element, sim::EmitterDef& emitter);
/// Reads rate, bursts and related members.
void readEmitterEmission(const PresetValue& emission, sim::Emission& out);
/// Reads forces and collisions. Modules are in the order gusts, drag, vortices, attractors, fields, surfaces,
/// obstacles.
void readEmitterForces(const PresetValue& element, sim::EmitterDef& emitter);
/// Reads the member "appearance".
void readEmitterAppearance(const PresetValue& appearance, sim::EmitterAppearance& out);
/// Reads the member "trail".
void readEmitterTrail(const PresetValue& trail, sim::RibbonDef& out);
/// Reads the member "light".
void readEmitterLight(const PresetValue& element, sim::LightDef& out);

/// Reads the events of all emitters of the preset `root` and sorts the solvers so that causes precede their
/// effects. The emitters are the first solvers of `effect`. Adds findings for unknown names of emitters, for
/// cycles, and for emitters without any births.
void linkEmitterEvents(const PresetValue& root, sim::EffectDef& effect);

// Lint warnings: members that are valid and have no effect, or cost more than expected.
void lintForces(const PresetValue& element, bool hasGround);
void lintShape(const PresetValue& element);
void lintAppearance(const PresetValue& element, const sim::EmitterDef& emitter);

/// Warns if the particles of an emitter, including births by events, exceed its capacity, and if memory
/// exceeds 1 GiB.
void lintCapacity(const PresetValue& root, const sim::EffectDef& effect);

/// Warns that collisions with the depth texture of a view (shape "depth") have no effect when the CPU
/// computes the emitter. The warning states why the CPU computes the emitter.
/// @param root the preset; the first solvers of `effect` are its emitters, linked by their events
void warnOfDepthOnCpu(const PresetValue& root, const sim::EffectDef& effect);

// Read an asset that the member names. Return null and add a finding on failure.
std::shared_ptr<const sim::FieldGrid> readGrid(const PresetValue& value, const char* member,
                                               uint32_t channels);
/// Reads the distance field of the mesh `file` with cells of size `cellSize`.
std::shared_ptr<const sim::DistanceField> readMeshField(const PresetValue& value);

} // namespace fx::preset
