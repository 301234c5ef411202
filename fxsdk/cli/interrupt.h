/// @file interrupt.h
/// Ctrl-C (SIGINT) and SIGTERM as a flag that long work looks at between steps and frames, so that it always
/// ends by the clean way: no temporary file stays behind, however often the user presses it.
///
/// Threads: install() once from main; requested() from anywhere.
#pragma once

#include "foundation/result/status.h"

namespace fx::cli {

/// Catches SIGINT and SIGTERM, and ignores SIGPIPE so that a reader that goes away is an error of write().
void installInterruptHandler();

/// Whether the user has asked to stop.
bool interruptRequested();

/// The status that says so.
base::Status interruptedStatus();

} // namespace fx::cli
