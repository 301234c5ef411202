/// @file library_names.h
/// The presets of the library, for tests that play all of them.
#pragma once

#include <string>
#include <vector>

namespace fx::test {

/// Names of the library's presets that this build can load. A build without gases cannot load presets with a
/// gas.
std::vector<std::string> libraryNames();

} // namespace fx::test
