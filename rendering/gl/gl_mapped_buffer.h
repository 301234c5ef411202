/// @file gl_mapped_buffer.h
/// A persistently mapped buffer. The CPU writes to memory that draws read. A fence signals that draws have
/// finished reading.
///
/// Threads: [GL thread].
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace fx::render {

class GlDevice;

class GlMappedBuffer
{
public:
    /// Creates and maps a buffer.
    /// @return InvalidArgument for 0 bytes, OutOfMemory
    static base::Result<GlMappedBuffer> create(GlDevice& device, size_t bytes, const char* label);

    GlMappedBuffer() = default;
    ~GlMappedBuffer();
    GlMappedBuffer(GlMappedBuffer&& other) noexcept { *this = std::move(other); }
    GlMappedBuffer& operator=(GlMappedBuffer&& other) noexcept;

    uint32_t name() const { return name_; }
    size_t bytes() const { return bytes_; } ///< [byte]
    /// The mapped memory. Writes are visible to all later draws. Call wait() before writing.
    std::byte* data() const { return data_; }

    /// Inserts a fence. Must be called after the draws that read the buffer. Requires create().
    void fence();
    /// Waits until all draws before the last fence() have finished reading.
    /// @return GlFailed after ten seconds
    base::Status wait();

private:
    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
    size_t bytes_ = 0;
    std::byte* data_ = nullptr;
    GLsync fence_ = nullptr;
};

} // namespace fx::render
