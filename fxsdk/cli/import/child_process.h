/// @file child_process.h
/// Work in a process of its own, with limits, so that its crash is an error and not the end of the program.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <functional>
#include <string>

namespace fx::cli {

struct ChildLimits
{
    uint64_t memory = uint64_t(4) << 30; ///< [byte] of addresses, beyond those of the program itself
    uint64_t output = uint64_t(4) << 30; ///< [byte] of the result
    unsigned seconds = 60;               ///< [s] of processor time, and twice as many of a clock
};

struct ChildReport
{
    int signal = 0;          ///< that ended the child; 0: it ended by itself
    bool wasTooSlow = false; ///< ended because its time was over
    uint64_t peakMemory = 0; ///< [byte] largest resident size
    double seconds = 0.0;    ///< [s] of processor time
};

/// Forks, runs `work` in the child, and returns what it has appended to its string. The child ends with the
/// program. Its output is discarded. Call it before the program starts threads: `work` has only one.
/// @param outReport null: not needed
/// @return the status of `work`; Parse when a signal ended the child, with its name; TooLarge when its time
/// was
///         over; Io when the system has no process; Interrupted
base::Result<std::string> runInChild(const ChildLimits& limits,
                                     const std::function<base::Status(std::string&)>& work,
                                     ChildReport* outReport = nullptr);

} // namespace fx::cli
