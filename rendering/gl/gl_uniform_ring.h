/// @file gl_uniform_ring.h
/// Uniform blocks of a frame's draws in one buffer that is filled round and round.
#pragma once

#include "foundation/result/status.h"
#include "rendering/gl/gl_buffer.h"

#include <cstddef>
#include <span>

namespace fx::render {

/// OpenGL orders later writes after the reads of earlier draws, so memory is reused without waiting.
class GlUniformRing
{
public:
    static constexpr size_t kCapacity = size_t(1) << 18; ///< [byte] a few frames' worth of blocks

    explicit GlUniformRing(GlDevice& device) : device_(device) {}

    /// Copies `bytes` to the next place that the context's alignment allows and binds it at uniform binding
    /// 0.
    /// @return TooLarge when the context's uniform blocks are smaller, OutOfMemory
    base::Status bind(std::span<const std::byte> bytes);
    /// Deletes the buffer, until the next bind().
    void release()
    {
        buffer_ = {};
        cursor_ = 0;
    }
    uint64_t bytes() const { return buffer_.bytes(); } ///< [byte] held

private:
    GlDevice& device_;
    GlBuffer buffer_; ///< created by the first bind()
    size_t cursor_ = 0;
};

} // namespace fx::render
