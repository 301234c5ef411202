/// @file dazzle_reference.h
/// The glare computed on the CPU, with 128-bit integers. It equals DazzlePass bit for bit, for every sensor
/// law. It is the reference of the GPU programs and the implementation without a GPU.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <span>
#include <vector>

namespace fx::render {

/// @param rgba     width * height pixels of four floats, row by row
/// @param settings must be accepted by checkSensorLaw()
/// @param ioHistory content of the history buffer of DazzlePass
/// @return the picture with glare. For an empty picture, an empty one; the history does not change then
std::vector<float> dazzleReference(std::span<const float> rgba, int width, int height,
                                   const DazzleSettings& settings, double deltaTime, bool resetHistory,
                                   DazzleHistory& ioHistory);

/// Glare per overflow by equation (1) of formula sensor-law. Only operations are used that every processor
/// and GPU rounds equally.
/// @param over mean overflow per pixel in units of white, >= 0
double dazzleGain(double over, const DazzleSettings& settings);

} // namespace fx::render
