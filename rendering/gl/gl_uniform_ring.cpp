#include "rendering/gl/gl_uniform_ring.h"

#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_state_guard.h"

#include <string>

namespace fx::render {

namespace {

size_t roundUp(size_t value, size_t step)
{
    return (value + step - 1) / step * step;
}

} // namespace

base::Status GlUniformRing::bind(std::span<const std::byte> bytes)
{
    constexpr size_t kStd140Step = 16; // blocks end at a multiple of a vec4
    const size_t size = roundUp(bytes.size(), kStd140Step);
    const auto limit = static_cast<size_t>(device_.limits().uniformBlockBytes);
    if (size > limit || size > kCapacity) {
        return {base::Code::TooLarge, "a uniform block of " + std::to_string(bytes.size()) +
                                          " bytes exceeds the context's limit of " + std::to_string(limit)};
    }
    if (!buffer_.name()) {
        base::Result<GlBuffer> buffer = GlBuffer::create(device_, kCapacity, "uniform ring");
        if (!buffer)
            return buffer.status();
        buffer_ = std::move(*buffer);
    }
    size_t offset = roundUp(cursor_, static_cast<size_t>(device_.limits().uniformAlignment));
    if (offset + size > kCapacity) {
        device_.gl.InvalidateBufferData(
            buffer_.name()); // the driver may hand out fresh memory instead of waiting
        offset = 0;
    }
    // Bound before it is written: see GlBackend::upload().
    touchState(device_, GlStateGroup::UniformBinding, 0);
    device_.gl.BindBufferRange(GL_UNIFORM_BUFFER, 0, buffer_.name(), static_cast<GLintptr>(offset),
                               static_cast<GLsizeiptr>(size));
    device_.gl.NamedBufferSubData(buffer_.name(), static_cast<GLintptr>(offset),
                                  static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    cursor_ = offset + size;
    return {};
}

} // namespace fx::render
