/// @file emitter_technique.h
/// The preset member "emitters" (emitters.schema.json).
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/gpu_particles.h"
#include "foundation/snapshot/material_kind.h"
#include "foundation/snapshot/particle_kind.h"
#include "fxsdk/presets/technique.h"

namespace fx::preset {

std::string_view emitterSchema();

/// Adds the emitter that `element` describes to `effect`. For faults that the schema cannot exclude, findings
/// are added instead of an emitter.
void buildEmitter(const PresetValue& element, sim::EffectDef& effect);

/// Links emitters by their events. Warns of collisions with the depth texture that the CPU cannot compute.
void linkEmitters(const PresetValue& root, sim::EffectDef& effect);

/// Warns of members without effect and of capacities that are too small.
void lintEmitters(const PresetValue& root, const sim::EffectDef& effect);

/// Estimates births, including births caused by events.
void estimateEmitters(const PresetValue& root, const sim::EffectDef& effect, std::span<SolverCost> ioCosts);

inline constexpr const base::KindDesc* kEmitterKinds[] = {&base::kBlobKind,     &base::kMaterialKind,
                                                          &base::kParticleKind, &base::kGpuParticleKind,
                                                          &base::kRibbonKind,   &base::kLightKind};

inline constexpr Technique kEmitterTechnique{
    .name = "emitters",
    .presetMember = "emitters",
    .schema = emitterSchema,
    .build = buildEmitter,
    .link = linkEmitters,
    .lint = lintEmitters,
    .estimate = estimateEmitters,
    .kinds = kEmitterKinds,
};

} // namespace fx::preset
