/// @file emitter_parts_preset.h
/// Reads the parts of one element of a preset's "emitters". Each adds findings for faults that the schema
/// cannot exclude, and omits the faulty part from the emitter.
#pragma once

#include "fxsdk/presets/preset_value.h"
#include "simulation/collision/distance_field.h"
#include "simulation/emitters/emitter_def.h"
#include "simulation/particles/fields/field_grid.h"

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

// Assets that members name; null after a finding.
std::shared_ptr<const sim::FieldGrid> readGrid(const PresetValue& value, const char* member,
                                               uint32_t channels);
/// Distances to the mesh of `file`, in cells of `cellSize`.
std::shared_ptr<const sim::DistanceField> readMeshField(const PresetValue& value);

} // namespace fx::preset
