/// @file frame_changes.h
/// How much pictures change from frame to frame, and whether that is more than the scene itself changes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace fx::cli {

/// The light of a frame; pixels in any order, the same for all frames.
struct FrameLight
{
    std::vector<float> luminance; ///< [1] exposed
    std::vector<bool> isCovered;  ///< by media
};

/// [1] mean absolute change of luminance over the pixels that are covered in either frame; 0 without any.
/// @param coveredBefore, coveredAfter of the reference, so that all renderers are compared in the same pixels
double meanChange(std::span<const float> before, std::span<const float> after,
                  const std::vector<bool>& coveredBefore, const std::vector<bool>& coveredAfter);

/// Bound of the change of a picture between frames: `factor` times the change of the reference plus `share`
/// of the reference's median change, so that frames without motion have a finite bound.
struct ChangeBound
{
    double factor = 1.5; ///< [1] > 1
    double share = 0.1;  ///< [1] > 0
};

struct ChangeJudgment
{
    /// [1] of each pair of frames: change beyond the reference's, in units of the margin of the bound; at
    /// most 1 where the bound is kept, at least 0.
    std::vector<double> excess;
    size_t beyond = 0;            ///< pairs that break the bound
    size_t worst = 0;             ///< pair with the largest excess
    double medianReference = 0.0; ///< [1] change
    double medianRatio = 0.0;     ///< [1] of the changes to the reference's

    bool isKept() const { return beyond == 0; }
};

/// @param changes, reference of the same pairs of frames. A change that is not finite breaks the bound.
ChangeJudgment judgeChanges(std::span<const double> changes, std::span<const double> reference,
                            const ChangeBound& bound);

} // namespace fx::cli
