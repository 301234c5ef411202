/// @file message_frame.h
/// Frames of the live link: the length of a message (4 bytes, little-endian) and its UTF-8 text.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace fx::link {

constexpr size_t kFrameHeaderBytes = 4;
constexpr uint64_t kLargestMessage = uint64_t(1) << 26; ///< [byte] that any side accepts

/// The frame of a message of at most kLargestMessage bytes.
std::string frameOf(std::string_view message);

/// Assembles messages from bytes that arrive in any portions. Memory grows with the bytes that have arrived,
/// never with a length that is only announced.
class FrameReader
{
public:
    /// @param maxBytes longest message
    explicit FrameReader(uint64_t maxBytes) : maxBytes_(maxBytes) {}

    void setLimit(uint64_t maxBytes) { maxBytes_ = maxBytes; }
    void add(std::string_view bytes) { bytes_.append(bytes); }
    /// Takes the next complete message.
    /// @return nothing if no message is complete; TooLarge and InvalidArgument (an empty message): the bytes
    ///     that follow cannot be understood, so that the connection must be closed
    base::Result<std::optional<std::string>> take();
    /// True if a part of a message has arrived.
    bool isInMessage() const { return begin_ < bytes_.size(); }
    size_t bytes() const { return bytes_.size() - begin_; } ///< [byte] not taken yet

private:
    uint64_t maxBytes_;
    std::string bytes_;
    size_t begin_ = 0; ///< first byte that is not taken
};

} // namespace fx::link
