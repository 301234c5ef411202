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
    bool required = false; ///< true if fx render cannot work when the check fails
    std::string detail;    ///< description of the result
    std::string remedy;    ///< advice for the user, printed if `ok` is false
};

/// Lists the EGL devices of the system, by the name of their driver or device file. The function needs no GL
/// context.
std::vector<std::string> eglDevices();

} // namespace fx::cli
