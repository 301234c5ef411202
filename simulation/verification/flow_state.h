/// @file flow_state.h
/// State of a gas at a point.
#pragma once

namespace fx::sim {

struct FlowState
{
    double density = 0;  ///< [kg/m3]
    double velocity = 0; ///< [m/s] velocity along the x axis in planar flow; outward velocity in radial flow
    double pressure = 0; ///< [Pa]
};

} // namespace fx::sim
