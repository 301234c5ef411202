/// @file text.h
/// Texts in buffers of fixed size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace fx::api {

/// The longest beginning of `text` that fits into `most` bytes and does not end inside a UTF-8 sequence.
inline std::string_view cutUtf8(std::string_view text, size_t most)
{
    if (text.size() <= most)
        return text;
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80)
        --most;
    return text.substr(0, most);
}

/// Copies `text`, cut to `capacity` > 0 bytes with the terminating zero.
inline void copyText(std::string_view text, char* buffer, size_t capacity)
{
    const std::string_view fitting = cutUtf8(text, capacity - 1);
    *std::copy(fitting.begin(), fitting.end(), buffer) = '\0';
}

} // namespace fx::api
