/// @file frame_name.h
/// Names of numbered files.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace fx::asset {

/// The name with the number of a frame instead of its only placeholder, %d, %4d or %04d; the last two have at
/// least four digits.
/// @return InvalidArgument for names with another number of placeholders, naming the allowed forms
base::Result<std::string> frameName(std::string_view pattern, uint32_t number);

} // namespace fx::asset
