#include "rendering/gl/gl_buffer.h"

#include "rendering/gl/gl_device.h"

#include <string>

#include <algorithm>
#include <bit>

namespace fx::render {

base::Result<GlBuffer> GlBuffer::create(GlDevice& device, size_t bytes, const char* label)
{
    const std::string what = "buffer '" + std::string(label) + "' of " + std::to_string(bytes) + " bytes";
    if (bytes == 0)
        return base::Status(base::Code::InvalidArgument, what + ": the size must be positive");

    GlFunctions& gl = device.gl;
    (void)device.takeError(label); // what is pending is not ours
    GlBuffer buffer;
    buffer.device_ = &device;
    gl.CreateBuffers(1, &buffer.name_);
    gl.NamedBufferStorage(buffer.name_, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    if (base::Status status = device.takeError(what); !status)
        return status;
    gl.ObjectLabel(GL_BUFFER, buffer.name_, -1, label);
    buffer.bytes_ = bytes;
    device.countBufferBytes(static_cast<int64_t>(bytes));
    return buffer;
}

GlBuffer::~GlBuffer()
{
    if (!name_)
        return;
    device_->countBufferBytes(-static_cast<int64_t>(bytes_));
    device_->gl.DeleteBuffers(1, &name_);
}

GlBuffer& GlBuffer::operator=(GlBuffer&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(name_, other.name_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

base::Status makeRoom(GlDevice& device, GlBuffer& ioBuffer, size_t bytes, const char* label)
{
    constexpr size_t kMinBytes = 4096;
    if (bytes == 0)
        return {};
    if (ioBuffer.bytes() >= bytes) {
        device.gl.InvalidateBufferData(ioBuffer.name()); // the GPU may still read it: do not wait
        return {};
    }
    auto created = GlBuffer::create(device, std::bit_ceil(std::max(bytes, kMinBytes)), label);
    if (!created)
        return created.status();
    ioBuffer = std::move(*created);
    return {};
}

} // namespace fx::render
