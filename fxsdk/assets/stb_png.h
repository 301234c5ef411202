/// @file stb_png.h
/// Decodes PNG files by stb_image within a limit of memory.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fx::asset {

/// Decodes a PNG file.
/// @param file       the complete file, with a checked header
/// @param isDeep     true for 16 bits a channel, which are rounded to 8
/// @param mostBytes  [byte] largest single allocation while decoding
/// @return red, green, blue and opacity of width x height texels from the top; Parse with stb_image's reason
base::Result<std::vector<uint8_t>> unpackPng(std::span<const uint8_t> file, bool isDeep, int width,
                                             int height, size_t mostBytes);

} // namespace fx::asset
