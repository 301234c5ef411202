/// @file gl_uniform_ring.h
/// Uniform blocks of the draws of a frame in one ring buffer.
#pragma once

#include "foundation/result/status.h"
#include "rendering/gl/gl_buffer.h"

#include <cstddef>
#include <span>

namespace fx::render {

/// Ring buffer of uniform blocks. Memory is reused without waiting: OpenGL executes a write after the draws
/// that were issued before the write.
class GlUniformRing
{
public:
    /// [byte] Size of the buffer, enough for the blocks of a few frames.
    static constexpr size_t kCapacity = size_t(1) << 18;

    explicit GlUniformRing(GlDevice& device) : device_(device) {}

    /// Copies `bytes` to the next aligned offset of the buffer and binds this range at uniform binding 0.
    /// @return TooLarge if `bytes` exceeds GlLimits::uniformBlockBytes, OutOfMemory
    base::Status bind(std::span<const std::byte> bytes);
    /// Deletes the buffer. The next bind() creates it again.
    void release()
    {
        buffer_ = {};
        cursor_ = 0;
    }
    uint64_t bytes() const { return buffer_.bytes(); } ///< [byte] size of the buffer

private:
    GlDevice& device_;
    GlBuffer buffer_; ///< created by the first bind()
    size_t cursor_ = 0;
};

} // namespace fx::render
