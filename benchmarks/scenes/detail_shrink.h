/// @file detail_shrink.h
/// How a small picture of a field with detail differs from the mean of the pixels of a large one.
#pragma once

#include "benchmarks/scenes/detail_scene.h"

namespace fx::cli {

constexpr int kShrink = 4; ///< pixels of the large picture along an axis, for each of the small one

/// Root mean square errors over covered pixels.
struct ShrinkErrors
{
    std::vector<double> values; ///< [1] of all covered pixels and channels, of the RMS of the light
    double light = 0.0;         ///< [1] of the RMS of the light, as all but the next two
    double bias = 0.0;          ///< [1] mean light of the small picture over that of the large one - 1
    double transmittance = 0.0; ///< [1] of the RMS opacity
    double emission = 0.0, sun = 0.0, sky = 0.0; ///< parts of the light
    /// One ray a pixel with the detail of the large picture: what its four middle pixels have.
    double unfaded = 0.0;
    double unfadedTransmittance = 0.0; ///< [1] of the RMS opacity
};

/// Draws both by OpenGL.
/// @param side [pixel] of the small picture  @param ioSeconds spent in drawing is added
base::Result<ShrinkErrors> shrinkErrors(const DetailScene& scene, const render::ViewSettings& settings,
                                        int side, double& ioSeconds);

} // namespace fx::cli
