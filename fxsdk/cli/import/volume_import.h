/// @file volume_import.h
/// Reads OpenVDB files in a process of their own.
#pragma once

#include "fxsdk/cli/import/child_process.h"
#include "rendering/vdb/vdb_reader.h"

#include <string>

namespace fx::cli {

/// As render::readVdb(), but a file that crashes OpenVDB, or takes too much memory or time, is an error that
/// names the file and the cause. Call it before the program starts threads.
/// @param limits `output` is at least what the grid takes
base::Result<render::MediumGrid> importVolume(const std::string& path, const render::VdbReadOptions& options,
                                              const ChildLimits& limits, ChildReport* outReport = nullptr);

} // namespace fx::cli
