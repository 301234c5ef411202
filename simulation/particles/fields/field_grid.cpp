#include "simulation/particles/fields/field_grid.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

namespace fx::sim {

namespace {

using base::Code;
using base::Status;

/// Reads the header word by word.
class Cursor
{
public:
    explicit Cursor(std::string_view bytes) : bytes_(bytes) {}

    bool ok() const { return status_.ok(); }
    const Status& status() const { return status_; }
    std::string_view rest() const { return bytes_.substr(at_); }

    void fail(Code code, const std::string& what)
    {
        if (ok())
            status_ = Status(code, "byte " + std::to_string(word_) + ": " + what);
    }
    void word(std::string_view wanted, char end)
    {
        const std::string_view found = take(end);
        if (found != wanted)
            fail(Code::Parse, "expected '" + std::string(wanted) +
                                  "'; docs/howto/grids.md describes the header, and \"fx grid\" writes "
                                  "such files from other ones");
    }
    template <class T>
    void number(T& out, char end)
    {
        const std::string_view text = take(end);
        const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), out);
        if (error != std::errc() || last != text.data() + text.size() || text.empty())
            fail(Code::Parse, "expected a number; docs/howto/grids.md describes the header");
    }
    template <class V>
    void triple(std::string_view name, V& out)
    {
        word(name, ' ');
        number(out.x, ' ');
        number(out.y, ' ');
        number(out.z, '\n');
    }

private:
    /// What stands before the next `end`, which is skipped.
    std::string_view take(char end)
    {
        word_ = at_;
        const size_t found = ok() ? bytes_.substr(at_, 64).find(end) : std::string_view::npos;
        if (found == std::string_view::npos)
            return {};
        const std::string_view text = bytes_.substr(at_, found);
        at_ += found + 1;
        return text;
    }

    std::string_view bytes_;
    size_t at_ = 0;
    size_t word_ = 0; ///< where the last one begins
    Status status_;
};

void readHeader(Cursor& cursor, FieldGrid& out)
{
    uint32_t version = 0;
    cursor.word("fxgrid", ' ');
    cursor.number(version, '\n');
    if (version != 1)
        cursor.fail(Code::Version, "found version " + std::to_string(version) + "; known is 1");
    cursor.triple("nodes", out.nodes);
    cursor.word("channels", ' ');
    cursor.number(out.channels, '\n');
    cursor.triple("low", out.low);
    cursor.triple("cell", out.cell);
    cursor.word("data", '\n');
}

void checkHeader(Cursor& cursor, const FieldGrid& grid)
{
    for (const uint32_t n : {grid.nodes.x, grid.nodes.y, grid.nodes.z})
        if (n < 1 || n > kMaxGridNodesPerAxis)
            return cursor.fail(Code::TooLarge, "found " + std::to_string(n) +
                                                   " nodes along an axis; allowed are 1 to " +
                                                   std::to_string(kMaxGridNodesPerAxis));
    if (grid.count() > kMaxGridNodes)
        return cursor.fail(Code::TooLarge, "more than " + std::to_string(kMaxGridNodes) + " nodes");
    if (grid.channels != 1 && grid.channels != 3)
        return cursor.fail(Code::InvalidArgument, "allowed are 1 or 3 channels");
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(grid.low[k]) <= 1e6f) || !(grid.cell[k] >= 1e-6f && grid.cell[k] <= 1e6f))
            return cursor.fail(Code::InvalidArgument,
                               "low has to lie within 1e6 m, and cell between 1e-6 m and 1e6 m");
    const size_t wanted = grid.count() * grid.channels * 4;
    if (cursor.rest().size() != wanted)
        cursor.fail(Code::Parse, "found " + std::to_string(cursor.rest().size()) +
                                     " bytes of data; the header needs " + std::to_string(wanted));
}

uint32_t littleEndian(uint32_t word)
{
    if constexpr (std::endian::native == std::endian::little)
        return word;
    return (word >> 24) | ((word >> 8) & 0xFF00u) | ((word << 8) & 0xFF0000u) | (word << 24);
}

} // namespace

base::Result<std::shared_ptr<const FieldGrid>> parseFieldGrid(std::string_view bytes)
{
    auto grid = std::make_shared<FieldGrid>();
    Cursor cursor(bytes);
    readHeader(cursor, *grid);
    if (cursor.ok())
        checkHeader(cursor, *grid);
    if (!cursor.ok())
        return cursor.status();
    const std::string_view data = cursor.rest();
    grid->values.resize(grid->count() * grid->channels);
    for (size_t i = 0; i < grid->values.size(); ++i) {
        uint32_t word;
        std::memcpy(&word, data.data() + 4 * i, 4);
        grid->values[i] = std::bit_cast<float>(littleEndian(word));
        if (!std::isfinite(grid->values[i])) {
            cursor.fail(Code::InvalidArgument, "number " + std::to_string(i) + " of the data is not finite");
            return cursor.status();
        }
    }
    return std::shared_ptr<const FieldGrid>(std::move(grid));
}

std::string writeFieldGrid(const FieldGrid& grid)
{
    const auto text = [](float value) {
        char buffer[32];
        return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
    };
    const auto triple = [&](const glm::vec3& v) {
        return text(v.x) + " " + text(v.y) + " " + text(v.z) + "\n";
    };
    std::string bytes = "fxgrid 1\nnodes " + std::to_string(grid.nodes.x) + " " +
                        std::to_string(grid.nodes.y) + " " + std::to_string(grid.nodes.z) + "\nchannels " +
                        std::to_string(grid.channels) + "\nlow " + triple(grid.low) + "cell " +
                        triple(grid.cell) + "data\n";
    for (const float value : grid.values) {
        const uint32_t word = littleEndian(std::bit_cast<uint32_t>(value));
        bytes.append(reinterpret_cast<const char*>(&word), 4);
    }
    return bytes;
}

} // namespace fx::sim
