/// @file gallery_entry.h
/// One preset of a gallery: its pictures and its measured costs.
///
/// Threads: only the thread that calls, which is the GL thread.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace fx::cli {

struct GalleryOptions
{
    int width = 480;  ///< [pixel] of a picture
    int height = 270; ///< [pixel]
    int times = 4;    ///< moments of the strip; 0: no strip
};

struct GalleryEntry
{
    std::string input;               ///< library:NAME, or the path of a preset
    std::string name;                ///< unique among the entries of a page, and fit for a file name
    std::string description;         ///< the preset's own; may be empty
    std::vector<std::string> tags;   ///< what it consists of and how long it lasts
    double time = 0.0;               ///< [s] of the picture
    std::vector<double> times;       ///< [s] of the strip
    std::string picture;             ///< bytes of a PNG
    std::string strip;               ///< bytes of a PNG; empty without a strip
    uint64_t particles = 0;          ///< alive in the picture
    uint64_t memory = 0;             ///< [byte] an instance needs at most
    uint64_t textures = 0;           ///< [byte] of the view, for pictures of this size
    double frameMilliseconds = 0.0;  ///< [ms] median of stage and effect, until the GPU has finished
    double updateMilliseconds = 0.0; ///< [ms] median of a step of 1/60 s
    int measured = 0;                ///< number of frames that were measured
    std::string renderer;            ///< name of the GL renderer
};

/// Loads, simulates, draws and measures one preset.
/// @param drawn called after each picture
/// @return an error that names the file, or Interrupted
base::Result<GalleryEntry> makeGalleryEntry(const std::string& input, const GalleryOptions& options,
                                            const std::function<void()>& drawn);

/// Number of calls of `drawn`.
inline int picturesOf(const GalleryOptions& options)
{
    return 1 + options.times;
}

} // namespace fx::cli
