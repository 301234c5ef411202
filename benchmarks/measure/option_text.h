/// @file option_text.h
/// Texts of options that several commands take.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string>
#include <vector>

namespace fx::cli {

/// A count of particles: "262144", "64^3". 0 when the text is neither, or beyond 2^28.
uint32_t particleCount(const std::string& text);

/// "unknown case 'sedv', did you mean 'sedov'? There are: ..."
base::Status unknownName(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known);

} // namespace fx::cli
