/// @file gl_buffer.h
/// A buffer with immutable storage. The CPU writes to the buffer with glNamedBufferSubData.
#pragma once

#include "foundation/result/status.h"

#include <cstddef>
#include <cstdint>
#include <utility>

namespace fx::render {

class GlDevice;

class GlBuffer
{
public:
    /// Creates a buffer.
    /// @return InvalidArgument for 0 bytes, OutOfMemory
    static base::Result<GlBuffer> create(GlDevice& device, size_t bytes, const char* label);

    GlBuffer() = default;
    ~GlBuffer();
    GlBuffer(GlBuffer&& other) noexcept { *this = std::move(other); }
    GlBuffer& operator=(GlBuffer&& other) noexcept;

    uint32_t name() const { return name_; }
    size_t bytes() const { return bytes_; } ///< [byte]

private:
    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
    size_t bytes_ = 0;
};

/// Replaces `ioBuffer` by a larger buffer if the size of `ioBuffer` is less than `bytes`. The size of a new
/// buffer is the next power of two, and its content is undefined. Does nothing for 0 bytes.
/// @return OutOfMemory
base::Status makeRoom(GlDevice& device, GlBuffer& ioBuffer, size_t bytes, const char* label);

} // namespace fx::render
