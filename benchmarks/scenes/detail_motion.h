/// @file detail_motion.h
/// How much a sequence of pictures changes besides the motion of the medium in it.
#pragma once

#include "benchmarks/scenes/detail_scene.h"

namespace fx::cli {

/// Of one frame after another.
struct MotionResidual
{
    /// [1] root mean square difference of sRGB values to the picture before, moved with the medium, over
    /// pixels of which at least half is medium
    std::vector<double> frames;
    double mean = 0.0, worst = 0.0; ///< [1] of `frames`
    uint32_t births = 0;            ///< frames in which a generation of coordinates was born
    double atBirths = 0.0;          ///< [1] mean of those; 0 without any
};

/// Frames of the composition volume at 60 Hz, from the moment of `scene` on.
/// @param renderer of square pictures
base::Result<MotionResidual> motionResidual(DetailScene& scene, SnapshotRenderer& renderer, int frames,
                                            const std::function<bool()>& stop);

} // namespace fx::cli
