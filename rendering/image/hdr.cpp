#include "rendering/image/byte_cursor.h"
#include "rendering/image/image.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace fx::image {

namespace {

struct HdrSize
{
    int width = 0;
    int height = 0;
};

base::Status failure(const ByteCursor& cursor, const std::string& why)
{
    return {base::Code::Parse, "Radiance picture, byte " + std::to_string(cursor.position()) + ": " + why};
}

/// A number after `mark`, such as the 64 in "-Y 64".
std::optional<int> numberAfter(const std::string& line, const std::string& mark)
{
    const size_t at = line.find(mark);
    int value = 0;
    if (at == std::string::npos)
        return std::nullopt;
    const char* begin = line.data() + at + mark.size();
    if (std::from_chars(begin, line.data() + line.size(), value).ec != std::errc() || value <= 0)
        return std::nullopt;
    return value;
}

/// Reads "#?RADIANCE", variables, an empty line and the resolution; pictures are stored from the top left.
base::Result<HdrSize> readHeader(ByteCursor& cursor)
{
    std::optional<std::string> line = cursor.line(256);
    if (!line || !line->starts_with("#?"))
        return failure(cursor, "does not begin with #?RADIANCE");
    for (int i = 0; i < 64 && line && !line->empty(); ++i) {
        line = cursor.line(1024);
        if (line && line->starts_with("FORMAT=") && *line != "FORMAT=32-bit_rle_rgbe")
            return failure(cursor, "found " + line->substr(0, 40) + "; only FORMAT=32-bit_rle_rgbe is read");
    }
    line = cursor.line(256);
    if (!line)
        return failure(cursor, "the header does not end");
    const std::optional<int> height = numberAfter(*line, "-Y ");
    const std::optional<int> width = numberAfter(*line, "+X ");
    if (!height || !width || !line->starts_with("-Y "))
        return failure(cursor, "the resolution line must read -Y height +X width");
    if (*width > kLargestSide || *height > kLargestSide || uint64_t(*width) * uint64_t(*height) > kMaxPixels)
        return base::Status(base::Code::TooLarge,
                            "Radiance picture: " + std::to_string(*width) + " x " + std::to_string(*height) +
                                " pixels; at most 16384 a side and 33554432 in all are read");
    return HdrSize{*width, *height};
}

/// One channel of a run-length encoded row, bytes 4 apart.
bool readRuns(ByteCursor& cursor, uint8_t* out, int width)
{
    for (int x = 0; x < width;) {
        const std::optional<uint8_t> head = cursor.next();
        if (!head)
            return false;
        const bool isRun = *head > 128;
        const int count = isRun ? *head - 128 : *head;
        if (count == 0 || count > width - x)
            return false;
        std::optional<uint8_t> value;
        for (int i = 0; i < count; ++i, ++x) {
            if (i == 0 || !isRun)
                value = cursor.next();
            if (!value)
                return false;
            out[4 * x] = *value;
        }
    }
    return true;
}

/// One row of RGBE.
bool readRow(ByteCursor& cursor, std::vector<uint8_t>& row, int width)
{
    const std::optional<std::span<const std::byte>> first = cursor.take(4);
    if (!first)
        return false;
    for (size_t k = 0; k < 4; ++k)
        row[k] = uint8_t((*first)[k]);
    const bool isEncoded = width >= 8 && width < 32768 && row[0] == 2 && row[1] == 2 && row[2] < 128;
    if (isEncoded) {
        if (row[2] * 256 + row[3] != width)
            return false;
        for (size_t k = 0; k < 4; ++k)
            if (!readRuns(cursor, row.data() + k, width))
                return false;
        return true;
    }
    const std::optional<std::span<const std::byte>> rest = cursor.take(size_t(width - 1) * 4);
    if (!rest)
        return false;
    for (size_t i = 0; i < rest->size(); ++i)
        row[4 + i] = uint8_t((*rest)[i]);
    return true;
}

/// Bytes that a picture needs at least: an encoded row has 4 bytes and 2 for each run of at most 127.
uint64_t fewestBytes(const HdrSize& size)
{
    const uint64_t encoded = 4 + 4 * 2 * ((uint64_t(size.width) + 126) / 127);
    return uint64_t(size.height) * std::min<uint64_t>(encoded, 4 * uint64_t(size.width));
}

} // namespace

base::Result<Image> readHdr(std::span<const std::byte> bytes)
{
    ByteCursor cursor(bytes);
    const base::Result<HdrSize> size = readHeader(cursor);
    if (!size)
        return size.status();
    if (cursor.remaining() < fewestBytes(*size))
        return failure(cursor, "the file is too short for its resolution");
    Image image{size->width, size->height, 3, {}};
    image.pixels.resize(size_t(size->width) * size_t(size->height) * 3);
    std::vector<uint8_t> row(size_t(size->width) * 4);
    for (int y = 0; y < size->height; ++y) {
        if (!readRow(cursor, row, size->width))
            return failure(cursor, "row " + std::to_string(y) + " is damaged");
        for (int x = 0; x < size->width; ++x) {
            const uint8_t* rgbe = row.data() + 4 * size_t(x);
            const float scale =
                rgbe[3] == 0 ? 0.0f : std::ldexp(1.0f, rgbe[3] - 136); // 128 + 8 bits of mantissa
            for (int k = 0; k < 3; ++k)
                image.at(x, y)[k] = float(rgbe[k]) * scale;
        }
    }
    return image;
}

} // namespace fx::image
