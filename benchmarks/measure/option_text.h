/// @file option_text.h
/// Parses texts of options that several commands share.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::cli {

/// Parses a number of particles: "262144", "64^3". 0 if the text has another form or the number is above
/// 2^28.
uint32_t particleCount(const std::string& text);

/// Error message such as "unknown case 'sedv', did you mean 'sedov'? There are: ...".
base::Status unknownName(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known);

} // namespace fx::cli
