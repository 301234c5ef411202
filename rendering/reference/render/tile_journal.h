/// @file tile_journal.h
/// Finished tiles of a picture in a file beside it, so that a killed render can be continued.
///
/// The file is a header, then one record a tile in the order in which they were finished: number, checksum,
/// floats, in the byte order of the machine. A process that dies leaves at most one incomplete record, which
/// is cut off by the next open(). Threads: append() from any.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace fx::render {

class TileJournal
{
public:
    /// Receives a tile of an earlier run.
    using Restore = std::function<void(uint32_t tile, std::span<const float> values)>;

    /// @param path of the journal  @param key identifies the picture: everything that its pixels depend on
    TileJournal(std::string path, uint64_t key) : path_(std::move(path)), key_(key) {}
    ~TileJournal();
    TileJournal(const TileJournal&) = delete;
    TileJournal& operator=(const TileJournal&) = delete;

    /// Begins a new journal in place of any other.
    /// @return Io when it cannot be written, or when another TileJournal has it open: it is left as it is
    base::Status start();
    /// Continues an earlier one, or begins one when there is none.
    /// @return InvalidArgument when the file belongs to another picture; it is left as it is; Io as start()
    base::Status resume(const Restore& restore);
    /// Adds a finished tile. After a failure the journal ends with the last whole tile, and nothing more is
    /// added.
    base::Status append(uint32_t tile, std::span<const float> values);
    /// The picture is safe: the journal is not needed any more.
    void remove();

private:
    base::Status open();
    base::Status failed(const char* what) const;
    base::Status writeHeader();
    base::Status writeAll(const std::vector<char>& bytes);
    /// @return length of the part of the file that is whole
    uint64_t readRecords(const Restore& restore);

    std::string path_;
    uint64_t key_;
    int descriptor_ = -1;
    uint64_t length_ = 0; ///< [byte] size of the complete tiles
    bool isBroken_ = false;
    std::mutex mutex_; ///< of append()
};

} // namespace fx::render
