/// @file placement.h
/// Checks and conversion of placements that the host states.
#pragma once

#include "fxsdk/api/check.h"
#include "fxsdk/api/host_world.h"

#include <glm/gtc/quaternion.hpp>

namespace fx::api {

constexpr double kFarthest = 1e9;       ///< [m]
constexpr float kSmallestScale = 1e-3f; ///< [1]
constexpr float kLargestScale = 1e3f;   ///< [1]

/// @param farthest largest coordinate, in units of the host
inline void checkPlacement(Checks& check, double farthest, const double* position, const float* rotation,
                           float scale)
{
    check.range3(position, -farthest, farthest, "position");
    check.that(isUnitQuaternion(rotation),
               "rotation is not a unit quaternion (x, y, z, w); 0, 0, 0, 1 turns nothing");
    check.range(scale, kSmallestScale, kLargestScale, "scale");
}

inline base::Placement toPlacement(const HostWorld& world, const double* position, const float* rotation,
                                   float scale)
{
    if (world.isLibraryWorld()) // saves the conversion where many instances move
        return {{position[0], position[1], position[2]},
                glm::normalize(glm::quat(rotation[3], rotation[0], rotation[1], rotation[2])),
                scale};
    return {world.position(position), glm::normalize(world.rotation(rotation)), scale};
}

} // namespace fx::api
