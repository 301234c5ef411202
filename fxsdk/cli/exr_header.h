/// @file exr_header.h
/// Checks the attributes in the headers of an OpenEXR file before the OpenEXR library reads them: the library
/// allocates as many bytes as an attribute says it has, up to 2 GiB.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <istream>

namespace fx::cli {

/// Whether every attribute ends within the file. A file that is no OpenEXR file is left to the library.
/// @param fileBytes [byte] of the whole file
/// @return Parse naming the attribute
base::Status checkExrAttributes(std::istream& file, uint64_t fileBytes);

} // namespace fx::cli
