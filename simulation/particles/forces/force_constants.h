/// @file force_constants.h
/// Constants derived from the definition of a force, shared by the CPU kernel and the GPU module.
#pragma once

#include "simulation/particles/forces/force_defs.h"

#include <algorithm>
#include <limits>

namespace fx::sim {

/// Constants of formula attraction.
struct AttractorConstants
{
    explicit AttractorConstants(const AttractorDef& def)
        : softening(std::max(def.softening * def.softening, 1e-12f)),
          reach(def.reach > 0.0f ? def.reach * def.reach : std::numeric_limits<float>::max())
    {
        const float s = def.strength, r = def.radius;
        const float factors[] = {s / r, s, s * r, s * r * r}; // in the order of Falloff
        factor = factors[size_t(def.falloff)];
    }

    float softening; ///< [m2] square of e
    float reach;     ///< [m2] square of AttractorDef::reach
    float factor;    ///< product S R^n
};

/// Constants of formula vortex-air.
struct VortexConstants
{
    explicit VortexConstants(const VortexDef& def)
        : squared(def.radius * def.radius), around(2.0f * def.radius * def.speed),
          inwards(2.0f * def.radius * def.pull), along(def.radius * def.radius * def.lift)
    {}

    float squared; ///< [m2] R^2
    float around;  ///< [m2/s] 2 R S
    float inwards; ///< [m2/s] 2 R P
    float along;   ///< [m3/s] R^2 U
};

/// Placement of the grid of a vector field, for formula trilinear-vectors.
struct VectorFieldConstants
{
    explicit VectorFieldConstants(const VectorFieldDef& def)
        : low(def.position + def.scale * def.grid->low),
          perCell(glm::vec3(1.0f) / (def.scale * def.grid->cell))
    {}

    glm::vec3 low;     ///< [m] position of the first node
    glm::vec3 perCell; ///< [1/m]
};

} // namespace fx::sim
