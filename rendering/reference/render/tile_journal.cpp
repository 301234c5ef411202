#include "rendering/reference/render/tile_journal.h"

#include "foundation/math/hash.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fx::render {

namespace {

constexpr std::array<char, 8> kMagic{'f', 'x', 't', 'i', 'l', 'e', 's', '2'};

struct Header
{
    std::array<char, 8> magic;
    uint64_t key;
};

struct RecordHead
{
    uint32_t tile;
    uint32_t count; ///< floats that follow
    uint64_t checksum;
};

/// With the key, so that a tile of another picture is never taken for one of this.
uint64_t checksumOf(uint64_t key, uint32_t tile, std::span<const float> values)
{
    return base::hashBytes(base::hashWord(key, tile), values.data(), values.size_bytes());
}

bool readAll(int descriptor, void* to, size_t size, uint64_t at)
{
    char* out = static_cast<char*>(to);
    while (size > 0) {
        const ssize_t got = pread(descriptor, out, size, off_t(at));
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        out += got;
        at += uint64_t(got);
        size -= size_t(got);
    }
    return true;
}

} // namespace

TileJournal::~TileJournal()
{
    if (descriptor_ >= 0)
        close(descriptor_);
}

base::Status TileJournal::failed(const char* what) const
{
    return {base::Code::Io, std::string("cannot ") + what + " " + path_ + ": " + std::strerror(errno)};
}

base::Status TileJournal::open()
{
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
        return failed("create");
    // Where a file system has no locks, nothing keeps two runs apart; the checksums do.
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return {base::Code::Io,
                path_ + " is being written by another run; wait for it, or choose another output"};
    return {};
}

base::Status TileJournal::writeAll(const std::vector<char>& bytes)
{
    size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t written =
            pwrite(descriptor_, bytes.data() + done, bytes.size() - done, off_t(length_ + done));
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0) {
            const base::Status status = failed("write");
            isBroken_ = true;
            if (length_ == 0)
                unlink(path_.c_str());
            else if (ftruncate(descriptor_, off_t(length_)) != 0)
                return status; // the incomplete record is recognized by its checksum
            return status;
        }
        done += size_t(written);
    }
    length_ += bytes.size();
    return {};
}

base::Status TileJournal::writeHeader()
{
    const Header header{kMagic, key_};
    std::vector<char> bytes(sizeof header);
    std::memcpy(bytes.data(), &header, sizeof header);
    length_ = 0;
    return writeAll(bytes);
}

base::Status TileJournal::start()
{
    if (base::Status status = open(); !status)
        return status;
    if (ftruncate(descriptor_, 0) != 0)
        return failed("write");
    return writeHeader();
}

uint64_t TileJournal::readRecords(const Restore& restore)
{
    struct stat info = {};
    if (fstat(descriptor_, &info) != 0)
        return sizeof(Header);
    const uint64_t size = uint64_t(info.st_size);
    uint64_t at = sizeof(Header);
    std::vector<float> values;
    for (;;) {
        RecordHead head;
        if (at + sizeof head > size || !readAll(descriptor_, &head, sizeof head, at))
            return at;
        const uint64_t bytes = uint64_t(head.count) * sizeof(float);
        if (at + sizeof head + bytes > size)
            return at;
        values.resize(head.count);
        if (!readAll(descriptor_, values.data(), bytes, at + sizeof head) ||
            checksumOf(key_, head.tile, values) != head.checksum)
            return at;
        restore(head.tile, values);
        at += sizeof head + bytes;
    }
}

base::Status TileJournal::resume(const Restore& restore)
{
    if (base::Status status = open(); !status)
        return status;
    Header header{};
    struct stat info = {};
    if (fstat(descriptor_, &info) != 0)
        return failed("read");
    if (uint64_t(info.st_size) < sizeof header) { // killed before the first tile
        if (ftruncate(descriptor_, 0) != 0)
            return failed("write");
        return writeHeader();
    }
    if (!readAll(descriptor_, &header, sizeof header, 0) || header.magic != kMagic || header.key != key_)
        return {
            base::Code::InvalidArgument,
            path_ +
                " was begun for another picture; render without --resume, or with what it was begun with"};
    length_ = readRecords(restore);
    if (ftruncate(descriptor_, off_t(length_)) != 0)
        return failed("write");
    return {};
}

base::Status TileJournal::append(uint32_t tile, std::span<const float> values)
{
    const RecordHead head{tile, uint32_t(values.size()), checksumOf(key_, tile, values)};
    std::vector<char> bytes(sizeof head);
    std::memcpy(bytes.data(), &head, sizeof head);
    const char* const begin = reinterpret_cast<const char*>(values.data());
    bytes.insert(bytes.end(), begin, begin + values.size_bytes());
    const std::lock_guard lock(mutex_);
    if (isBroken_)
        return {base::Code::Io, "cannot write " + path_};
    return writeAll(bytes);
}

void TileJournal::remove()
{
    unlink(path_.c_str());
}

} // namespace fx::render
