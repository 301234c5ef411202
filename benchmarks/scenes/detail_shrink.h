/// @file detail_shrink.h
/// Difference between a small picture of a field with detail and the averaged pixels of a large picture.
#pragma once

#include "benchmarks/scenes/detail_scene.h"

namespace fx::cli {

constexpr int kShrink = 4; ///< pixels of the large picture per pixel of the small picture, along an axis

/// Root mean square errors over covered pixels.
struct ShrinkErrors
{
    /// [1] errors of all covered pixels and channels, relative to the RMS of the light
    std::vector<double> values;
    double light = 0.0;         ///< [1] RMS error of the light, relative to the RMS of the light
    double bias = 0.0;          ///< [1] relative error of the mean light of the small picture
    double transmittance = 0.0; ///< [1] RMS error of the transmittance, relative to the RMS opacity
    double emission = 0.0, sun = 0.0, sky = 0.0; ///< [1] as `light`, for each part of the light
    /// [1] as `light`, if the small picture used one ray per pixel and the detail of the large picture. The
    /// ray is approximated by the mean of the four middle pixels of a block of the large picture.
    double unfaded = 0.0;
    /// [1] as `unfaded`, for the transmittance, relative to the RMS opacity
    double unfadedTransmittance = 0.0;
};

/// Draws both pictures by OpenGL.
/// @param side [pixel] side length of the small picture @param ioSeconds [s] is increased by the time of
///         drawing
base::Result<ShrinkErrors> shrinkErrors(const DetailScene& scene, const render::ViewSettings& settings,
                                        int side, double& ioSeconds);

} // namespace fx::cli
