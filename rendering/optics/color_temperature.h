/// @file color_temperature.h
/// Colors of incandescent matter without their luminance, and temperatures of colors.
#pragma once

#include <glm/vec3.hpp>

namespace fx::render {

/// A color of luminance 1: that of a black body of this temperature [K], where it is hot enough to have one;
/// otherwise white.
glm::vec3 blackBodyColor(float temperature);

/// The temperature [K], 400 to 10,000, of a black body whose color has this share of red, so that red and
/// luminance of its light are those given. For mixtures of black bodies green is then right too, but for what
/// blue has.
/// @param red [1] red over luminance
/// @param guess [K] is returned if its color is within 1e-4 of that one: dark red is the same at several
/// temperatures
float colorTemperature(float red, float guess);

} // namespace fx::render
