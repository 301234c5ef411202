#include "rendering/frame_graph/frame_graph.h"

#include <algorithm>

namespace fx::render {

void FrameGraph::compile()
{
    executedIndex_.clear();
    executed_.clear();
    physicalTextures_.clear();
    physicalBuffers_.clear();
    if (!status_.ok())
        return;
    cull();
    measureLifetimes();
    orderByFirstUse();
    assignTextures();
    assignBuffers();
}

/// A version can only be read by passes declared after its writer, so one sweep from the end finds all that
/// is needed.
void FrameGraph::cull()
{
    for (size_t i = passes_.size(); i-- > 0;) {
        Pass& pass = passes_[i];
        pass.alive = pass.sideEffect;
        for (const Access& access : accesses(pass))
            pass.alive |= access.isWrite && versions_[access.version].needed;
        if (!pass.alive)
            continue;
        for (const Access& access : accesses(pass)) {
            const Version& version = versions_[access.version];
            if (!access.isWrite)
                versions_[access.version].needed = true;
            else if (lifetimes_[version.resource].creator != i)
                versions_[version.previous].needed = true; // blending and partial updates need what was there
        }
    }
    for (size_t i = 0; i < passes_.size(); ++i) {
        if (!passes_[i].alive)
            continue;
        executedIndex_.push_back(static_cast<uint32_t>(i));
        executed_.push_back(passes_[i].name);
    }
}

void FrameGraph::measureLifetimes()
{
    for (Lifetime& lifetime : lifetimes_) {
        lifetime.first = kNone;
        lifetime.last = 0;
    }
    for (uint32_t i = 0; i < executedIndex_.size(); ++i) {
        for (const Access& access : accesses(passes_[executedIndex_[i]])) {
            Lifetime& lifetime = lifetimes_[versions_[access.version].resource];
            lifetime.first = std::min(lifetime.first, i);
            lifetime.last = i;
        }
    }
    for (Lifetime& lifetime : lifetimes_) {
        if (lifetime.kept && lifetime.first != kNone)
            lifetime.last = kNone; // must survive the frame
    }
}

FrameGraph::Memory FrameGraph::memory() const
{
    const auto texels = [](int width, int height, Format format) {
        return uint64_t(width) * uint64_t(height) * formatBytes(format);
    };
    Memory memory{0, 0};
    for (const Resource& resource : resources_)
        if (resource.physical != kNone)
            memory.unshared += resource.isTexture ? texels(resource.width, resource.height, resource.format)
                                                  : resource.bytes;
    for (const PhysicalTexture& texture : physicalTextures_)
        memory.shared += texels(texture.width, texture.height, texture.format);
    for (const size_t bytes : physicalBuffers_)
        memory.shared += bytes;
    return memory;
}

void FrameGraph::orderByFirstUse()
{
    order_.clear();
    for (uint32_t i = 0; i < resources_.size(); ++i) {
        resources_[i].physical = kNone;
        if (!resources_[i].imported && lifetimes_[i].first != kNone)
            order_.push_back(i);
    }
    std::sort(order_.begin(), order_.end(), [this](uint32_t a, uint32_t b) {
        return lifetimes_[a].first != lifetimes_[b].first ? lifetimes_[a].first < lifetimes_[b].first : a < b;
    });
}

/// First fit in order of first use: a texture of equal size and format is taken again once the last use of
/// what was in it lies before the first use of the next.
void FrameGraph::assignTextures()
{
    busyUntil_.clear();
    for (const uint32_t i : order_) {
        Resource& resource = resources_[i];
        if (!resource.isTexture)
            continue;
        uint32_t slot = 0;
        for (; slot < physicalTextures_.size(); ++slot) {
            const PhysicalTexture& texture = physicalTextures_[slot];
            if (busyUntil_[slot] < lifetimes_[i].first && texture.width == resource.width &&
                texture.height == resource.height && texture.format == resource.format)
                break;
        }
        if (slot == physicalTextures_.size()) {
            physicalTextures_.push_back({resource.width, resource.height, resource.format});
            busyUntil_.push_back(0);
        }
        busyUntil_[slot] = lifetimes_[i].last;
        resource.physical = slot;
    }
}

/// As for textures, but any free buffer will do: it grows to the largest of its users.
void FrameGraph::assignBuffers()
{
    busyUntil_.clear();
    for (const uint32_t i : order_) {
        Resource& resource = resources_[i];
        if (resource.isTexture)
            continue;
        uint32_t slot = 0;
        while (slot < physicalBuffers_.size() && busyUntil_[slot] >= lifetimes_[i].first)
            ++slot;
        if (slot == physicalBuffers_.size()) {
            physicalBuffers_.push_back(0);
            busyUntil_.push_back(0);
        }
        physicalBuffers_[slot] = std::max(physicalBuffers_[slot], resource.bytes);
        busyUntil_[slot] = lifetimes_[i].last;
        resource.physical = slot;
    }
}

} // namespace fx::render
