/// @file gl_framebuffer_cache.h
/// Cache of framebuffer objects by their attachments, so that repeated frames create none.
#pragma once

#include "foundation/result/status.h"
#include "rendering/gl/gl_name.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// Names of the attached textures; 0 for none, also among the colors.
struct GlAttachments
{
    std::array<uint32_t, 8> colors{};
    uint32_t colorCount = 0;
    uint32_t depth = 0;

    bool operator==(const GlAttachments&) const = default;
};

class GlFramebufferCache
{
public:
    GlFramebufferCache(GlDevice& device, std::pmr::memory_resource* memory)
        : device_(device), entries_(memory)
    {}

    /// Deletes framebuffers that were not used for many frames.
    void beginFrame();

    /// `foreign`: some attachment belongs to the host, which may have deleted the texture and reused its name
    /// since the last frame. Such framebuffers are attached and checked again once a frame.
    /// @return GlFailed with the fault of the attachments
    base::Result<uint32_t> find(const GlAttachments& attachments, bool foreign);

    void clear() { entries_.clear(); } ///< deletes all
    /// To be called before a texture is deleted.
    void forget(uint32_t texture);

private:
    struct Entry
    {
        GlAttachments attachments;
        GlFramebuffer framebuffer;
        uint64_t attachedFrame;
        uint64_t usedFrame;
    };

    base::Status attach(const Entry& entry);

    GlDevice& device_;
    std::pmr::vector<Entry> entries_;
    uint64_t frame_ = 0;
};

} // namespace fx::render
