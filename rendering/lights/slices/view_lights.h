/// @file view_lights.h
/// The lights of one view on the GPU: the list of lights, the media that cast shadows, and the light slices.
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

/// Timer group of the passes that fill light slices.
constexpr std::string_view kLightSliceGroup = "light slices";

/// Returns all programs for lights.
std::span<const ProgramDesc* const> lightPrograms();

class ViewLights
{
public:
    ViewLights(GlDevice* device, std::pmr::memory_resource* memory);

    /// Builds the list of a frame. Planes are filled again if lights have changed. If only casters have
    /// changed, planes are filled again after SliceSettings::refreshFrames frames.
    /// @param casters revision of the world positions of `in.casters`; equal revisions mean equal casters
    /// @param isUsed false: nothing is drawn and no shadow is cast, so that no GPU memory is allocated
    /// @return OutOfMemory
    base::Status gather(const LightListInputs& in, uint64_t casters, bool isUsed = true);

    /// True if the planes have been filled with the casters of the last gather().
    bool isCurrent() const { return !isBehind_; }

    /// Must be called instead of gather() if the lights have not changed since the last frame.
    void keep() { isKept_ = true; }

    /// Sets the host's shadow map of this frame.
    /// @param origin [m] world position to which the coordinates of the map are relative
    void setSunShadow(const HostShadowMap& map, const glm::dvec3& origin);

    /// Imports the list of lights and the planes, and adds the passes that fill the planes. @return bindings
    /// for draws
    LightBindings addPasses(FrameGraph& graph);

    void forget();  ///< must be called if the passes of the frame have not run
    void release(); ///< deletes buffer and planes
    bool hasPlanes() const { return atlas_.name() != 0; }
    uint64_t bytes() const; ///< [byte] size of the GPU memory
    const LightList& list() const { return list_; }
    uint32_t atlasTexture() const { return atlas_.name(); } ///< GL name of the atlas of planes; 0: no planes
    /// True if the planes are filled for the last list.
    bool isFilled() const { return atlas_.name() != 0 && filled_ == wanted_; }
    /// Returns the media shadow in a light of the last list. Without filled planes, the transmittance is 1.
    /// @param origin [m] world position to which the sampled positions are relative
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
    glm::dvec3 eye_{0.0}; ///< [m] world position to which the list is relative
    std::pmr::vector<CasterBlock> casters_;
    /// Casters with which the planes were filled. Empty: planes are filled in every frame.
    std::pmr::vector<MediumCaster> held_;
    std::pmr::vector<MediumCaster> shifted_; ///< scratch: held_ relative to the eye of the frame
    glm::dvec3 heldEye_{0.0};                ///< [m] world position to which `held_` is relative
    uint64_t heldRevision_ = 0;
    uint64_t givenRevision_ = 0; ///< revision of the casters of the last gather()
    int age_ = 0;                ///< [frame] number of frames since `held_` was set
    bool isBehind_ = false;      ///< true: the planes are filled from held_, not from the present casters
    GlBuffer lightBuffer_;
    GlTexture atlas_;
    /// Hash of the inputs from which the planes were filled; 0: the planes are invalid.
    uint64_t filled_ = 0;
    uint64_t wanted_ = 0;    ///< hash of the inputs of this frame
    uint32_t sunShadow_ = 0; ///< GL name of the host's shadow map
    bool isKept_ = false;    ///< true: the list on the GPU has not changed since the last frame
};

} // namespace fx::render
