/// @file interrupt.h
/// Ctrl-C (SIGINT) and SIGTERM as a flag that long work checks between steps and frames, so that it can clean
/// up. If the flag is not checked in time, or a second signal arrives, the program is terminated at once with
/// the same exit code, after removing registered temporary files and killing registered child processes.
///
/// Threads: installInterruptHandler() once from main; all other functions from any thread.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <string>
#include <sys/types.h>

namespace fx::cli {

/// [s] that a program has from a request to stop to its next look at interruptRequested().
constexpr unsigned kSecondsToStop = 8;

/// Catches SIGINT and SIGTERM, and ignores SIGPIPE so that a reader that goes away is an error of write().
/// Takes SIGALRM for itself.
void installInterruptHandler(unsigned secondsToStop = kSecondsToStop);

/// Whether the user has requested a stop. The caller ends at its next safe point.
bool interruptRequested();

/// The status of an interruption.
base::Status interruptedStatus();

/// Registers, during its lifetime, a file to remove or a process to kill if the program is terminated. At
/// most 32 at a time; further ones are ignored.
class EndsWithProgram
{
public:
    EndsWithProgram() = default;
    explicit EndsWithProgram(const std::string& file);
    explicit EndsWithProgram(pid_t process);
    ~EndsWithProgram();
    EndsWithProgram(EndsWithProgram&& other) noexcept;
    EndsWithProgram& operator=(EndsWithProgram&& other) noexcept;

private:
    static constexpr size_t kNowhere = ~size_t(0);
    size_t slot_ = kNowhere;
};

} // namespace fx::cli
