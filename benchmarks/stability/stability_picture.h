/// @file stability_picture.h
/// Draws an error map as a picture with labeled axes and a color scale that marks the limit.
#pragma once

#include "benchmarks/stability/stability_run.h"
#include "rendering/image/image.h"

#include <string>

namespace fx::cli {

image::Image mapPicture(const StabilityResult& result, const StabilityMap& map);

/// Draws letters of 5 x 7 pixels with their upper left corner at (x, y). Lower case, digits and some signs
/// exist; other characters are left blank. Each letter is 6 pixels wide including its gap. Parts outside of
/// the picture are clipped.
/// @param isUpwards rotated counter-clockwise by 90 degrees, beginning at the lower left corner
void drawText(image::Image& picture, int x, int y, const std::string& text, bool isUpwards = false);

} // namespace fx::cli
