/// @file doctor.h
/// Checks of fx doctor.
#pragma once

#include <string>
#include <vector>

namespace fx::cli {

/// One line of the report.
struct Check
{
    std::string name;
    bool ok = true;
    bool required = false; ///< fx render cannot work without it
    std::string detail;    ///< the finding
    std::string remedy;    ///< the remedy when it is not ok
};

/// The EGL devices that the system offers, by name of their driver or device file; needs no context.
std::vector<std::string> eglDevices();

} // namespace fx::cli
