/// @file read_file.h
/// Reads whole files after a check of their size.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string>

namespace fx::asset {

/// The bytes of the regular file `path`.
/// @return NotFound, TooLarge (by its size, before reading), Io (a folder, a device, or refused by the
/// system)
base::Result<std::string> readFile(const std::string& path, uint64_t maxBytes);

} // namespace fx::asset
