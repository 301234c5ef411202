/// @file interrupt.h
/// Handles Ctrl-C (SIGINT) and SIGTERM. A signal sets a flag; long work checks the flag between steps and
/// frames and then cleans up. If the flag is not checked in time, or if a second signal arrives, the program
/// is terminated at once with the same exit code. Before the termination, registered temporary files are
/// removed and registered child processes are killed.
///
/// Threads: installInterruptHandler() once from main; all other functions from any thread.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <string>
#include <sys/types.h>

namespace fx::cli {

/// [s] time limit between a request to stop and the next call of interruptRequested().
constexpr unsigned kSecondsToStop = 8;

/// Catches SIGINT and SIGTERM. Ignores SIGPIPE, so that a closed pipe is an error of write(). Uses SIGALRM
/// for the time limit.
void installInterruptHandler(unsigned secondsToStop = kSecondsToStop);

/// True when the user has requested a stop. The caller then ends at its next safe point.
bool interruptRequested();

/// The status of an interruption.
base::Status interruptedStatus();

/// Registers a file or a process during the lifetime of this object. If the program is terminated, the file
/// is removed or the process is killed. At most 32 objects are registered at a time; further objects have no
/// effect.
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
