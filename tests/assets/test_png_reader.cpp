// The reader against libspng on every kind of PNG, and on damaged ones.
#include "foundation/random/philox.h"
#include "fxsdk/assets/png_reader.h"
#include "rendering/image/image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace fx;
using Bytes = std::vector<uint8_t>;

namespace {

/// Repeatable noise.
class Noise
{
public:
    explicit Noise(uint64_t seed) : seed_(seed) {}
    uint8_t byte()
    {
        return uint8_t(base::randomUnit4(seed_, 0, next_++, base::RandomPurpose::Position)[0] * 255.99f);
    }

private:
    uint64_t seed_;
    uint64_t next_ = 0;
};

void addBig32(Bytes& out, uint32_t v)
{
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(uint8_t(v >> shift));
}

uint32_t crcOf(const Bytes& bytes, size_t begin)
{
    uint32_t crc = ~0u;
    for (size_t i = begin; i < bytes.size(); ++i) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc & 1 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
    }
    return ~crc;
}

void addChunk(Bytes& out, const char* name, const Bytes& data)
{
    addBig32(out, uint32_t(data.size()));
    const size_t begin = out.size();
    out.insert(out.end(), name, name + 4);
    out.insert(out.end(), data.begin(), data.end());
    addBig32(out, crcOf(out, begin));
}

/// zlib without packing.
Bytes storedZlib(const Bytes& raw)
{
    Bytes out{0x78,
              0x01,
              1,
              uint8_t(raw.size()),
              uint8_t(raw.size() >> 8),
              uint8_t(~raw.size()),
              uint8_t(~raw.size() >> 8)};
    uint32_t a = 1;
    uint32_t b = 0;
    for (const uint8_t byte : raw) {
        out.push_back(byte);
        a = (a + byte) % 65521;
        b = (b + a) % 65521;
    }
    addBig32(out, b << 16 | a);
    return out;
}

struct Kind
{
    uint8_t depth, colorType;
    bool interlaced, key;
};

/// A picture of noise: any bytes are texels, any filter may stand before a row.
Bytes noisePng(const Kind& kind, uint32_t width, uint32_t height, uint64_t seed)
{
    Noise noise(seed);
    const size_t channels = kind.colorType == 2 ? 3 : kind.colorType == 4 ? 2 : kind.colorType == 6 ? 4 : 1;
    Bytes raw;
    const uint32_t x0[7] = {0, 4, 0, 2, 0, 1, 0}, y0[7] = {0, 0, 4, 0, 2, 0, 1};
    const uint32_t dx[7] = {8, 8, 4, 4, 2, 2, 1}, dy[7] = {8, 8, 8, 4, 4, 2, 2};
    for (size_t pass = 0; pass < (kind.interlaced ? 7u : 1u); ++pass) {
        const uint32_t columns =
            kind.interlaced ? (width - std::min(width, x0[pass]) + dx[pass] - 1) / dx[pass] : width;
        const uint32_t rows =
            kind.interlaced ? (height - std::min(height, y0[pass]) + dy[pass] - 1) / dy[pass] : height;
        for (uint32_t row = 0; columns > 0 && row < rows; ++row) {
            raw.push_back(uint8_t(noise.byte() % 5));
            for (size_t i = 0; i < (columns * channels * kind.depth + 7) / 8; ++i)
                raw.push_back(noise.byte());
        }
    }
    Bytes header;
    addBig32(header, width);
    addBig32(header, height);
    header.insert(header.end(), {kind.depth, kind.colorType, 0, 0, uint8_t(kind.interlaced)});
    Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(out, "IHDR", header);
    if (kind.colorType == 3) {
        Bytes palette;
        for (size_t i = 0; i < 3 * (size_t(1) << kind.depth); ++i)
            palette.push_back(noise.byte());
        addChunk(out, "PLTE", palette);
    }
    if (kind.key)
        addChunk(out, "tRNS",
                 kind.colorType == 3   ? Bytes{0, 100}
                 : kind.colorType == 0 ? Bytes{0, 1}
                                       : Bytes{0, 1, 0, 2, 0, 3});
    addChunk(out, "IDAT", storedZlib(raw));
    addChunk(out, "IEND", {});
    return out;
}

void expectEqualToLibspng(const Bytes& file, const std::string& what)
{
    const auto ours = asset::readPng(file);
    const auto theirs = image::readPng(std::as_bytes(std::span(file)));
    ASSERT_TRUE(ours.ok()) << what << ": " << ours.status().message();
    ASSERT_TRUE(theirs.ok()) << what << ": " << theirs.status().message();
    ASSERT_EQ(ours->width, theirs->width);
    ASSERT_EQ(ours->height, theirs->height);
    for (int y = 0; y < ours->height; ++y)
        for (int x = 0; x < ours->width; ++x)
            for (int k = 0; k < 4; ++k) {
                const uint8_t* texel = &ours->rgba[(size_t(y) * size_t(ours->width) + size_t(x)) * 4];
                const float alpha = theirs->channels == 4 ? theirs->at(x, y)[3] : 1.0f;
                const float value = k == 3 ? alpha : image::linearToSrgb(theirs->at(x, y)[k]);
                ASSERT_NEAR(float(texel[k]), value * 255.0f, 0.502f)
                    << what << " at " << x << ", " << y << " channel " << k;
            }
}

Bytes asBytes(const std::vector<std::byte>& bytes)
{
    const auto* begin = reinterpret_cast<const uint8_t*>(bytes.data());
    return {begin, begin + bytes.size()};
}

Bytes packedPng(int side)
{
    image::Image picture{side, side, 4, {}};
    for (int i = 0; i < side * side * 4; ++i)
        picture.pixels.push_back(0.5f +
                                 0.5f * std::sin(float(i) * 0.01f) * std::cos(float(i / side) * 0.03f));
    return asBytes(*image::writePng(picture));
}

} // namespace

TEST(PngReader, agreesWithLibspngOnEveryKindOfPicture)
{
    const Kind kinds[] = {
        {1, 0, false, false},  {2, 0, false, true},   {4, 0, false, false}, {8, 0, false, true},
        {16, 0, false, false}, {8, 2, false, false},  {8, 2, false, true},  {16, 2, false, false},
        {1, 3, false, true},   {2, 3, false, false},  {4, 3, false, true},  {8, 3, false, true},
        {8, 4, false, false},  {16, 4, false, false}, {8, 6, false, false}, {16, 6, false, false}};
    uint64_t seed = 1;
    for (Kind kind : kinds)
        for (const bool interlaced : {false, true})
            for (const auto& [width, height] : {std::pair{1u, 1u}, {5u, 3u}, {17u, 12u}, {3u, 9u}}) {
                kind.interlaced = interlaced;
                expectEqualToLibspng(noisePng(kind, width, height, seed++),
                                     "depth " + std::to_string(kind.depth) + " type " +
                                         std::to_string(kind.colorType) +
                                         (interlaced ? " interlaced " : " ") + std::to_string(width));
            }
}

TEST(PngReader, agreesWithLibspngOnPackedPictures)
{
    for (const int side : {2, 33, 200})
        expectEqualToLibspng(packedPng(side), "side " + std::to_string(side));
}

TEST(PngReader, damageIsFoundWhereverItIs)
{
    const Bytes good = packedPng(24);
    for (size_t at = 0; at < good.size(); ++at) {
        Bytes bad = good;
        bad[at] ^= uint8_t(1 << at % 8);
        EXPECT_FALSE(asset::readPng(bad).ok()) << "byte " << at; // every byte is under a check sum
        EXPECT_FALSE(asset::readPng(std::span(good).first(at)).ok()) << at << " bytes";
    }
}

TEST(PngReader, aHeaderThatPromisesTooMuchIsRefusedBeforeAnythingIsUnpacked)
{
    Bytes huge = noisePng({8, 6, false, false}, 1, 1, 3);
    const auto setWidth = [&](uint32_t width) {
        for (size_t i = 0; i < 4; ++i)
            huge[16 + i] = uint8_t(width >> (24 - 8 * i));
        Bytes sum;
        addBig32(sum, crcOf(Bytes(huge.begin(), huge.begin() + 29), 12));
        std::copy(sum.begin(), sum.end(), huge.begin() + 29);
    };
    setWidth(9000);
    EXPECT_EQ(asset::readPng(huge).status().code(), base::Code::TooLarge);
    setWidth(0x7FFFFFFF);
    EXPECT_EQ(asset::readPng(huge).status().code(), base::Code::TooLarge);
    setWidth(0);
    EXPECT_EQ(asset::readPng(huge).status().code(), base::Code::Parse);
    setWidth(2);
    EXPECT_EQ(asset::readPng(huge).status().code(), base::Code::Parse) << "too few data";
}

/// One texel of a palette picture, `index`, with a palette of a single color.
Bytes onePaletteTexel(uint8_t index)
{
    Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(out, "IHDR", {0, 0, 0, 1, 0, 0, 0, 1, 8, 3, 0, 0, 0});
    addChunk(out, "PLTE", {10, 20, 30});
    addChunk(out, "IDAT", storedZlib({0, index}));
    addChunk(out, "IEND", {});
    return out;
}

/// The picture's data after `count` chunks of data that are empty, which the standard allows.
Bytes afterEmptyChunks(Bytes file, size_t count)
{
    Bytes empty;
    for (size_t i = 0; i < count; ++i)
        addChunk(empty, "IDAT", {});
    constexpr std::array<uint8_t, 4> kName{'I', 'D', 'A', 'T'};
    const auto name = std::search(file.begin(), file.end(), kName.begin(), kName.end());
    file.insert(name - 4, empty.begin(), empty.end());
    return file;
}

TEST(PngReader, emptyChunksBeforeTheDataChangeNothing)
{
    for (const Bytes& file :
         {noisePng({8, 6, false, false}, 5, 3, 1), onePaletteTexel(0), onePaletteTexel(200)})
        for (const size_t count : {1u, 3u})
            EXPECT_EQ(asset::readPng(afterEmptyChunks(file, count))->rgba, asset::readPng(file)->rgba);
}

TEST(PngReader, aPictureWithoutDataIsRefused)
{
    Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(file, "IHDR", {0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0});
    addChunk(file, "IDAT", {});
    addChunk(file, "IEND", {});
    EXPECT_EQ(int(asset::readPng(file).status().code()), int(base::Code::Parse));
}

TEST(PngReader, aColorThatThePaletteLacksIsBlack)
{
    EXPECT_EQ(asset::readPng(onePaletteTexel(0))->rgba, (Bytes{10, 20, 30, 255}));
    EXPECT_EQ(asset::readPng(onePaletteTexel(200))->rgba, (Bytes{0, 0, 0, 255}));
}

/// zlib stream of 1 + 258 `repeats` zeros: fixed codes for one zero, then "258 times what came last".
Bytes packedZeros(size_t repeats)
{
    Bytes out{0x78, 0x01};
    size_t filled = 0;
    const auto add = [&](uint32_t bits, int count) { // the first of `count` bits is the highest
        for (int i = count - 1; i >= 0; --i, ++filled) {
            if (filled % 8 == 0)
                out.push_back(0);
            out.back() |= uint8_t((bits >> i & 1) << filled % 8);
        }
    };
    add(0b110, 3); // last block, fixed codes
    add(0x30, 8);
    for (size_t i = 0; i < repeats; ++i)
        add(0xC5u << 5, 13);
    add(0, 7);
    const uint32_t length = uint32_t(1 + 258 * repeats);
    addBig32(out, ((length % 65521) << 16) | 1);
    return out;
}

Bytes grayPng(uint8_t width, uint8_t height, const Bytes& packed)
{
    Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(out, "IHDR", {0, 0, 0, width, 0, 0, 0, height, 8, 0, 0, 0, 0});
    addChunk(out, "IDAT", packed);
    addChunk(out, "IEND", {});
    return out;
}

TEST(PngReader, dataThatUnpackToFarMoreThanThePictureNeedAreRefused)
{
    EXPECT_TRUE(asset::readPng(grayPng(36, 7, packedZeros(1))).ok()) << "7 rows of 37 bytes";
    const Bytes bomb = grayPng(36, 7, packedZeros(65'000)); // 16 MB
    EXPECT_LT(bomb.size(), 120'000u);
    EXPECT_EQ(asset::readPng(bomb).status().code(), base::Code::Parse);
}

TEST(PngReader, damagedDataAreRefusedWhereTheUnpackerGivesNoReason)
{
    Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    addChunk(file, "IHDR", {0, 0, 0, 2, 0, 0, 0, 1, 8, 6, 0, 0, 0});
    addChunk(file, "IDAT",
             {0x78, 0xDA, 0x2A, 0xF8, 0xCF, 0xC0, 0x00, 0x42, 0x0D, 0x00, 0x0F, 0x7A, 0x03, 0x7E});
    addChunk(file, "IEND", {});
    const auto image = asset::readPng(file);
    ASSERT_FALSE(image.ok());
    EXPECT_NE(image.status().message().find("its data are damaged"), std::string::npos)
        << image.status().message();
}

TEST(PngReader, noiseInsteadOfPackedDataIsRefusedWithoutHarm)
{
    for (uint64_t seed = 0; seed < 3000; ++seed) {
        Noise noise(seed);
        Bytes packed{0x78, 0x01};
        for (int i = 0; i < 60; ++i)
            packed.push_back(noise.byte());
        Bytes out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
        addChunk(out, "IHDR", {0, 0, 0, 20, 0, 0, 0, 20, 8, 6, 0, 0, uint8_t(seed % 2)});
        addChunk(out, "IDAT", packed);
        addChunk(out, "IEND", {});
        EXPECT_FALSE(asset::readPng(out).ok());
    }
}
