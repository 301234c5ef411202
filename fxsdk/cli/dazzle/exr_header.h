/// @file exr_header.h
/// Checks the attributes in the headers of an OpenEXR file before the OpenEXR library reads them: the library
/// allocates as many bytes as an attribute says it has, up to 2 GiB.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string_view>

namespace fx::cli {

constexpr uint64_t kMaxHeaderBytes = uint64_t(4) << 20; ///< of all parts

/// Whether every attribute ends within the file and has the length that its type requires. A file that is not
/// an OpenEXR file is left to the library.
/// @param beginning of the file, kMaxHeaderBytes or all of it
/// @param fileBytes [byte] of the whole file
/// @return Parse naming the attribute; TooLarge for longer headers
base::Status checkExrAttributes(std::string_view beginning, uint64_t fileBytes);

} // namespace fx::cli
