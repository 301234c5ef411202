/// @file cumulus_scenes.h
/// Clouds of blocks for measurements of impostors. They do not follow presets of the library, which change
/// with what looks best.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/scene_file/scene_file.h"

#include <cstdint>

namespace fx::cli {

/// A cloud in the light of the sun from the side.
struct Cumulus
{
    bool isSmall;      ///< 60 blocks in a form 26 m wide; else 360 in one of 60 m
    glm::dvec3 middle; ///< [m]
    double radius;     ///< [m] of most of the cloud
};

base::Result<scene_file::SceneFile> cumulusScene(const Cumulus& cumulus);

/// Pairs of equal puffs of the cumulus, in the same place but of different colors: each ball of a pair has
/// its twin at the same depth, so that whatever is drawn over the other hides it.
/// @param isReversed whether the preset lists the blocks in reversed order
base::Result<scene_file::SceneFile> twinBlocksScene(uint32_t pairs, uint64_t seed, bool isReversed);

} // namespace fx::cli
