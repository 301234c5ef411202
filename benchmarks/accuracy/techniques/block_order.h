/// @file block_order.h
/// Whether the order of blocks in a preset is seen where blocks interpenetrate.
#pragma once

#include "benchmarks/accuracy/accuracy_technique.h"

namespace fx::cli {

inline constexpr const char* kBlockOrderScene = "twins-order";

/// Pairs of blocks of two colors in the same places, listed in both orders. The largest difference of the two
/// pictures has to be at most 1/1023 of the largest exposed value: less than a level of 10 bits. The control
/// is the composition `sorted`, which draws balls of equal depth in the order in which they are listed.
std::unique_ptr<AccuracyTechnique> makeBlockOrder(const AccuracyScale& scale);

} // namespace fx::cli
