/// @file preview_def.h
/// How the author of an effect shows it: light, exposure and camera.
#pragma once

#include <glm/vec3.hpp>

namespace fx::sim {

/// The simulation does not depend on it. The defaults are open country late in the afternoon.
struct PreviewDef
{
    double seconds = 0.5; ///< [s] local time of a still
    float exposureEv100 = 13.0f;
    glm::vec3 sunDirection{0.632978916f, 0.57543534f, 0.517891824f}; ///< unit vector towards the sun
    glm::vec3 sunIlluminance{40000.0f, 34500.0f, 27000.0f};          ///< [lx] perpendicular to the direction
    glm::vec3 skyLuminance{2500.0f, 3150.0f, 4200.0f};               ///< [cd/m2]
    float groundAlbedo = 0.2f;                                       ///< [1]
    bool hasCamera = false;                                      ///< false: the author leaves it to the tool
    glm::dvec3 cameraPosition{0.0, 0.0, 1.0}, cameraTarget{0.0}; ///< [m] relative to the instance
    float fovYDegrees = 50.0f;
};

} // namespace fx::sim
