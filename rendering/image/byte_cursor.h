/// @file byte_cursor.h
/// Reads the bytes of a file one after another, and never reads past the end. All readers of binary formats
/// use this class.
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
    /// Returns the next `count` bytes and advances. If fewer bytes are left, returns nullopt and does not
    /// advance.
    std::optional<std::span<const std::byte>> take(size_t count)
    {
        if (remaining() < count)
            return std::nullopt;
        position_ += count;
        return bytes_.subspan(position_ - count, count);
    }
    /// Returns the text before the next line feed, and advances past the line feed. Returns nullopt if there
    /// is no line feed within `limit` bytes.
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
