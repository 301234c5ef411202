/// @file frame_files.h
/// Which frames of a sequence of files are imported.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/support/output_target.h"

#include <cstdint>
#include <string>

namespace fx::cli {

struct FrameNumbers
{
    uint32_t first = 0;
    uint32_t count = 0;
};

/// @param range FIRST:LAST, both included; empty: all frames of which there are files
/// @return InvalidArgument for another form of `range`; TooLarge for more than base::kMaxSequenceFrames;
/// NotFound
///         without files, and for a gap between them, with the name of the first missing file
base::Result<FrameNumbers> chooseFrames(const NumberedFile& input, const std::string& range);

} // namespace fx::cli
