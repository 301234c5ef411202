/// @file callgrind.h
/// Instructions where the system does not count them: on valgrind's simulated processor.
#pragma once

#include "foundation/result/status.h"

#include <string>
#include <vector>

namespace fx::cli {

/// Whether the valgrind program is found in PATH and can run this program, which it cannot on processors
/// whose instructions it does not know. Tried once, in about a second.
bool hasCallgrind();

/// Runs this program again under callgrind with other arguments.
/// @param function extern "C", called `calls` times; instructions inside are counted
/// @return instructions, one for each call; Internal when callgrind's output has an unknown form
base::Result<std::vector<double>> countUnderCallgrind(const std::vector<std::string>& arguments,
                                                      const std::string& function, size_t calls);

/// Runs this program again under callgrind, `fx accuracy TECHNIQUE --scene SCENE --count-work`, which calls
/// fxAccuracyWork() once for each setting. The simulated processor has AVX2 at most.
/// @return instructions, one for each setting; Internal when callgrind's output has an unknown form
base::Result<std::vector<double>> countUnderCallgrind(const std::string& technique, const std::string& scene,
                                                      size_t settings);

/// Totals of the parts of a callgrind file, in order.
std::vector<double> callgrindTotals(const std::string& text);

} // namespace fx::cli
