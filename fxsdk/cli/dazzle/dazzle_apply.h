/// @file dazzle_apply.h
/// Applies the glare of a saturated sensor to a picture read from a file.
#pragma once

#include "fxsdk/cli/dazzle/dazzle_image.h"
#include "rendering/reference/dazzle/dazzle_reference.h"

#include <string>

namespace fx::cli {

enum class DazzleAlgorithm
{
    Exact, ///< integer sums over the full range of values, as on the GPU
    Paper8 ///< 256 levels between 0 and white, see formula dazzle-levels
};

/// Results for reports.
struct DazzleOutcome
{
    double overflow[3] = {}; ///< [1] mean overflow per pixel in units of white; red, green, blue
    uint32_t replaced = 0;   ///< number of replaced values: not finite, negative or too large
};

/// Parses "A,B,C" as the parameters of the sensor law.
/// @return InvalidArgument when the text is malformed (the message names the form) or when the law would
/// give less glare for more light
base::Status readSensor(const std::string& text, render::DazzleSettings& ioSettings);

/// Adds the glare to a picture. Only the channels R, G and B change, or Y in a gray picture.
/// @return InvalidArgument when the picture has none of these channels
base::Result<DazzleOutcome> applyDazzle(DazzleImage& ioImage, DazzleAlgorithm algorithm,
                                        const render::DazzleSettings& settings);

} // namespace fx::cli
