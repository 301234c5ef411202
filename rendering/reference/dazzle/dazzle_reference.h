/// @file dazzle_reference.h
/// The dazzle on the CPU, in 128-bit integers: the reference of the GPU programs, and the implementation
/// without a GPU. Equal to DazzlePass bit for bit, for every sensor law.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <span>
#include <vector>

namespace fx::render {

/// @param rgba     width * height pixels of four floats, row by row
/// @param settings accepted by checkSensorLaw()
/// @param ioHistory as the history buffer of DazzlePass
/// @return the picture after the dazzle; empty for an empty one, whose history does not change
std::vector<float> dazzleReference(std::span<const float> rgba, int width, int height,
                                   const DazzleSettings& settings, double deltaTime, bool resetHistory,
                                   DazzleHistory& ioHistory);

/// Glare per overflow, formula sensor-law (1), in operations that every processor and GPU rounds alike.
/// @param over mean overflow per pixel in units of white, >= 0
double dazzleGain(double over, const DazzleSettings& settings);

} // namespace fx::render
