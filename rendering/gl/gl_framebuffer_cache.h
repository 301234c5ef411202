/// @file gl_framebuffer_cache.h
/// Cache of framebuffer objects by their attachments, so that repeated frames create no framebuffers.
#pragma once

#include "foundation/result/status.h"
#include "rendering/gl/gl_name.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace fx::render {

/// GL names of the attached textures. 0 means no attachment. Color attachments with and without a texture
/// may be in any order.
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

    /// Deletes framebuffers that have not been used for many frames.
    void beginFrame();

    /// Finds or creates the framebuffer with `attachments`.
    /// @param foreign true: an attachment belongs to the host. Attachments are then set and checked again
    ///     once per frame, because the host may have deleted the texture and reused its name
    /// @return GlFailed with the reason why the framebuffer is incomplete
    base::Result<uint32_t> find(const GlAttachments& attachments, bool foreign);

    void clear() { entries_.clear(); } ///< deletes all framebuffers
    /// Deletes the framebuffers that use a texture. Must be called before the texture is deleted.
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
