/// @file image_metrics.h
/// Differences between two pictures.
#pragma once

#include "foundation/result/status.h"
#include "rendering/image/image.h"

namespace fx::image {

/// Differences over all values of all channels. The difference of a finite value and a value that is not
/// finite is infinite.
struct Difference
{
    double max = 0;
    double mean = 0; ///< mean of absolute differences
    double rms = 0;
};

/// Compares two images.
/// @return InvalidArgument if sizes or numbers of channels differ
base::Result<Difference> compare(const Image& a, const Image& b);

} // namespace fx::image
