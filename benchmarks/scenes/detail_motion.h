/// @file detail_motion.h
/// Changes in a sequence of pictures of a medium, apart from the medium's motion.
#pragma once

#include "benchmarks/scenes/detail_scene.h"

namespace fx::cli {

/// Residual changes from frame to frame.
struct MotionResidual
{
    /// [1] root mean square difference of sRGB values between a picture and the previous one. The previous
    /// picture is first displaced by the motion of the medium. Only pixels with an opacity of at least one
    /// half are compared.
    std::vector<double> frames;
    double mean = 0.0, worst = 0.0; ///< [1] mean and maximum of `frames`
    uint32_t births = 0;            ///< number of frames in which a new generation of noise coordinates began
    double atBirths = 0.0; ///< [1] mean of `frames` over the frames counted by `births`; 0 if there are none
};

/// Measures frames that are drawn with the composition "volume" at 60 Hz, from the present moment of `scene`
/// on.
/// @param renderer renderer of square pictures
base::Result<MotionResidual> motionResidual(DetailScene& scene, SnapshotRenderer& renderer, int frames,
                                            const std::function<bool()>& stop);

} // namespace fx::cli
