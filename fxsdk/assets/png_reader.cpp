#include "fxsdk/assets/png_reader.h"

#include "foundation/assets/asset_table.h"
#include "fxsdk/assets/inflate.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <string>

namespace fx::asset {

namespace {

constexpr uint64_t kLargestRatio = 1032; ///< deflate cannot shrink more
constexpr uint8_t kSignature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

base::Status damaged(const std::string& why)
{
    return {base::Code::Parse, "PNG: " + why};
}

uint32_t big32(const uint8_t* p)
{
    return uint32_t(p[0]) << 24 | uint32_t(p[1]) << 16 | uint32_t(p[2]) << 8 | p[3];
}

uint32_t crc32(std::span<const uint8_t> bytes)
{
    static const auto table = [] {
        std::array<uint32_t, 256> made{};
        for (uint32_t i = 0; i < 256; ++i) {
            uint32_t c = i;
            for (int bit = 0; bit < 8; ++bit)
                c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
            made[i] = c;
        }
        return made;
    }();
    uint32_t crc = ~0u;
    for (const uint8_t byte : bytes)
        crc = table[(crc ^ byte) & 255] ^ (crc >> 8);
    return ~crc;
}

enum ColorType : uint8_t
{
    Gray = 0,
    Rgb = 2,
    Palette = 3,
    GrayAlpha = 4,
    RgbAlpha = 6,
};

/// What the chunks before the data say.
struct Header
{
    uint32_t width = 0, height = 0;
    uint8_t depth = 0, colorType = 0, interlace = 0;
    std::array<std::array<uint8_t, 4>, 256> palette{};
    size_t paletteSize = 0;
    bool hasKey = false; ///< one color is transparent
    std::array<uint16_t, 3> key{};

    size_t channels() const
    {
        return colorType == Rgb ? 3 : colorType == GrayAlpha ? 2 : colorType == RgbAlpha ? 4 : 1;
    }
    size_t rowBytes(uint32_t columns) const { return (size_t(columns) * channels() * depth + 7) / 8; }
};

/// Texels of one interlacing pass: the whole picture when there is none.
struct Pass
{
    uint32_t x0, y0, dx, dy;
    uint32_t columns(const Header& h) const { return h.width > x0 ? (h.width - x0 + dx - 1) / dx : 0; }
    uint32_t rows(const Header& h) const { return h.height > y0 ? (h.height - y0 + dy - 1) / dy : 0; }
};
constexpr Pass kWhole[1] = {{0, 0, 1, 1}};
constexpr Pass kAdam7[7] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                            {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};

class Reader
{
public:
    explicit Reader(std::span<const uint8_t> file) : file_(file) {}

    base::Result<PngPicture> read()
    {
        if (base::Status status = readChunks(); !status)
            return status;
        const std::span<const Pass> passes = h_.interlace ? std::span<const Pass>(kAdam7) : kWhole;
        size_t rawBytes = 0;
        for (const Pass& pass : passes)
            if (pass.columns(h_) > 0)
                rawBytes += (h_.rowBytes(pass.columns(h_)) + 1) * pass.rows(h_);
        std::vector<uint8_t> raw(rawBytes);
        if (base::Status status = inflateZlib(packed_, raw); !status)
            return damaged(status.message());
        PngPicture picture{int(h_.width), int(h_.height), {}};
        picture.rgba.resize(size_t(h_.width) * h_.height * 4);
        uint8_t* at = raw.data();
        for (const Pass& pass : passes) {
            if (pass.columns(h_) == 0)
                continue;
            if (base::Status status = readPass(pass, at, picture); !status)
                return status;
        }
        return picture;
    }

private:
    base::Status readChunks()
    {
        if (file_.size() < 8 || std::memcmp(file_.data(), kSignature, 8) != 0)
            return damaged("the signature is missing; is it really a PNG file?");
        bool ended = false;
        for (size_t at = 8; !ended;) {
            if (file_.size() - at < 12)
                return damaged("the file ends too early");
            const size_t length = big32(&file_[at]);
            if (length > file_.size() - at - 12)
                return damaged("a chunk is longer than the file");
            const std::span<const uint8_t> named = file_.subspan(at + 4, length + 4);
            if (crc32(named) != big32(&file_[at + 8 + length]))
                return damaged("a chunk is damaged (check sum)");
            const std::string_view name(reinterpret_cast<const char*>(named.data()), 4);
            if ((at == 8) != (name == "IHDR"))
                return damaged("the header is not the first chunk");
            ended = name == "IEND";
            if (base::Status status = readChunk(name, named.subspan(4)); !status)
                return status;
            at += length + 12;
        }
        if (h_.colorType == Palette && h_.paletteSize == 0)
            return damaged("the palette is missing");
        return packed_.empty() ? damaged("there are no image data") : base::Status();
    }

    base::Status readChunk(std::string_view name, std::span<const uint8_t> data)
    {
        if (name == "IHDR")
            return readHeader(data);
        if (name == "PLTE") {
            if (data.size() % 3 != 0 || data.size() > 768 || data.empty())
                return damaged("the palette has a wrong size");
            h_.paletteSize = data.size() / 3;
            for (size_t i = 0; i < h_.paletteSize; ++i)
                h_.palette[i] = {data[3 * i], data[3 * i + 1], data[3 * i + 2], 255};
        } else if (name == "tRNS") {
            readTransparency(data);
        } else if (name == "IDAT") {
            packed_.insert(packed_.end(), data.begin(), data.end());
        } else if (!(name[0] & 0x20) && name != "IEND") {
            return damaged("an unknown chunk is needed to understand it");
        }
        return {};
    }

    base::Status readHeader(std::span<const uint8_t> data)
    {
        if (data.size() != 13)
            return damaged("the header has a wrong size");
        h_.width = big32(&data[0]);
        h_.height = big32(&data[4]);
        h_.depth = data[8];
        h_.colorType = data[9];
        h_.interlace = data[12];
        const bool deep = h_.depth == 8 || h_.depth == 16;
        const bool shallow = h_.depth == 1 || h_.depth == 2 || h_.depth == 4;
        const bool known =
            h_.colorType == Gray ? deep || shallow
            : h_.colorType == Palette
                ? shallow || h_.depth == 8
                : deep && (h_.colorType == Rgb || h_.colorType == GrayAlpha || h_.colorType == RgbAlpha);
        if (!known || data[10] != 0 || data[11] != 0 || h_.interlace > 1 || h_.width == 0 || h_.height == 0)
            return damaged("the header names a kind of picture that does not exist");
        const auto most = uint32_t(base::AssetTable::kLargestSide);
        if (h_.width > most || h_.height > most)
            return {base::Code::TooLarge, "PNG: " + std::to_string(h_.width) + " x " +
                                              std::to_string(h_.height) + " texels; at most " +
                                              std::to_string(most) + " a side are read: scale it down"};
        if (uint64_t(h_.rowBytes(h_.width)) * h_.height > kLargestRatio * file_.size())
            return {base::Code::TooLarge, "PNG: the header promises more than the file can hold"};
        return {};
    }

    void readTransparency(std::span<const uint8_t> data)
    {
        if (h_.colorType == Palette) {
            for (size_t i = 0; i < std::min(data.size(), h_.palette.size()); ++i)
                h_.palette[i][3] = data[i];
            return;
        }
        const size_t count = h_.colorType == Rgb ? 3 : h_.colorType == Gray ? 1 : 0;
        h_.hasKey = count > 0 && data.size() == 2 * count;
        for (size_t i = 0; h_.hasKey && i < 3; ++i)
            h_.key[i] = uint16_t(data[count == 3 ? 2 * i : 0] << 8 | data[count == 3 ? 2 * i + 1 : 1]);
    }

    base::Status readPass(const Pass& pass, uint8_t*& at, PngPicture& picture)
    {
        const uint32_t columns = pass.columns(h_);
        const size_t bytes = h_.rowBytes(columns);
        const size_t step = std::max<size_t>(h_.channels() * h_.depth / 8, 1);
        const std::vector<uint8_t> zeros(bytes, 0);
        const uint8_t* above = zeros.data();
        for (uint32_t row = 0; row < pass.rows(h_); ++row) {
            const uint8_t filter = *at++;
            if (filter > 4)
                return damaged("a row has an unknown filter");
            unfilter(filter, at, above, bytes, step);
            uint8_t* out = &picture.rgba[(size_t(pass.y0 + row * pass.dy) * h_.width + pass.x0) * 4];
            for (uint32_t x = 0; x < columns; ++x, out += size_t(4) * pass.dx)
                if (!texel(at, x, out))
                    return damaged("a texel names a color that the palette does not have");
            above = at;
            at += bytes;
        }
        return {};
    }

    static void unfilter(uint8_t filter, uint8_t* row, const uint8_t* above, size_t bytes, size_t step)
    {
        for (size_t i = 0; i < bytes; ++i) {
            const int a = i >= step ? row[i - step] : 0;
            const int b = above[i];
            const int c = i >= step ? above[i - step] : 0;
            const int pa = std::abs(b - c);
            const int pb = std::abs(a - c);
            const int pc = std::abs(a + b - 2 * c);
            const int paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
            const int guess = filter == 0   ? 0
                              : filter == 1 ? a
                              : filter == 2 ? b
                              : filter == 3 ? (a + b) / 2
                                            : paeth;
            row[i] = uint8_t(row[i] + guess);
        }
    }

    uint32_t sample(const uint8_t* row, size_t index) const
    {
        if (h_.depth == 16)
            return uint32_t(row[2 * index]) << 8 | row[2 * index + 1];
        if (h_.depth == 8)
            return row[index];
        const size_t bit = index * h_.depth;
        return uint32_t(row[bit / 8] >> (8 - h_.depth - bit % 8)) & ((1u << h_.depth) - 1);
    }

    uint8_t eightBits(uint32_t value) const
    {
        const uint32_t most = (1u << h_.depth) - 1;
        return uint8_t((value * 255 + most / 2) / most);
    }

    bool texel(const uint8_t* row, uint32_t x, uint8_t* out) const
    {
        const size_t channels = h_.channels();
        std::array<uint32_t, 4> v{};
        for (size_t k = 0; k < channels; ++k)
            v[k] = sample(row, x * channels + k);
        if (h_.colorType == Palette) {
            if (v[0] >= h_.paletteSize)
                return false;
            std::copy_n(h_.palette[v[0]].begin(), 4, out);
            return true;
        }
        const bool gray = channels < 3;
        for (size_t k = 0; k < 3; ++k)
            out[k] = eightBits(v[gray ? 0 : k]);
        const bool hasAlpha = channels == 2 || channels == 4;
        const bool isKey =
            h_.hasKey && v[0] == h_.key[0] && (gray || (v[1] == h_.key[1] && v[2] == h_.key[2]));
        out[3] = hasAlpha ? eightBits(v[channels - 1]) : isKey ? uint8_t(0) : uint8_t(255);
        return true;
    }

    std::span<const uint8_t> file_;
    Header h_;
    std::vector<uint8_t> packed_;
};

} // namespace

base::Result<PngPicture> readPng(std::span<const uint8_t> file)
{
    return Reader(file).read();
}

} // namespace fx::asset
