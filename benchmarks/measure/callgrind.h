/// @file callgrind.h
/// Counts instructions by valgrind's simulated processor if the system cannot count them.
#pragma once

#include "foundation/result/status.h"

#include <string>
#include <vector>

namespace fx::cli {

/// Whether the valgrind program is in PATH and can run this program. False on processors whose instructions
/// valgrind does not support. The first call takes about a second.
bool hasCallgrind();

/// Runs this program again under callgrind with the given arguments.
/// @param function extern "C" function that is called `calls` times; instructions inside of it are counted
/// @return numbers of instructions, one per call; Internal if callgrind's output has an unknown format
base::Result<std::vector<double>> countUnderCallgrind(const std::vector<std::string>& arguments,
                                                      const std::string& function, size_t calls);

/// Runs this program again under callgrind as `fx accuracy TECHNIQUE --scene SCENE --count-work`, which calls
/// fxAccuracyWork() once per setting. The simulated processor supports at most AVX2.
/// @return numbers of instructions, one per setting; Internal if callgrind's output has an unknown format
base::Result<std::vector<double>> countUnderCallgrind(const std::string& technique, const std::string& scene,
                                                      size_t settings);

/// Numbers of instructions of the parts of a callgrind file, in the order of the file.
std::vector<double> callgrindTotals(const std::string& text);

} // namespace fx::cli
