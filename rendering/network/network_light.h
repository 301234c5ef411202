/// @file network_light.h
/// Light that reaches the cells of a network before it is scattered: sun and lamps, by rays through the grid.
#pragma once

#include "rendering/network/scattering_network.h"

namespace fx::render {

/// A source so far away that its light is parallel.
struct NetworkSun
{
    glm::dvec3 travel{0.0, -1.0, 0.0}; ///< unit, the way the light goes
    double illuminance = 0.0;          ///< [lx] on a surface that faces it
};

/// A glow that shines to all sides, anywhere, also in the medium: as bright as a point, finite inside.
struct NetworkLamp
{
    glm::dvec3 position{0.0}; ///< [m]
    double radius = 0.0;      ///< [m] extent of the glow, within which nothing blocks it
    double intensity = 0.0;   ///< [cd]
};

/// Adds the light of a sun to a network.
/// @param samples along each axis of a cell, of which the mean is taken, 1..8
void addSun(ScatteringNetwork& io, const NetworkSun& sun, int samples, base::TaskRunner& tasks);

/// Adds the light of a lamp. Cells that touch its own take kNearLampSamples along each axis at least: there
/// its light changes most.
void addLamp(ScatteringNetwork& io, const NetworkLamp& lamp, int samples, base::TaskRunner& tasks);
constexpr int kNearLampSamples = 12;

} // namespace fx::render
