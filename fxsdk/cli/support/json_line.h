/// @file json_line.h
/// The output of --json: one object per line on standard output, each with the version and the machine.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/support/machine.h"

#include <nlohmann/json.hpp>

namespace fx::cli {

/// Adds the members "version" and "machine".
nlohmann::json withMachine(nlohmann::json object, const Machine& machine);

/// Prints `object` and a line break. Bytes that are not UTF-8 are replaced.
void printJsonLine(const nlohmann::json& object);

/// Flushes standard output. @return Io when a part could not be written, for example because a disk is full
base::Status finishStandardOutput();

} // namespace fx::cli
