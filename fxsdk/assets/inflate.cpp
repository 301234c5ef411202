#include "fxsdk/assets/inflate.h"

#include <algorithm>
#include <array>

namespace fx::asset {

namespace {

constexpr int kLongestCode = 15; ///< [bit]
constexpr int kTableBits = 10;   ///< codes up to this length are found in one step
constexpr uint32_t kSymbols = 288;

/// Bits from the lowest of each byte on. Behind the end it gives zeros and remembers that.
class BitReader
{
public:
    explicit BitReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    uint32_t peek(int count)
    {
        while (held_ < count) {
            const uint64_t byte = at_ < bytes_.size() ? bytes_[at_] : 0;
            ++at_;
            bits_ |= byte << held_;
            held_ += 8;
        }
        return uint32_t(bits_ & ((uint64_t(1) << count) - 1));
    }
    void skip(int count)
    {
        bits_ >>= count;
        held_ -= count;
    }
    uint32_t take(int count)
    {
        const uint32_t value = peek(count);
        skip(count);
        return value;
    }
    void toByte() { skip(held_ % 8); }
    bool pastEnd() const { return at_ - size_t(held_ / 8) > bytes_.size(); }

private:
    std::span<const uint8_t> bytes_;
    size_t at_ = 0;
    uint64_t bits_ = 0;
    int held_ = 0;
};

/// A canonical Huffman code.
class Code
{
public:
    /// @param lengths [bit] of each symbol's code, 0 for unused  @return false when no such code exists
    bool build(std::span<const uint8_t> lengths)
    {
        count_.fill(0);
        for (const uint8_t length : lengths)
            ++count_[length];
        count_[0] = 0;
        int left = 1; // codes of the present length that are still free
        std::array<uint16_t, kLongestCode + 2> first{};
        for (size_t length = 1; length <= kLongestCode; ++length) {
            left = 2 * left - count_[length];
            if (left < 0)
                return false;
            first[length + 1] = uint16_t(first[length] + count_[length]);
        }
        for (size_t symbol = 0; symbol < lengths.size(); ++symbol)
            if (lengths[symbol])
                symbols_[first[lengths[symbol]]++] = uint16_t(symbol);
        fillTable();
        return true;
    }

    /// The next symbol; -1 for bits that no code begins with.
    int decode(BitReader& in) const
    {
        const uint16_t entry = table_[in.peek(kTableBits)];
        if (entry) {
            in.skip(entry & 15);
            return entry >> 4;
        }
        return decodeSlowly(in);
    }

private:
    void fillTable()
    {
        table_.fill(0);
        uint32_t code = 0;
        size_t index = 0;
        for (size_t length = 1; length <= kTableBits; ++length, code <<= 1)
            for (uint32_t i = 0; i < count_[length]; ++i, ++code, ++index) {
                uint32_t reversed = 0; // codes come with their highest bit first
                for (size_t bit = 0; bit < length; ++bit)
                    reversed |= (code >> bit & 1) << (length - 1 - bit);
                for (uint32_t at = reversed; at < table_.size(); at += 1u << length)
                    table_[at] = uint16_t(symbols_[index] << 4 | length);
            }
    }

    int decodeSlowly(BitReader& in) const
    {
        const uint32_t bits = in.peek(kLongestCode);
        int code = 0;
        int first = 0;
        int index = 0;
        for (int length = 1; length <= kLongestCode; ++length) {
            code |= int(bits >> (length - 1) & 1);
            const int count = count_[size_t(length)];
            if (code - count < first) {
                in.skip(length);
                return symbols_[size_t(index + code - first)];
            }
            index += count;
            first = (first + count) << 1;
            code <<= 1;
        }
        return -1;
    }

    std::array<uint16_t, kLongestCode + 1> count_{};
    std::array<uint16_t, kSymbols> symbols_{};
    std::array<uint16_t, size_t(1) << kTableBits> table_{}; ///< symbol * 16 + length; 0: a longer code
};

constexpr std::array<uint16_t, 29> kLengthBase{3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                               15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                               67, 83, 99, 115, 131, 163, 195, 227, 258};
constexpr std::array<uint8_t, 29> kLengthExtra{0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                               2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
constexpr std::array<uint16_t, 30> kDistanceBase{
    1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
    193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
constexpr std::array<uint8_t, 30> kDistanceExtra{0, 0, 0, 0, 1, 1, 2, 2,  3,  3,  4,  4,  5,  5,  6,
                                                 6, 7, 7, 8, 8, 9, 9, 10, 10, 11, 11, 12, 12, 13, 13};

/// One stream.
class Inflater
{
public:
    Inflater(std::span<const uint8_t> in, std::span<uint8_t> out) : in_(in), out_(out) {}

    const char* run()
    {
        const uint32_t method = in_.take(8);
        const uint32_t flags = in_.take(8);
        if ((method & 15) != 8 || (method * 256 + flags) % 31 != 0 || (flags & 32))
            return "the data are no zlib stream";
        for (bool last = false; !last;) {
            last = in_.take(1) != 0;
            const uint32_t kind = in_.take(2);
            const char* fault = kind == 0   ? stored()
                                : kind == 1 ? fixed()
                                : kind == 2 ? dynamic()
                                            : "the data are damaged (block kind)";
            if (fault)
                return fault;
            if (in_.pastEnd())
                return "the data end too early";
        }
        if (at_ != out_.size())
            return "the data unpack to less than the picture needs";
        return checkSum();
    }

private:
    const char* stored()
    {
        in_.toByte();
        const uint32_t length = in_.take(16);
        if (length != (~in_.take(16) & 0xFFFF))
            return "the data are damaged (stored length)";
        if (length > out_.size() - at_)
            return "the data unpack to more than the picture needs";
        for (uint32_t i = 0; i < length; ++i)
            out_[at_++] = uint8_t(in_.take(8));
        return nullptr;
    }

    const char* fixed()
    {
        std::array<uint8_t, kSymbols> lengths;
        for (size_t i = 0; i < lengths.size(); ++i)
            lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
        std::array<uint8_t, 30> distances;
        distances.fill(5);
        (void)literals_.build(lengths);
        (void)distances_.build(distances);
        return codes();
    }

    const char* dynamic()
    {
        constexpr std::array<uint8_t, 19> kOrder{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                 11, 4,  12, 3, 13, 2, 14, 1, 15};
        const size_t literalCount = in_.take(5) + 257;
        const size_t distanceCount = in_.take(5) + 1;
        const size_t lengthCount = in_.take(4) + 4;
        if (literalCount > 286 || distanceCount > 30)
            return "the data are damaged (code sizes)";
        std::array<uint8_t, kSymbols + 32> lengths{};
        for (size_t i = 0; i < lengthCount; ++i)
            lengths[kOrder[i]] = uint8_t(in_.take(3));
        if (!literals_.build(std::span(lengths).first(19)))
            return "the data are damaged (code lengths)";
        lengths.fill(0);
        for (size_t i = 0; i < literalCount + distanceCount;) {
            const int symbol = literals_.decode(in_);
            if (symbol < 0 || in_.pastEnd())
                return "the data are damaged (code lengths)";
            if (symbol < 16) {
                lengths[i++] = uint8_t(symbol);
                continue;
            }
            if (symbol == 16 && i == 0)
                return "the data are damaged (nothing to repeat)";
            const uint8_t value = symbol == 16 ? lengths[i - 1] : uint8_t(0);
            const size_t repeat = symbol == 16   ? 3 + in_.take(2)
                                  : symbol == 17 ? 3 + in_.take(3)
                                                 : 11 + in_.take(7);
            if (i + repeat > literalCount + distanceCount)
                return "the data are damaged (too many code lengths)";
            std::fill_n(lengths.begin() + std::ptrdiff_t(i), repeat, value);
            i += repeat;
        }
        if (!literals_.build(std::span(lengths).first(literalCount)) ||
            !distances_.build(std::span(lengths).subspan(literalCount, distanceCount)))
            return "the data are damaged (impossible code)";
        return codes();
    }

    const char* codes()
    {
        for (;;) {
            const int symbol = literals_.decode(in_);
            if (symbol < 0 || in_.pastEnd())
                return "the data are damaged or end too early";
            if (symbol == 256)
                return nullptr;
            if (symbol < 256) {
                if (at_ == out_.size())
                    return "the data unpack to more than the picture needs";
                out_[at_++] = uint8_t(symbol);
                continue;
            }
            if (const char* fault = copy(size_t(symbol) - 257))
                return fault;
        }
    }

    const char* copy(size_t lengthCode)
    {
        if (lengthCode >= kLengthBase.size())
            return "the data are damaged (length)";
        const size_t length = kLengthBase[lengthCode] + in_.take(kLengthExtra[lengthCode]);
        const int code = distances_.decode(in_);
        if (code < 0 || size_t(code) >= kDistanceBase.size())
            return "the data are damaged (distance)";
        const size_t distance = kDistanceBase[size_t(code)] + in_.take(kDistanceExtra[size_t(code)]);
        if (distance > at_)
            return "the data are damaged (they refer to before their beginning)";
        if (length > out_.size() - at_)
            return "the data unpack to more than the picture needs";
        for (size_t i = 0; i < length; ++i, ++at_) // overlapping is meant: it repeats
            out_[at_] = out_[at_ - distance];
        return nullptr;
    }

    const char* checkSum()
    {
        in_.toByte();
        uint32_t stored = 0;
        for (int i = 0; i < 4; ++i)
            stored = stored << 8 | in_.take(8);
        uint32_t a = 1;
        uint32_t b = 0;
        for (size_t i = 0; i < out_.size();) {
            for (const size_t end = std::min(i + 5552, out_.size()); i < end; ++i) { // no overflow in between
                a += out_[i];
                b += a;
            }
            a %= 65521;
            b %= 65521;
        }
        return stored == (b << 16 | a) ? nullptr : "the data are damaged (check sum)";
    }

    BitReader in_;
    std::span<uint8_t> out_;
    size_t at_ = 0;
    Code literals_;
    Code distances_;
};

} // namespace

base::Status inflateZlib(std::span<const uint8_t> packed, std::span<uint8_t> out)
{
    if (const char* fault = Inflater(packed, out).run())
        return {base::Code::Parse, fault};
    return {};
}

} // namespace fx::asset
