/// @file gas_def.h
/// What a preset says about one body of hot gas simulated with smoothed particle hydrodynamics.
#pragma once

#include "foundation/math/curve.h"
#include "simulation/solver.h"

#include <glm/vec3.hpp>

#include <string>

namespace fx::sim {

/// A ball of hot gas released at rest at local time `start`, that expands against the air, mixes, cools and
/// rises.
struct GasDef final : SolverDef
{
    std::string name;
    uint32_t particles = 400;    ///< 8 .. 20000
    glm::vec3 position{0.0f};    ///< [m] center of the initial ball
    float start = 0.0f;          ///< [s]
    float radius = 1.0f;         ///< [m] of the initial ball, > 0
    float temperature = 2400.0f; ///< [K] at the start, 300 .. 5000
    float pressureRatio = 12.0f; ///< [1] initial pressure over the air's, 1 .. 100
    float soundSpeed =
        28.0f;            ///< [m/s] of the reduced-sound-speed gas: how fast pressure differences even out
    float jitter = 0.15f; ///< [1] of the particle spacing: seeds the instabilities
    float initialSpeed = 0.0f;   ///< [m/s] radial speed at the rim of the ball
    glm::vec3 initialBias{0.0f}; ///< [m/s] added to every particle
    float cooling = 0.6f;        ///< [1/s] rate of approach to the air's temperature by mixing
    float radiation = 0.35f;     ///< [1/s] rate of radiative loss at the initial temperature (as T^4)
    float drag = 0.35f;          ///< [1/s] momentum shared with the air
    float braking = 1.4f;        ///< [1/m] momentum lost to the air pushed aside, per metre of way through it
    float buoyancy = 1.0f;       ///< [1] multiple of Archimedes' force
    float rolling = 1.0f;        ///< [1] 0 .. 1, how much the rising cloud turns over like a vortex ring
    float curlStrength = 2.5f;   ///< [m/s] turbulence below the particles' size
    float curlScale = 2.0f;      ///< [m]
    float viscosity = 1.0f;      ///< [1] Monaghan alpha, 0 .. 4

    // optics
    float sootYield = 1.4f;    ///< [m2] cross section of a particle when all its soot has formed
    float opticalDepth = 2.5f; ///< [1] through a particle's center at the start
    base::ColorCurve albedoOverSoot{
        std::array{0.35f, 0.33f, 0.3f}}; ///< single scattering albedo, t = soot formed
    float sootTemperature = 1100.0f;     ///< [K] below which soot no longer burns: fire turns to smoke there
    float growth = 1.6f;                 ///< [1] radius of a blob over the smoothing length
    float heat = 1.0f;                   ///< see EmitterDef
    float dissipation = 0.12f;           ///< [1/s] rate at which cold smoke thins out
    float detailAmount = 0.8f;
    float detailScale = 1.5f;
    float anisotropy = 0.3f;

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return particles; }
};

} // namespace fx::sim
