/// @file gl_backend.h
/// Executes a compiled FrameGraph with OpenGL 4.5. There is one backend per view. A backend keeps its
/// textures from frame to frame.
///
///     graph.compile();
///     GlStateGuard guard(device);
///     if (backend.beginFrame(graph)) { graph.execute(backend); }
///     const base::Status status = backend.endFrame();
///
/// Each draw has exactly the state that it declares. beginFrame() sets the states of all draws. For each
/// draw, only the states that differ from those of the previous draw are set. GlStateGuard lists the affected
/// states; it queries those of units, bindings and draw buffers before their first change. The clip control
/// and multisampling of the host are not changed. A frame with the same resources as the last frame allocates
/// nothing. Threads: [GL thread].
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame_graph/backend.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_draw_state.h"
#include "rendering/gl/gl_framebuffer_cache.h"
#include "rendering/gl/gl_pass_timer.h"
#include "rendering/gl/gl_resource_pool.h"
#include "rendering/gl/gl_uniform_ring.h"

#include <cstdint>
#include <initializer_list>
#include <memory_resource>
#include <string_view>

namespace fx::render {

/// Encoding of colors that a frame writes to targets of an sRGB format.
enum class SrgbTargets : uint8_t
{
    Light, ///< passes write linear light; OpenGL blends in linear space and encodes the result
    Codes, ///< passes write encoded values, which are stored without conversion
};

class GlBackend final : public Backend
{
public:
    static constexpr uint32_t kTextureUnits = GlDrawState::kUnits;
    static constexpr uint32_t kImageUnits = 7;      ///< number of image units, 0..6
    static constexpr uint32_t kStorageBindings = 8; ///< number of storage bindings, 0..7
    /// Number of uniform bindings. Binding 0 is for DrawCall::uniforms, binding 1 for uniform buffers.
    static constexpr uint32_t kUniformBindings = 2;
    /// Number of color targets, the minimum that OpenGL 4.5 guarantees.
    static constexpr uint32_t kColorTargets = 8;

    GlBackend(GlDevice& device, std::pmr::memory_resource* memory);

    /// Creates or reuses the textures and buffers of `graph`, and sets the state that all draws share.
    /// `graph` must be compiled and stay valid until endFrame(). A pending GL error of the host is discarded.
    /// @return the error of FrameGraph::status(), GlLost, OutOfMemory, InvalidArgument
    ///     (size)
    /// @param keepScissor see GlDrawState::reset()
    base::Status beginFrame(const FrameGraph& graph, SrgbTargets srgb = SrgbTargets::Light,
                            bool keepScissor = false);
    /// Ends the frame. @return status()
    base::Status endFrame();

    /// The first failure since beginFrame(), or Ok. After a failure, drawing calls do nothing.
    const base::Status& status() const { return status_; }

    /// GL name of a resource of the current graph; 0 for a framebuffer or a culled resource. Textures marked
    /// by FrameGraph::keep() stay valid and unchanged until the next beginFrame().
    uint32_t textureName(ResourceId texture) const;
    uint32_t bufferName(ResourceId buffer) const;

    /// True if `texture` is the GL name of a transient texture of this backend.
    bool owns(uint32_t texture) const { return pool_.owns(texture); }

    uint32_t drawCalls() const { return drawCalls_; } ///< number of draws and dispatches of the last frame
    /// [byte] Size of all textures and buffers of the backend.
    uint64_t pooledBytes() const { return pool_.bytes() + uniforms_.bytes(); }
    /// Sets the timer that is notified when a pass begins; null: no timer. The timer must stay valid while
    /// it is set.
    void setTimer(GlPassTimer* timer) { timer_ = timer; }
    void releasePool(); ///< deletes all pooled objects; the next frame creates them again

    void beginPass(std::string_view name) override;
    void endPass() override;
    void clear(ResourceId texture, const float (&rgba)[4]) override;
    void draw(const DrawCall& call) override;
    void dispatch(const DispatchCall& call) override;
    void upload(ResourceId buffer, std::span<const std::byte> bytes) override;
    void copyTexture(ResourceId source, ResourceId destination) override;
    int width(ResourceId texture) const override;
    int height(ResourceId texture) const override;

private:
    bool usable() const { return graph_ && status_.ok(); }
    void fail(base::Code code, std::initializer_list<std::string_view> parts); ///< stores the first failure
    bool inRange(uint32_t index, uint32_t count, const char* what);
    uint32_t nameOrFail(ResourceId id, bool isTexture, const char* use);
    bool findFramebuffer(std::span<const ResourceId> targets, ResourceId depthTarget,
                         uint32_t& outFramebuffer);
    bool useProgram(const ProgramDesc* program);
    bool bindInputs(std::span<const TextureBinding> textures, std::span<const BufferBinding> buffers,
                    std::span<const std::byte> uniforms);
    bool writesAny(std::span<const BufferBinding> buffers) const;

    GlDevice& device_;
    const FrameGraph* graph_ = nullptr;
    base::Status status_;
    GlResourcePool pool_;
    GlFramebufferCache framebuffers_;
    GlUniformRing uniforms_;
    GlDrawState state_;
    GlPassTimer* timer_ = nullptr;
    size_t pass_ = 0; ///< index of the running pass among the executed passes
    uint32_t drawCalls_ = 0;
    bool hasDrawn_ = true; ///< true: draws were issued since the last barrier, in this frame or before
};

} // namespace fx::render
