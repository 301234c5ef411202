/// @file gas_cloud.h
/// Fireballs for the tests of the gas solver, and averages over a fireball.
#pragma once

#include "simulation/combustion/materials.h"
#include "simulation/gas/gas_def.h"
#include "tests/simulation/stage.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <memory>

namespace fx::test {

/// A charge of 16 MJ of TNT (about 4 kg), high above the ground.
inline std::unique_ptr<sim::GasDef> fireball(uint32_t particles = 200)
{
    auto def = std::make_unique<sim::GasDef>();
    def->material = sim::findMaterial("tnt");
    def->energy = 16e6;
    def->particles = particles;
    def->position = {0, 20, 0};
    return def;
}

/// A gas without forces other than pressure and viscosity.
inline std::unique_ptr<sim::GasDef> pureGas(uint32_t particles)
{
    auto def = fireball(particles);
    def->drag = def->braking = def->buoyancy = def->rolling = def->curlStrength = 0.0f;
    def->entrainment = def->radiation = def->lumpiness = 0.0f;
    return def;
}

/// Averages over the gas.
struct CloudShape
{
    explicit CloudShape(const base::SnapshotGroup& group)
    {
        const double count = group.count();
        for (uint32_t i = 0; i < group.count(); ++i) {
            center += glm::dvec3(row(group, base::blob_column::PositionX, i)) / count;
            momentum += glm::dvec3(row(group, base::blob_column::VelocityX, i));
            meanSpeed += double(glm::length(row(group, base::blob_column::VelocityX, i))) / count;
            temperature += double(group.column(base::blob_column::Temperature)[i]) / count;
        }
        for (uint32_t i = 0; i < group.count(); ++i) {
            const glm::dvec3 away = glm::dvec3(row(group, base::blob_column::PositionX, i)) - center;
            radius += glm::dot(away, away) / count;
        }
        radius = std::sqrt(radius * 5.0 / 3.0); // of a uniform ball
    }
    static glm::vec3 row(const base::SnapshotGroup& group, size_t column, uint32_t i)
    {
        return {group.column(column)[i], group.column(column + 1)[i], group.column(column + 2)[i]};
    }

    glm::dvec3 center{0.0};
    glm::dvec3 momentum{0.0}; ///< momentum divided by the mass of a particle
    double meanSpeed = 0;
    double temperature = 0;
    double radius = 0;
};

inline CloudShape shapeOf(Stage& stage)
{
    return CloudShape(stage.look().group(0));
}

} // namespace fx::test
