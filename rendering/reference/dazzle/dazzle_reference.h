/// @file dazzle_reference.h
/// Computes the glare on the CPU, with 128-bit integers. The result equals that of DazzlePass bit for bit,
/// for every sensor law. Tests compare the GPU programs with this implementation.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <span>
#include <vector>

namespace fx::render {

/// Computes a picture with glare.
/// @param rgba width * height pixels of four floats, row by row
/// @param settings settings that checkSensorLaw() accepts
/// @param ioHistory content of the history buffer of DazzlePass
/// @return the picture with glare. If the picture is empty, the result is empty and the history does not
///         change
std::vector<float> dazzleReference(std::span<const float> rgba, int width, int height,
                                   const DazzleSettings& settings, double deltaTime, bool resetHistory,
                                   DazzleHistory& ioHistory);

/// Glare per overflow by equation (1) of formula sensor-law. The function uses only operations that every
/// processor and every GPU rounds equally.
/// @param over mean overflow per pixel in units of white, >= 0
double dazzleGain(double over, const DazzleSettings& settings);

} // namespace fx::render
