/// @file inflate.h
/// Unpacks a zlib stream (RFC 1950 and 1951), as PNG files contain, with the size known beforehand.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <span>

namespace fx::asset {

/// Fills `out` exactly. Never reads or writes outside of the spans, whatever the input says.
/// @return Parse with the reason: damaged, too short, too long, or a wrong check sum
base::Status inflateZlib(std::span<const uint8_t> packed, std::span<uint8_t> out);

} // namespace fx::asset
