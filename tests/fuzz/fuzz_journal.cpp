// Journals of the reference renderer: files of finished tiles that --resume continues.
#include "foundation/math/hash.h"
#include "rendering/reference/render/tile_journal.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/scratch_file.h"

#include <array>
#include <fstream>
#include <iterator>
#include <utility>

namespace fx::fuzz {

namespace {

constexpr uint64_t kKey = 7;
constexpr size_t kHeaderBytes = 16, kRecordBytes = 16; ///< before the numbers of a tile

using Tile = std::pair<uint32_t, std::vector<float>>;

/// Writes the checksum that a record of this journal must have, so that damaged records reach the reader.
void repairChecksums(std::vector<uint8_t>& bytes)
{
    for (size_t at = kHeaderBytes; at + kRecordBytes <= bytes.size();) {
        std::array<uint32_t, 2> head; // tile, number of floats
        std::memcpy(head.data(), &bytes[at], sizeof head);
        const size_t size = size_t(head[1]) * sizeof(float);
        if (size > bytes.size() - at - kRecordBytes)
            return;
        const uint64_t sum =
            base::hashBytes(base::hashWord(kKey, head[0]), bytes.data() + at + kRecordBytes, size);
        std::memcpy(&bytes[at + 8], &sum, sizeof sum);
        at += kRecordBytes + size;
    }
}

std::vector<Tile> tilesOf(const ScratchFile& file, base::Status& outStatus)
{
    std::vector<Tile> tiles;
    render::TileJournal journal(file.path(), kKey);
    outStatus = journal.resume([&](uint32_t tile, std::span<const float> values) {
        tiles.push_back({tile, {values.begin(), values.end()}});
    });
    return tiles;
}

bool isSame(const Tile& a, const Tile& b)
{
    return a.first == b.first && a.second.size() == b.second.size() &&
           (a.second.empty() ||
            std::memcmp(a.second.data(), b.second.data(), a.second.size() * sizeof(float)) == 0);
}

void appendTo(const ScratchFile& file, const Tile& tile)
{
    render::TileJournal journal(file.path(), kKey);
    require(journal.resume([](uint32_t, std::span<const float>) {}).ok(),
            "a resumed journal can be resumed again");
    require(journal.append(tile.first, tile.second).ok(), "a resumed journal takes tiles");
}

} // namespace

/// The first byte says whether checksums are repaired.
void runInput(std::span<const uint8_t> input)
{
    InputReader reader(input);
    const bool repairs = reader.one(2);
    std::vector<uint8_t> bytes(reader.rest().begin(), reader.rest().end());
    if (repairs)
        repairChecksums(bytes);
    const ScratchFile file(bytes);
    base::Status status;
    std::vector<Tile> tiles = tilesOf(file, status);
    if (!status)
        return;
    tiles.push_back({5, {1.0f, 2.0f}});
    appendTo(file, tiles.back());
    const std::vector<Tile> again = tilesOf(file, status);
    require(status.ok() && again.size() == tiles.size(), "a resumed journal keeps its whole tiles");
    for (size_t i = 0; i < tiles.size(); ++i)
        require(isSame(tiles[i], again[i]), "tiles are read as they were");
}

std::vector<std::string> seeds()
{
    const ScratchFile file({});
    appendTo(file, {0, {0.5f, 0.25f, 0.125f, 1.0f}});
    appendTo(file, {3, {}});
    appendTo(file, {4294967295u, {1e30f}});
    std::ifstream written(file.path(), std::ios::binary);
    const std::string journal{std::istreambuf_iterator<char>(written), std::istreambuf_iterator<char>()};
    return {'\0' + journal, '\1' + journal, '\1' + journal.substr(0, journal.size() - 3),
            std::string(1, '\0')};
}

} // namespace fx::fuzz
