#include "fxsdk/livelink/protocol/message_frame.h"

#include <utility>

namespace fx::link {

std::string frameOf(std::string_view message)
{
    const auto size = uint32_t(message.size());
    std::string frame;
    frame.reserve(kFrameHeaderBytes + message.size());
    for (unsigned shift = 0; shift < 32; shift += 8)
        frame += char((size >> shift) & 0xFF);
    return frame.append(message);
}

base::Result<std::optional<std::string>> FrameReader::take()
{
    if (bytes() < kFrameHeaderBytes)
        return std::optional<std::string>();
    uint32_t size = 0;
    for (size_t i = 0; i < kFrameHeaderBytes; ++i)
        size |= uint32_t(static_cast<unsigned char>(bytes_[begin_ + i])) << (8 * i);
    if (size == 0)
        return base::Status(base::Code::InvalidArgument, "the message is empty");
    if (size > maxBytes_)
        return base::Status(base::Code::TooLarge, "the message has " + std::to_string(size) +
                                                      " bytes; at most " + std::to_string(maxBytes_) +
                                                      " are allowed");
    if (bytes() < kFrameHeaderBytes + size)
        return std::optional<std::string>();
    std::string message = bytes_.substr(begin_ + kFrameHeaderBytes, size);
    begin_ += kFrameHeaderBytes + size;
    if (begin_ == bytes_.size() || begin_ > bytes_.size() / 2) { // each byte is moved at most once on average
        bytes_.erase(0, begin_);
        begin_ = 0;
        if (bytes_.empty())
            bytes_.shrink_to_fit();
    }
    return std::optional<std::string>(std::move(message));
}

} // namespace fx::link
