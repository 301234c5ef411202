/// @file frame_changes.h
/// Changes of pictures from frame to frame, compared with the changes of the scene itself.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace fx::cli {

/// The light of a frame. Pixels are in any order, but in the same order for all frames.
struct FrameLight
{
    std::vector<float> luminance; ///< [1] after exposure
    std::vector<bool> isCovered;  ///< whether media cover the pixel
};

/// [1] Mean absolute change of luminance over the pixels that are covered in at least one frame; 0 without
/// covered pixels.
/// @param coveredBefore, coveredAfter covered pixels of the reference, so that all renderers use the same
///          pixels
double meanChange(std::span<const float> before, std::span<const float> after,
                  const std::vector<bool>& coveredBefore, const std::vector<bool>& coveredAfter);

/// Bound of the change of a picture between frames: `factor` times the change of the reference plus `share`
/// times the reference's median change, so that the bound of frames without motion is above 0.
struct ChangeBound
{
    double factor = 1.5; ///< [1] > 1
    double share = 0.1;  ///< [1] > 0
};

struct ChangeJudgment
{
    /// [1] For each pair of frames: excess of the picture's change over the reference's change, at least 0.
    /// The excess is divided by the largest allowed excess. Values up to 1 keep the bound.
    std::vector<double> excess;
    size_t beyond = 0;            ///< number of pairs that violate the bound
    size_t worst = 0;             ///< index of the pair with the largest excess
    double medianReference = 0.0; ///< [1] median change of the reference
    double medianRatio = 0.0;     ///< [1] median ratio of the changes to the changes of the reference

    bool isKept() const { return beyond == 0; }
};

/// Compares the changes of a picture with the changes of the reference. A change that is not finite violates
/// the bound.
/// @param changes, reference values of the same pairs of frames
ChangeJudgment judgeChanges(std::span<const double> changes, std::span<const double> reference,
                            const ChangeBound& bound);

} // namespace fx::cli
