/// @file dazzle_reference.h
/// The dazzle on the CPU, in 128-bit integers: what the GPU programs are compared with, and the path without
/// a GPU.
///
/// Equal to DazzlePass bit for bit when B = 0. Otherwise only the gain differs: exp() of a GPU changes the
/// budget by a relative error of at most 2^-20 and each pixel by what follows from it.
#pragma once

#include "rendering/passes/dazzle_pass.h"

#include <span>
#include <vector>

namespace fx::render {

/// @param rgba     width * height pixels of four floats, row by row
/// @param settings accepted by checkSensorLaw()
/// @param ioHistory as the history buffer of DazzlePass
/// @return the picture after the dazzle; empty for an empty one, whose history stays as it is
std::vector<float> dazzleReference(std::span<const float> rgba, int width, int height,
                                   const DazzleSettings& settings, double deltaTime, bool resetHistory,
                                   DazzleHistory& ioHistory);

} // namespace fx::render
