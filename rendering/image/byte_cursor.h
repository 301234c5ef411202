/// @file byte_cursor.h
/// Reads bytes of a file in order and never past the end. Every reader of a binary format goes through it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace fx::image {

class ByteCursor
{
public:
    explicit ByteCursor(std::span<const std::byte> bytes) : bytes_(bytes) {}

    size_t position() const { return position_; }
    size_t remaining() const { return bytes_.size() - position_; }

    std::optional<uint8_t> next()
    {
        if (remaining() == 0)
            return std::nullopt;
        return uint8_t(bytes_[position_++]);
    }
    /// Takes `count` bytes; empty, without progress, when fewer are left.
    std::optional<std::span<const std::byte>> take(size_t count)
    {
        if (remaining() < count)
            return std::nullopt;
        position_ += count;
        return bytes_.subspan(position_ - count, count);
    }
    /// Text up to a line feed, which is consumed but not returned; empty without a line feed within `limit`
    /// bytes.
    std::optional<std::string> line(size_t limit)
    {
        std::string text;
        while (text.size() <= limit) {
            const std::optional<uint8_t> c = next();
            if (!c)
                return std::nullopt;
            if (*c == '\n')
                return text;
            text += char(*c);
        }
        return std::nullopt;
    }

private:
    std::span<const std::byte> bytes_;
    size_t position_ = 0;
};

} // namespace fx::image
