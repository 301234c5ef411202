#include "rendering/gl/gl_mapped_buffer.h"

#include "rendering/gl/gl_device.h"

#include <string>

namespace fx::render {

namespace {
constexpr GLuint64 kPatience = 10'000'000'000; ///< [ns]
}

base::Result<GlMappedBuffer> GlMappedBuffer::create(GlDevice& device, size_t bytes, const char* label)
{
    const std::string what =
        "mapped buffer '" + std::string(label) + "' of " + std::to_string(bytes) + " bytes";
    if (bytes == 0)
        return base::Status(base::Code::InvalidArgument, what + ": the size must be positive");

    constexpr GLbitfield kFlags = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    GlFunctions& gl = device.gl;
    (void)device.takeError(label); // what is pending is not ours
    GlMappedBuffer buffer;
    buffer.device_ = &device;
    gl.CreateBuffers(1, &buffer.name_);
    gl.NamedBufferStorage(buffer.name_, static_cast<GLsizeiptr>(bytes), nullptr, kFlags);
    buffer.data_ = static_cast<std::byte*>(
        gl.MapNamedBufferRange(buffer.name_, 0, static_cast<GLsizeiptr>(bytes), kFlags));
    if (base::Status status = device.takeError(what); !status)
        return status;
    if (!buffer.data_)
        return base::Status(base::Code::OutOfMemory, what + ": it could not be mapped");
    gl.ObjectLabel(GL_BUFFER, buffer.name_, -1, label);
    buffer.bytes_ = bytes;
    device.countBufferBytes(static_cast<int64_t>(bytes));
    return buffer;
}

GlMappedBuffer::~GlMappedBuffer()
{
    if (fence_)
        device_->gl.DeleteSync(fence_);
    if (!name_)
        return;
    device_->countBufferBytes(-static_cast<int64_t>(bytes_));
    device_->gl.DeleteBuffers(1, &name_); // and unmaps it; GL keeps the memory while draws read it
}

GlMappedBuffer& GlMappedBuffer::operator=(GlMappedBuffer&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    std::swap(data_, other.data_);
    std::swap(fence_, other.fence_);
    return *this;
}

void GlMappedBuffer::fence()
{
    if (fence_)
        device_->gl.DeleteSync(fence_);
    fence_ = device_->gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

base::Status GlMappedBuffer::wait()
{
    if (!fence_)
        return {};
    const GLenum outcome = device_->gl.ClientWaitSync(fence_, GL_SYNC_FLUSH_COMMANDS_BIT, kPatience);
    if (outcome != GL_ALREADY_SIGNALED && outcome != GL_CONDITION_SATISFIED)
        return {base::Code::GlFailed, "the GPU does not finish its frames; the context may be lost"};
    device_->gl.DeleteSync(fence_);
    fence_ = nullptr;
    return {};
}

} // namespace fx::render
