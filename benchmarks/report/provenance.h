/// @file provenance.h
/// Version, machine and time of a report.
#pragma once

#include <string>

namespace fx::cli {

/// Commit of the build, such as "6316190"; "no commit" without git.
const char* commitName();

/// Returns text such as "fx 0.3.0 at 6316190 on Intel Xeon, 2 cores, AVX3".
std::string provenance(const std::string& machine);

} // namespace fx::cli
