/// @file text.h
/// Copies texts to buffers of fixed size.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace fx::api {

/// The longest prefix of `text` that has at most `most` bytes and does not end inside a UTF-8 sequence.
inline std::string_view cutUtf8(std::string_view text, size_t most)
{
    if (text.size() <= most)
        return text;
    while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80)
        --most;
    return text.substr(0, most);
}

/// Copies `text`, cut to fit into `capacity` > 0 bytes with a terminating zero.
inline void copyText(std::string_view text, char* buffer, size_t capacity)
{
    const std::string_view fitting = cutUtf8(text, capacity - 1);
    *std::copy(fitting.begin(), fitting.end(), buffer) = '\0';
}

} // namespace fx::api
