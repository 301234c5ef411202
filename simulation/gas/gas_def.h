/// @file gas_def.h
/// Definition of one explosion of gas: material, energy, motion and appearance.
#pragma once

#include "foundation/math/curve.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/material_kind.h"
#include "simulation/combustion/materials.h"
#include "simulation/detail/field_detail.h"
#include "simulation/solver/solver.h"

#include <glm/vec3.hpp>

#include <string>

namespace fx::sim {

/// A charge released at local time `start`. Mass, size, temperature, pressure, soot and duration follow from
/// the material and the energy, see charge_plan.h.
struct GasDef final : SolverDef
{
    std::string name;
    uint32_t particles = 400;                          ///< number of particles at medium quality, 8 .. 20000
    glm::vec3 position{0.0f};                          ///< [m] center of the initial ball
    float start = 0.0f;                                ///< [s]
    const Material* material = findMaterial("petrol"); ///< never null
    double energy = 20e6;                              ///< [J] > 0
    /// [1] Initial pressure divided by the pressure of the air, 1..100; for charges that detonate.
    float pressureRatio = 12.0f;
    /// [m/s] Upper limit of the speed of sound; 0: no limit. Without a limit, steps are shorter and the blast
    /// wave is realistic.
    float soundSpeed = 60.0f;
    /// [1] Random initial displacement in units of the particle spacing. Instabilities grow from this
    /// displacement.
    float jitter = 0.15f;
    float lumpiness = 0.3f;      ///< [1] 0 .. 1, strength of the large jets of the release
    float throwSpeed = 1.0f;     ///< [1] factor on the initial speed of the material
    glm::vec3 initialBias{0.0f}; ///< [m/s] velocity added to every particle
    float entrainment = 1.0f;    ///< [1] factor on the entrainment of air while the gas burns
    float radiation = 1.0f;      ///< [1] factor on the heat loss by radiation
    float drag = 0.35f;          ///< [1/s] rate of momentum exchange with the air
    float braking = 0.3f;        ///< [1] factor on the momentum lost to displaced air
    float buoyancy = 1.0f;       ///< [1] multiple of the buoyancy force
    float rolling = 1.0f;        ///< [1] 0 .. 1, strength of the vortex-ring circulation of the rising cloud
    float curlStrength = 2.5f;   ///< [m/s] speed of the turbulence at lengths below the size of particles
    float curlScale = 2.0f;      ///< [m]
    float viscosity = 1.0f;      ///< [1] largest coefficient alpha of the artificial viscosity, 0 .. 4

    // optics
    float opacity = 1.0f; ///< [1] factor on the extinction by soot and salts
    /// Factor on the albedo of soot and salts, as a function of the burnt fraction 0..1.
    base::ColorCurve smokeTint{std::array{1.0f, 1.0f, 1.0f}};
    /// [K] temperature below which soot counts as smoke in the layers of the picture
    float sootTemperature = 1100.0f;
    float growth = 1.4f;       ///< [1] radius of a blob divided by half the kernel's support
    float heat = 1.0f;         ///< see EmitterDef
    float dissipation = 0.12f; ///< [1/s] rate at which cold smoke becomes thinner
    float detailAmount = 0.8f;
    float detailScale = 1.5f;
    float anisotropy = 0.3f;
    FieldDetail detail;

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return particles; }
    uint64_t bytes() const override;
    double workOf(const StepLoad& load) const override;
    bool publishes(const base::KindDesc& kind) const override
    {
        return kind == base::kBlobKind || (detail.given && kind == base::kMaterialKind);
    }
    bool bendsLight() const override { return heat > 0.0f; }
    bool collides() const override { return true; }
    CatchUp catchUp() const override { return CatchUp::Authoritative; }
};

} // namespace fx::sim
