#include "rendering/gl/gl_resource_pool.h"

#include "rendering/gl/gl_device.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr uint64_t kFramesKept = 8; ///< a pass that comes and goes does not reallocate each time
constexpr size_t kSmallestBuffer = 4096;

} // namespace

GlResourcePool::GlResourcePool(GlDevice& device, std::pmr::memory_resource* memory)
    : device_(device), textures_(memory), assigned_(memory), buffers_(memory)
{}

base::Status GlResourcePool::realise(const FrameGraph& graph, GlFramebufferCache& framebuffers)
{
    ++frame_;
    deleteUnused(framebuffers);
    assigned_.clear();
    for (const PhysicalTexture& wanted : graph.physicalTextures()) {
        if (base::Status status = realiseTexture(wanted); !status)
            return status;
    }
    const auto sizes = graph.physicalBuffers();
    for (size_t i = 0; i < sizes.size(); ++i) {
        if (base::Status status = realiseBuffer(i, sizes[i]); !status)
            return status;
    }
    return {};
}

base::Status GlResourcePool::realiseTexture(const PhysicalTexture& wanted)
{
    const GLenum format = glInternalFormat(wanted.format);
    for (uint32_t i = 0; i < textures_.size(); ++i) {
        PooledTexture& pooled = textures_[i];
        if (pooled.usedFrame == frame_ || pooled.texture.width() != wanted.width ||
            pooled.texture.height() != wanted.height || pooled.texture.internalFormat() != format)
            continue;
        pooled.usedFrame = frame_;
        assigned_.push_back(i);
        return {};
    }
    base::Result<GlTexture> texture =
        GlTexture::create(device_, wanted.width, wanted.height, format, "frame texture");
    if (!texture)
        return texture.status();
    assigned_.push_back(static_cast<uint32_t>(textures_.size()));
    textures_.push_back({std::move(*texture), frame_});
    return {};
}

/// Sizes follow particle counts, so buffers grow to powers of two and do not shrink while they are used.
base::Status GlResourcePool::realiseBuffer(size_t index, size_t bytes)
{
    if (index == buffers_.size())
        buffers_.emplace_back();
    buffers_[index].usedFrame = frame_;
    if (buffers_[index].buffer.bytes() >= bytes)
        return {};
    const size_t capacity =
        bytes > (size_t(1) << 62) ? bytes : std::bit_ceil(std::max(bytes, kSmallestBuffer));
    base::Result<GlBuffer> buffer = GlBuffer::create(device_, capacity, "frame buffer");
    if (!buffer)
        return buffer.status();
    buffers_[index].buffer = std::move(*buffer);
    return {};
}

void GlResourcePool::deleteUnused(GlFramebufferCache& framebuffers)
{
    std::erase_if(textures_, [&](const PooledTexture& pooled) {
        const bool unused = frame_ - pooled.usedFrame > kFramesKept;
        if (unused)
            framebuffers.forget(pooled.texture.name());
        return unused;
    });
    while (!buffers_.empty() && frame_ - buffers_.back().usedFrame > kFramesKept)
        buffers_.pop_back();
}

void GlResourcePool::release(GlFramebufferCache& framebuffers)
{
    for (const PooledTexture& pooled : textures_)
        framebuffers.forget(pooled.texture.name());
    textures_.clear();
    assigned_.clear();
    buffers_.clear();
}

bool GlResourcePool::owns(uint32_t texture) const
{
    return std::any_of(textures_.begin(), textures_.end(),
                       [texture](const PooledTexture& pooled) { return pooled.texture.name() == texture; });
}

uint64_t GlResourcePool::bytes() const
{
    uint64_t sum = 0;
    for (const PooledTexture& pooled : textures_)
        sum += pooled.texture.bytes();
    for (const PooledBuffer& pooled : buffers_)
        sum += pooled.buffer.bytes();
    return sum;
}

} // namespace fx::render
