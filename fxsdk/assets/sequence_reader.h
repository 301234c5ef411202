/// @file sequence_reader.h
/// Reads numbered volumes (volume_file.h) as a sequence.
#pragma once

#include "foundation/assets/volume_sequence.h"
#include "foundation/result/status.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace fx::asset {

struct SequenceFiles
{
    std::string pattern; ///< see frameName()
    uint32_t first = 0;  ///< number of the first frame
    uint32_t count = 1;  ///< 1 to base::kMaxSequenceFrames
    uint64_t memory = 0; ///< [byte] for the voxels that are held
};

/// Reads bytes by name. It is called again by the thread of the sequence if `isLasting`.
using ReadBytes = std::function<base::Result<std::string>(std::string_view name)>;

/// Reads all files once, and keeps as many of the first ones as the memory holds. Frames whose
/// voxels all have one side and are on one lattice share it; otherwise each has its own. A file that has
/// another content when it is read again is an error.
/// @param read for this call  @param readAgain for later; empty: all voxels have to fit into the memory
/// @param outHash receives a hash of the contents of all files
/// @return errors of `read` and parseVolume(), TooLarge; they name the file
base::Result<std::shared_ptr<base::VolumeSequence>>
readSequence(const SequenceFiles& files, const ReadBytes& read, ReadBytes readAgain, uint64_t& outHash);

} // namespace fx::asset
