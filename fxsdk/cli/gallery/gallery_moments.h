/// @file gallery_moments.h
/// The moments at which a gallery shows a preset.
#pragma once

#include "foundation/time/ticks.h"

#include <vector>

namespace fx::cli {

/// [s] time of the picture of a preset whose preview has none.
constexpr double kGalleryTime = 0.5;
/// [s] latest moment of a strip, so that a preset of an hour takes no longer than others.
constexpr double kGalleryEnd = 20.0;

/// Moments of a strip. Each is later than the one before by the same factor, as effects begin fast and end
/// slowly. The first is half of `time`. The last is 0.6 `duration`, when a burst has not yet vanished; of an
/// effect without an end it is 4 `time`. None is later than kGalleryEnd, unless `time` is.
/// @param time     [s] of the picture, >= 0
/// @param duration [s] 0: the effect does not end
/// @param count    number of moments
std::vector<base::Ticks> stripMoments(double time, double duration, int count);

} // namespace fx::cli
