/// @file recording_backend.h
/// A backend without graphics, for tests. The backend records the operations of passes, and compares the
/// operations with the declarations of the passes.
///
/// Threads: one thread at a time.
#pragma once

#include "rendering/frame_graph/backend.h"
#include "rendering/frame_graph/frame_graph.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace fx::render {

class RecordingBackend final : public Backend
{
public:
    enum class Kind
    {
        Clear,
        Draw,
        Dispatch,
        Upload,
        Copy,
    };

    /// One operation, with copies of its arguments. Members that do not apply to the kind of operation are
    /// empty.
    struct Operation
    {
        Kind kind = Kind::Draw;
        std::string_view pass;
        const ProgramDesc* program = nullptr;
        std::vector<ResourceId> targets; ///< resources to which the draw, clear, upload or copy writes
        std::vector<TextureBinding> textures;
        std::vector<ImageBinding> images;
        std::vector<BufferBinding> buffers;
        std::vector<std::byte> bytes; ///< data of the uniforms or of the upload
        Blend blend = Blend::None;
        uint32_t vertices = 0;
        uint32_t instances = 0;
        ResourceId depthTarget = {};
        bool reversedDepth = false;
        uint32_t groups[3] = {0, 0, 0};
        float color[4] = {0, 0, 0, 0};
        ResourceId copySource = {};
    };

    explicit RecordingBackend(const FrameGraph& graph) : graph_(graph) {}

    const std::vector<std::string_view>& passes() const { return passes_; }
    const std::vector<Operation>& operations() const { return operations_; }
    std::vector<Operation> operationsOf(std::string_view pass) const;
    size_t count(Kind kind) const;

    /// Violations of the rules of the graph, one sentence each; empty for correct passes. Violations are use
    /// of an undeclared resource, sampling of a current render target, targets of unequal size, and draws
    /// without a program.
    const std::vector<std::string>& violations() const { return violations_; }

    void beginPass(std::string_view name) override;
    void endPass() override;
    void clear(ResourceId texture, const float (&rgba)[4]) override;
    void draw(const DrawCall& call) override;
    void dispatch(const DispatchCall& call) override;
    void upload(ResourceId buffer, std::span<const std::byte> bytes) override;
    void copyTexture(ResourceId source, ResourceId destination) override;
    int width(ResourceId texture) const override { return graph_.resource(texture).width; }
    int height(ResourceId texture) const override { return graph_.resource(texture).height; }

private:
    Operation& add(Kind kind);
    void violation(std::string_view what, ResourceId id);
    void needRead(ResourceId id);
    void needWrite(ResourceId id);
    void checkFeedback(const Operation& operation);

    const FrameGraph& graph_;
    std::vector<std::string_view> passes_;
    std::vector<Operation> operations_;
    std::vector<std::string> violations_;
};

} // namespace fx::render
