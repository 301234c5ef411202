/// @file fragment_burst.h
/// Bursts of fragments for tests.
#pragma once

#include "simulation/fragments/fragments_def.h"
#include "tests/simulation/stage.h"

namespace fx::test {

/// One fragment without drag or smoke. Its initial velocity at the origin is `speed` [m/s] upwards.
inline std::unique_ptr<sim::FragmentsDef> oneFragment(float speed)
{
    auto def = std::make_unique<sim::FragmentsDef>();
    def->count = 1;
    def->originRadius = 0.0f;
    def->shape = sim::FragmentShape::Cone;
    def->angle = 0.0f;
    def->speed = {speed, speed};
    def->lifetime = {1000.0f, 1000.0f};
    def->matter.dragCoefficient = 0.0f;
    def->trail.spacing = 0.0f;
    return def;
}

/// A burst of many fragments that uses all features of the definition.
inline std::unique_ptr<sim::FragmentsDef> burst(uint32_t count)
{
    auto def = std::make_unique<sim::FragmentsDef>();
    def->count = count;
    def->start = 0.037f;
    def->position = {0.0f, 1.0f, 0.0f};
    def->shape = sim::FragmentShape::Hemisphere;
    def->lifetime = {0.5f, 3.0f};
    def->trail.maxBlobs = 60 * count;
    def->trail.lifetime = {0.3f, 0.9f};
    return def;
}

/// An effect with one burst above the ground.
inline std::shared_ptr<sim::EffectDef> grounded(std::unique_ptr<sim::FragmentsDef> def)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->hasGround = true;
    effect->solvers.push_back(std::move(def));
    return effect;
}

} // namespace fx::test
