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
#include "rendering/lights/slices/media_shadow.h"
#include "rendering/passes/light_bindings.h"

#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace fx::render {

/// Timer group of the passes that fill planes.
constexpr std::string_view kLightSliceGroup = "light slices";

/// All programs that lights need.
std::span<const ProgramDesc* const> lightPrograms();

class ViewLights
{
public:
    ViewLights(GlDevice* device, std::pmr::memory_resource* memory);

    /// Makes the list of a frame. Planes are filled again only if casters or lights have changed; if only
    /// casters have changed, at intervals of SliceSettings::refreshFrames.
    /// @param casters revision of `in.casters` in the world
    /// @return OutOfMemory
    /// @param isUsed false: nothing is drawn and no shadow is cast, so no GPU memory is allocated
    base::Status gather(const LightListInputs& in, uint64_t casters, bool isUsed = true);

    /// Whether the planes are those of the casters that the last gather() was given.
    bool isCurrent() const { return !isBehind_; }

    /// Instead of gather(): the frame has the lights of the last one.
    void keep() { isKept_ = true; }

    /// The host's shadow map of this frame.  @param origin [m] world position that its places are relative to
    void setSunShadow(const HostShadowMap& map, const glm::dvec3& origin);

    /// Imports list and planes, and adds the passes that fill them. @return bindings for draws
    LightBindings addPasses(FrameGraph& graph);

    void forget();  ///< invalidates data that this frame should have written
    void release(); ///< gives back buffer and planes
    bool hasPlanes() const { return atlas_.name() != 0; }
    uint64_t bytes() const; ///< [byte] held on the GPU
    const LightList& list() const { return list_; }
    uint32_t atlasTexture() const { return atlas_.name(); } ///< GL name; 0: no planes
    /// Whether the planes are up to date with the last list.
    bool isFilled() const { return atlas_.name() != 0 && filled_ == wanted_; }
    /// Shadow of a light of the last list; without filled planes, all light passes.
    /// @param origin [m] world position that the places of lookups are relative to
    MediaShadowBlock shadow(LightKind kind, uint32_t index, const glm::dvec3& origin) const;

private:
    struct CasterBlock
    {
        glm::vec4 centerRadius;
        glm::vec4 medium;
    };
    base::Status makeRoom();
    bool mayWait(const LightListInputs& in);
    bool buildBehind(const LightListInputs& in);
    void hold(const LightListInputs& in, uint64_t revision);

    GlDevice& device_;
    LightList list_;
    glm::dvec3 eye_{0.0}; ///< [m] world position that the list is relative to
    std::pmr::vector<CasterBlock> casters_;
    /// Casters that the planes were filled with; empty if planes are filled in every frame.
    std::pmr::vector<MediumCaster> held_;
    std::pmr::vector<MediumCaster> shifted_; ///< scratch: the same, relative to the eye of the frame
    glm::dvec3 heldEye_{0.0};                ///< [m] world position that `held_` is relative to
    uint64_t heldRevision_ = 0;
    uint64_t givenRevision_ = 0; ///< of the last casters that gather() was given
    int age_ = 0;                ///< [frame] since the casters were held
    bool isBehind_ = false;      ///< the planes are those of held casters
    GlBuffer lightBuffer_;
    GlTexture atlas_;
    uint64_t filled_ = 0;    ///< key of the content of the planes; 0: none
    uint64_t wanted_ = 0;    ///< key of this frame
    uint32_t sunShadow_ = 0; ///< GL name of the host's
    bool isKept_ = false;    ///< the list on the GPU is that of the last frame
};

} // namespace fx::render
