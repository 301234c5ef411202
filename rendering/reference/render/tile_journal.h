/// @file tile_journal.h
/// Stores finished tiles of a picture in a file next to the picture, so that a killed render can be
/// continued.
///
/// The file has a header, then one record per finished tile. A record has the tile number, a checksum and the
/// values, in the byte order of the machine. A killed process leaves at most one incomplete record, which the
/// next open() removes. Threads: any thread may call append().
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
    /// A function that receives a tile of an earlier run.
    using Restore = std::function<void(uint32_t tile, std::span<const float> values)>;

    /// @param path path of the journal
    /// @param key identifies the picture: a hash of all inputs of its pixels
    TileJournal(std::string path, uint64_t key) : path_(std::move(path)), key_(key) {}
    ~TileJournal();
    TileJournal(const TileJournal&) = delete;
    TileJournal& operator=(const TileJournal&) = delete;

    /// Begins a new journal and replaces an existing one.
    /// @return Io if the file cannot be written, or if another TileJournal has opened it. In the second case
    ///         the file is not changed
    base::Status start();
    /// Continues an existing journal, or begins one if there is none.
    /// @return InvalidArgument if the file belongs to another picture; the file is then not changed. Io for
    /// the
    ///         reasons given at start()
    base::Status resume(const Restore& restore);
    /// Adds a finished tile. After a failure, the journal ends with the last complete tile, and further calls
    /// add no tiles.
    base::Status append(uint32_t tile, std::span<const float> values);
    /// Deletes the journal. Must be called when the picture has been written.
    void remove();

private:
    base::Status open();
    base::Status failed(const char* what) const;
    base::Status writeHeader();
    base::Status writeAll(const std::vector<char>& bytes);
    /// Passes all complete records to `restore`.
    /// @return [byte] length of the part of the file that has complete records
    uint64_t readRecords(const Restore& restore);

    std::string path_;
    uint64_t key_;
    int descriptor_ = -1;
    uint64_t length_ = 0; ///< [byte] length of the part of the file that has complete records
    bool isBroken_ = false;
    std::mutex mutex_; ///< guards the members during append()
};

} // namespace fx::render
