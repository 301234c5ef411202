/// @file exit_code.h
/// Exit codes of the fx command.
#pragma once

#include "foundation/result/status.h"

namespace fx::cli {

enum ExitCode : int
{
    kSuccess = 0,
    kFailed = 1,        ///< the command failed, or a checked file has errors
    kUsage = 2,         ///< the command line is invalid
    kInterrupted = 130, ///< the user interrupted the command (128 + SIGINT)
};

/// Exit code of a status: 0 for success, 130 for an interruption, 1 for all other errors.
inline int exitCodeOf(const base::Status& status)
{
    if (status.ok())
        return kSuccess;
    return status.code() == base::Code::Interrupted ? kInterrupted : kFailed;
}

} // namespace fx::cli
