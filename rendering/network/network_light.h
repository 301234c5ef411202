/// @file network_light.h
/// Computes the unscattered light of the sun and of lamps in the cells of a network. The light is traced
/// along rays through the grid.
#pragma once

#include "rendering/network/scattering_network.h"

namespace fx::render {

/// A source of parallel light.
struct NetworkSun
{
    glm::dvec3 travel{0.0, -1.0, 0.0}; ///< unit vector, direction in which the light travels
    double illuminance = 0.0;          ///< [lx] illuminance of a surface perpendicular to the light
};

/// A ball light, which may be inside of the medium. Far from the ball, it illuminates like a point light.
/// Inside of the ball, the irradiance is finite.
struct NetworkLamp
{
    glm::dvec3 position{0.0}; ///< [m]
    /// [m] radius of the ball; medium inside of the ball does not attenuate its light.
    double radius = 0.0;
    double intensity = 0.0; ///< [cd]
};

/// Adds the light of a sun to a network.
/// @param samples number of samples along each axis of a cell, 1..8; the cell gets the mean of the samples
void addSun(ScatteringNetwork& io, const NetworkSun& sun, int samples, base::TaskRunner& tasks);

/// Adds the light of a lamp. The light varies most near the lamp. Therefore the cell that contains the lamp
/// and the neighboring cells are sampled with at least kNearLampSamples samples along each axis.
void addLamp(ScatteringNetwork& io, const NetworkLamp& lamp, int samples, base::TaskRunner& tasks);
constexpr int kNearLampSamples = 12;

} // namespace fx::render
