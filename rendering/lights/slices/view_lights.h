/// @file view_lights.h
/// The lights of one view on the GPU: their list, the media that cast shadows, and the planes.
///
/// Threads: [GL thread].
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/lights/slices/light_list.h"
#include "rendering/passes/light_bindings.h"

#include <memory_resource>
#include <span>
#include <vector>

namespace fx::render {

/// All programs that lights need.
std::span<const ProgramDesc* const> lightPrograms();

class ViewLights
{
public:
    ViewLights(GlDevice* device, std::pmr::memory_resource* memory);

    /// Makes the list of a frame. The planes are filled again only where casters or lights have changed.
    /// @param casters revision: differs where `in.casters` differ in the world
    /// @return OutOfMemory
    base::Status gather(const LightListInputs& in, uint64_t casters);

    /// Instead of gather(): the frame has the lights of the last one.
    void keep() { isKept_ = true; }

    /// Imports list and planes, and adds the passes that fill them. @return what draws bind
    LightBindings addPasses(FrameGraph& graph);

    void forget();  ///< what this frame was to write is not there
    void release(); ///< gives back buffer and planes
    bool hasPlanes() const { return atlas_.name() != 0; }
    uint64_t bytes() const; ///< [byte] held on the GPU
    const LightList& list() const { return list_; }
    uint32_t atlasTexture() const { return atlas_.name(); } ///< GL name; 0: no planes

private:
    struct CasterBlock
    {
        glm::vec4 centerRadius;
        glm::vec4 medium;
    };
    base::Status makeRoom();

    GlDevice& device_;
    LightList list_;
    std::pmr::vector<CasterBlock> casters_;
    GlBuffer lightBuffer_;
    GlTexture atlas_;
    uint64_t filled_ = 0; ///< key of what the planes hold; 0: nothing
    uint64_t wanted_ = 0; ///< key of this frame
    bool isKept_ = false; ///< the list on the GPU is that of the last frame
};

} // namespace fx::render
