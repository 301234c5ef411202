/// @file gl_mapped_buffer.h
/// A buffer that stays mapped: the CPU writes into the memory that draws read from, and a fence tells when
/// they have.
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
    /// @return InvalidArgument for 0 bytes, OutOfMemory
    static base::Result<GlMappedBuffer> create(GlDevice& device, size_t bytes, const char* label);

    GlMappedBuffer() = default;
    ~GlMappedBuffer();
    GlMappedBuffer(GlMappedBuffer&& other) noexcept { *this = std::move(other); }
    GlMappedBuffer& operator=(GlMappedBuffer&& other) noexcept;

    uint32_t name() const { return name_; }
    size_t bytes() const { return bytes_; } ///< [byte]
    /// What is written here is seen by every draw that follows. To be waited for first.
    std::byte* data() const { return data_; }

    void fence(); ///< draws up to here may read the buffer; it must have been created
    /// Returns when no draw before the last fence() can read it any more.
    /// @return GlFailed when that does not happen within ten seconds
    base::Status wait();

private:
    GlDevice* device_ = nullptr;
    uint32_t name_ = 0;
    size_t bytes_ = 0;
    std::byte* data_ = nullptr;
    GLsync fence_ = nullptr;
};

} // namespace fx::render
