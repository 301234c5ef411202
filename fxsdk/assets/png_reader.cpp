#include "fxsdk/assets/png_reader.h"

#include "foundation/assets/asset_table.h"
#include "fxsdk/assets/stb_png.h"

#include <array>
#include <cstring>
#include <string>
#include <string_view>

namespace fx::asset {

namespace {

constexpr uint64_t kLargestRatio = 1032; ///< deflate cannot shrink more
constexpr size_t kMaxFileBytes = size_t(1) << 30;
constexpr size_t kPaletteBytes = 3 * 256;
constexpr size_t kChunkBytes = 12; ///< of length, name and sum
constexpr uint8_t kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr uint8_t kPaletteType = 3;

base::Status damaged(const std::string& why)
{
    return {base::Code::Parse, "PNG: " + why};
}

uint32_t big32(const uint8_t* p)
{
    return uint32_t(p[0]) << 24 | uint32_t(p[1]) << 16 | uint32_t(p[2]) << 8 | p[3];
}

constexpr std::array<uint32_t, 256> kCrcTable = [] {
    std::array<uint32_t, 256> made{};
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t c = i;
        for (int bit = 0; bit < 8; ++bit)
            c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
        made[i] = c;
    }
    return made;
}();

uint32_t crc32(std::span<const uint8_t> bytes)
{
    uint32_t crc = ~0u;
    for (const uint8_t byte : bytes)
        crc = kCrcTable[(crc ^ byte) & 255] ^ (crc >> 8);
    return ~crc;
}

/// What the header says.
struct Header
{
    uint32_t width = 0, height = 0;
    uint8_t depth = 0, colorType = 0;

    uint64_t rowBytes() const
    {
        const uint64_t channels = colorType == 2 ? 3 : colorType == 4 ? 2 : colorType == 6 ? 4 : 1;
        return (uint64_t(width) * channels * depth + 7) / 8;
    }
};

base::Status checkHeader(std::span<const uint8_t> data, size_t fileBytes, Header& out)
{
    if (data.size() != 13)
        return damaged("the header has a wrong size");
    out = {big32(&data[0]), big32(&data[4]), data[8], data[9]};
    if (out.width == 0 || out.height == 0)
        return damaged("the header names a picture without texels");
    const auto most = uint32_t(base::AssetTable::kLargestSide);
    if (out.width > most || out.height > most)
        return {base::Code::TooLarge, "PNG: " + std::to_string(out.width) + " x " +
                                          std::to_string(out.height) + " texels; at most " +
                                          std::to_string(most) + " a side are read: scale it down"};
    if (out.rowBytes() * out.height > kLargestRatio * fileBytes)
        return {base::Code::TooLarge, "PNG: the header promises more than the file can hold"};
    return {};
}

/// Goes through the chunks as far as stb_image does not: their sums and lengths, the sizes of the header.
class Chunks
{
public:
    explicit Chunks(std::span<const uint8_t> file) : file_(file) {}

    base::Status check()
    {
        if (file_.size() < 8 || std::memcmp(file_.data(), kSignature, 8) != 0)
            return damaged("the signature is missing; is it really a PNG file?");
        bool ended = false;
        for (size_t at = 8; !ended;) {
            if (file_.size() - at < kChunkBytes)
                return damaged("the file ends too early");
            const size_t length = big32(&file_[at]);
            if (length > file_.size() - at - kChunkBytes)
                return damaged("a chunk is longer than the file");
            const std::span<const uint8_t> named = file_.subspan(at + 4, length + 4);
            if (crc32(named) != big32(&file_[at + 8 + length]))
                return damaged("a chunk is damaged (check sum)");
            const std::string_view name(reinterpret_cast<const char*>(named.data()), 4);
            if (base::Status status = checkChunk(name, at, named.subspan(4)); !status)
                return status;
            ended = name == "IEND";
            at += length + kChunkBytes;
        }
        return {};
    }

    const Header& header() const { return header_; }
    bool mustBeChanged() const { return header_.colorType == kPaletteType || !emptyAt_.empty(); }

    /// The file as stb_image reads it right: with a palette of 256 colors, since it takes texels that name no
    /// color of a shorter one from memory that it has not written; and without empty chunks before the
    /// picture's data, of which it would copy nothing to nowhere.
    std::vector<uint8_t> changed() const
    {
        std::vector<uint8_t> copy;
        copy.reserve(file_.size() + kPaletteBytes);
        size_t from = 0, paletteAt = paletteAt_;
        const auto append = [&](size_t end) {
            copy.insert(copy.end(), file_.begin() + std::ptrdiff_t(from),
                        file_.begin() + std::ptrdiff_t(end));
        };
        for (const size_t at : emptyAt_) {
            append(at);
            from = at + kChunkBytes;
            if (at < paletteAt_)
                paletteAt -= kChunkBytes;
        }
        append(file_.size());
        fillPalette(copy, paletteAt);
        return copy;
    }

private:
    static void fillPalette(std::vector<uint8_t>& file, size_t at)
    {
        const size_t length = at ? big32(&file[at]) : kPaletteBytes;
        if (length >= kPaletteBytes)
            return;
        const auto end = std::ptrdiff_t(at + 8 + length);
        file.insert(file.begin() + end, kPaletteBytes - length, uint8_t(0));
        file[at + 2] = uint8_t(kPaletteBytes >> 8); // the sum is wrong now, which stb_image ignores
        file[at + 3] = uint8_t(kPaletteBytes & 255);
    }

    base::Status checkChunk(std::string_view name, size_t at, std::span<const uint8_t> data)
    {
        if ((at == 8) != (name == "IHDR"))
            return damaged("the header is not the first chunk");
        if (name == "IHDR")
            return checkHeader(data, file_.size(), header_);
        if (name == "PLTE") {
            if (paletteAt_ != 0 || data.size() % 3 != 0 || data.empty())
                return damaged("the palette has a wrong size or comes twice");
            paletteAt_ = at;
        } else if (name == "IDAT") {
            hasData_ = hasData_ || !data.empty();
            if (!hasData_)
                emptyAt_.push_back(at);
        } else if (!(name[0] & 0x20) && name != "IEND") {
            return damaged("an unknown chunk is needed to understand it");
        }
        return {};
    }

    std::span<const uint8_t> file_;
    Header header_;
    size_t paletteAt_ = 0; ///< place of its length; 0: there is none
    std::vector<size_t>
        emptyAt_; ///< places of chunks of data that are empty and have none with data before them
    bool hasData_ = false;
};

} // namespace

base::Result<PngPicture> readPng(std::span<const uint8_t> file)
{
    if (file.size() > kMaxFileBytes)
        return base::Status(base::Code::TooLarge, "PNG: the file is larger than 1 GiB");
    Chunks chunks(file);
    if (base::Status status = chunks.check(); !status)
        return status;
    const Header& header = chunks.header();
    const bool isDeep = header.depth == 16;
    const size_t texels = size_t(header.width) * header.height;
    // The packed data and the unpacked, each in a block that grows by doubling.
    const size_t mostBytes = 2 * file.size() + 2 * (texels * (isDeep ? 8 : 4) + 2 * header.height) + 65'536;
    std::vector<uint8_t> copy;
    if (chunks.mustBeChanged())
        copy = chunks.changed();
    auto rgba =
        unpackPng(copy.empty() ? file : copy, isDeep, int(header.width), int(header.height), mostBytes);
    if (!rgba)
        return rgba.status();
    return PngPicture{int(header.width), int(header.height), std::move(*rgba)};
}

} // namespace fx::asset
