/// @file gl_resource_pool.h
/// Pool of the textures and buffers that the frame graphs of a view use. The objects are kept from frame to
/// frame.
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_framebuffer_cache.h"
#include "rendering/gl/gl_texture.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

class GlResourcePool
{
public:
    GlResourcePool(GlDevice& device, std::pmr::memory_resource* memory);

    /// Assigns a GL object to every physical resource of the graph. For an unchanged graph, the objects of
    /// the last frame are used again. Textures and buffers that have not been used for several frames are
    /// deleted. Framebuffers in `framebuffers` with a deleted texture are also deleted.
    base::Status realise(const FrameGraph& graph, GlFramebufferCache& framebuffers);
    /// Deletes all objects. The next realise() creates new objects.
    void release(GlFramebufferCache& framebuffers);

    uint32_t texture(uint32_t physical) const { return textures_[assigned_[physical]].texture.name(); }
    uint32_t buffer(uint32_t physical) const { return buffers_[physical].buffer.name(); }
    bool owns(uint32_t texture) const; ///< true if `texture` is the GL name of a texture of the pool
    uint64_t bytes() const;            ///< [byte] size of all objects

private:
    struct PooledTexture
    {
        GlTexture texture;
        uint64_t usedFrame;
    };

    struct PooledBuffer
    {
        GlBuffer buffer;
        uint64_t usedFrame = 0;
    };

    base::Status realiseTexture(const PhysicalTexture& wanted);
    base::Status realiseBuffer(size_t index, size_t bytes);
    void deleteUnused(GlFramebufferCache& framebuffers);

    GlDevice& device_;
    std::pmr::vector<PooledTexture> textures_;
    std::pmr::vector<uint32_t> assigned_;    ///< for each physical texture: index in textures_
    std::pmr::vector<PooledBuffer> buffers_; ///< for each physical buffer
    uint64_t frame_ = 0;
};

} // namespace fx::render
