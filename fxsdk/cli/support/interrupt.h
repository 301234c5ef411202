/// @file interrupt.h
/// Ctrl-C (SIGINT) and SIGTERM as a flag that long work looks at between steps and frames, so that it ends by
/// the clean way. A program that does not look in time, or is asked a second time, is ended on the spot with
/// the same exit code; temporary files and child processes that were entered here do not outlive it.
///
/// Threads: installInterruptHandler() once from main; everything else from anywhere.
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

/// The status that says so.
base::Status interruptedStatus();

/// While it lives, a file is removed, or a process killed, when the program is ended on the spot. At most 32
/// at a time; what exceeds them is not entered.
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
