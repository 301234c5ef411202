/// @file stability_picture.h
/// An error map as a picture: axes with numbers, and a color scale with the limit on it.
#pragma once

#include "benchmarks/stability/stability_run.h"
#include "rendering/image/image.h"

#include <string>

namespace fx::cli {

image::Image mapPicture(const StabilityResult& result, const StabilityMap& map);

/// Letters of 5 x 7 pixels, drawn with their upper left corner at (x, y); lower case, digits and some signs,
/// others are left empty. Each is 6 pixels wide with its gap. Parts outside of the picture are clipped.
/// @param isUpwards turned by a quarter to the left, beginning at the lower left corner
void drawText(image::Image& picture, int x, int y, const std::string& text, bool isUpwards = false);

} // namespace fx::cli
