/// @file exr_header.h
/// Checks the attributes in the headers of an OpenEXR file before the OpenEXR library reads them. The
/// library allocates the size that an attribute states, up to 2 GiB, without comparing it to the size of
/// the file.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string_view>

namespace fx::cli {

constexpr uint64_t kMaxHeaderBytes = uint64_t(4) << 20; ///< [byte] limit for the headers of all parts

/// Checks that every attribute ends within the file and has the length that its type requires. Ok for a file
/// that is not an OpenEXR file, because the OpenEXR library reports that error.
/// @param beginning the first kMaxHeaderBytes of the file, or the whole file if it is shorter
/// @param fileBytes [byte] size of the whole file
/// @return Parse naming the attribute; TooLarge for headers longer than kMaxHeaderBytes
base::Status checkExrAttributes(std::string_view beginning, uint64_t fileBytes);

} // namespace fx::cli
