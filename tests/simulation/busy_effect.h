/// @file busy_effect.h
/// An effect that uses every part of the simulation, for tests of general properties.
#pragma once

#include "simulation/gas/gas_def.h"
#include "tests/simulation/stage.h"

namespace fx::test {

/// Creates an effect with all kinds of solvers.
/// @param particles capacity of each solver
/// @param detailed true: media have material coordinates
inline std::shared_ptr<sim::EffectDef> busyEffect(uint32_t particles, bool detailed = false)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->wind = {1, 0, 0.5f};
    auto gas = std::make_unique<sim::GasDef>();
    gas->particles = particles / 4;
    gas->position = {0, 1, 0};
    gas->detail.given = detailed;
    effect->solvers.push_back(std::move(gas));

    auto sparks = rateEmitter(float(particles), 0.8f);
    sparks->maxParticles = particles;
    sparks->emission.bursts = {{0.0f, particles / 2}, {0.4f, particles / 3}};
    sparks->shape = sim::EmitterShape::Sphere;
    sparks->size = {0.5f, 0, 0};
    sparks->detail.given = detailed;
    sparks->speed = {1, 12};
    sparks->temperature = {800, 1800};
    sparks->forces = {1.0f, 0.8f, 0.1f, {0, 0, 0}, 2.0f, 1.0f, 0.3f, 0.4f, 0.2f};
    effect->solvers.push_back(std::move(sparks));
    return effect;
}

} // namespace fx::test
