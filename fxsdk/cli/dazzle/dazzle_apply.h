/// @file dazzle_apply.h
/// The glare of a saturated sensor on a picture that was read from a file.
#pragma once

#include "fxsdk/cli/dazzle/dazzle_image.h"
#include "rendering/reference/dazzle/dazzle_reference.h"

#include <string>

namespace fx::cli {

enum class DazzleAlgorithm
{
    Exact, ///< integer sums over the full range, as the GPU computes them
    Paper8 ///< 256 levels between 0 and white, formula dazzle-levels
};

/// Results for reports.
struct DazzleOutcome
{
    double overflow[3] = {}; ///< [1] mean per pixel in units of white; red, green, blue
    uint32_t replaced = 0;   ///< values that were not finite, negative or too large
};

/// Parses "A,B,C" as the parameters of the sensor law.
/// @return InvalidArgument naming the allowed form, also when more light would give less glare
base::Status readSensor(const std::string& text, render::DazzleSettings& ioSettings);

/// Changes the channels R, G, B, or Y of a gray picture, and no others.
/// @return InvalidArgument when the picture has none of these channels
base::Result<DazzleOutcome> applyDazzle(DazzleImage& ioImage, DazzleAlgorithm algorithm,
                                        const render::DazzleSettings& settings);

} // namespace fx::cli
