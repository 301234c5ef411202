#include "rendering/gl/gl_backend.h"

#include "rendering/gl/gl_state_guard.h"

#include <algorithm>
#include <string>

namespace fx::render {

GlBackend::GlBackend(GlDevice& device, std::pmr::memory_resource* memory)
    : device_(device), pool_(device, memory), framebuffers_(device, memory), uniforms_(device), state_(device)
{}

// ---- the frame ----

base::Status GlBackend::beginFrame(const FrameGraph& graph, SrgbTargets srgb, bool keepScissor)
{
    graph_ = &graph;
    status_ = graph.status();
    pass_ = 0;
    drawCalls_ = 0;
    if (!status_.ok())
        return status_;
    (void)device_.takeError("the host's own calls");
    if (status_ = device_.orLost({}); !status_.ok())
        return status_;
    framebuffers_.beginFrame();
    status_ = pool_.realise(graph, framebuffers_);
    if (status_.ok())
        state_.reset(srgb == SrgbTargets::Light, keepScissor);
    return status_;
}

base::Status GlBackend::endFrame()
{
    if (base::Status error = device_.takeError("drawing a frame"); status_.ok() && !error.ok())
        status_ = std::move(error);
    return status_;
}

void GlBackend::fail(base::Code code, std::initializer_list<std::string_view> parts)
{
    if (!status_.ok())
        return;
    std::string message;
    if (graph_ && pass_ < graph_->executedPasses().size())
        message.append("pass '").append(graph_->executedPasses()[pass_]).append("': ");
    for (const std::string_view part : parts)
        message.append(part);
    status_ = {code, std::move(message)};
}

void GlBackend::releasePool()
{
    pool_.release(framebuffers_);
    framebuffers_.clear();
    uniforms_.release();
    graph_ = nullptr;
}

void GlBackend::beginPass(std::string_view name)
{
    if (timer_)
        timer_->beginPass(name);
    if (device_.limits().debugContext)
        device_.gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()),
                                  name.data());
}

void GlBackend::endPass()
{
    ++pass_;
    if (device_.limits().debugContext)
        device_.gl.PopDebugGroup();
}

// ---- resources ----

uint32_t GlBackend::textureName(ResourceId texture) const
{
    if (!graph_ || !graph_->contains(texture))
        return 0;
    const FrameGraph::Resource& resource = graph_->resource(texture);
    if (resource.isFramebuffer || !resource.isTexture)
        return 0;
    if (resource.imported)
        return resource.importedName;
    return resource.physical == ~0u ? 0 : pool_.texture(resource.physical);
}

uint32_t GlBackend::bufferName(ResourceId buffer) const
{
    if (!graph_ || !graph_->contains(buffer))
        return 0;
    const FrameGraph::Resource& resource = graph_->resource(buffer);
    if (resource.isTexture)
        return 0;
    if (resource.imported)
        return resource.importedName;
    return resource.physical == ~0u ? 0 : pool_.buffer(resource.physical);
}

int GlBackend::width(ResourceId texture) const
{
    return graph_ && graph_->contains(texture) ? graph_->resource(texture).width : 0;
}

int GlBackend::height(ResourceId texture) const
{
    return graph_ && graph_->contains(texture) ? graph_->resource(texture).height : 0;
}

uint32_t GlBackend::nameOrFail(ResourceId id, bool isTexture, const char* use)
{
    const uint32_t name = isTexture ? textureName(id) : bufferName(id);
    if (name == 0) {
        const std::string_view what =
            graph_->contains(id) ? graph_->resource(id).name : "(an unknown resource)";
        fail(base::Code::Internal,
             {"'", what, "' cannot be ", use,
              ": it is not declared by any executed pass, or of another kind, or was imported "
              "without a GL name"});
    }
    return name;
}

/// Finds or makes the framebuffer of some targets. The host's own framebuffer stands alone; it may have more
/// draw buffers than programs write.
bool GlBackend::findFramebuffer(std::span<const ResourceId> targets, ResourceId depthTarget,
                                uint32_t& outFramebuffer)
{
    const auto isFramebuffer = [this](ResourceId id) {
        return graph_->contains(id) && graph_->resource(id).isFramebuffer;
    };
    if (targets.size() == 1 && isFramebuffer(targets[0]) && !depthTarget.valid()) {
        outFramebuffer = graph_->resource(targets[0]).importedName;
        state_.drawToFirst(true);
        return true;
    }
    if (targets.size() > kColorTargets || (targets.empty() && !depthTarget.valid())) {
        fail(base::Code::Internal, {"a draw has ", std::to_string(targets.size()),
                                    " color targets, not 1 to ", std::to_string(kColorTargets)});
        return false;
    }
    GlAttachments attachments;
    bool foreign = false;
    const bool mayBeAbsent = targets.size() > 1;
    for (const ResourceId target : targets) {
        if (mayBeAbsent && !target.valid()) {
            attachments.colors[attachments.colorCount++] = 0;
            continue;
        }
        const uint32_t name = nameOrFail(target, true, "drawn to");
        if (!name)
            return false;
        attachments.colors[attachments.colorCount++] = name;
        foreign |= graph_->resource(target).imported;
    }
    if (depthTarget.valid()) {
        attachments.depth = nameOrFail(depthTarget, true, "used as depth target");
        if (!attachments.depth)
            return false;
        foreign |= graph_->resource(depthTarget).imported;
    }
    base::Result<uint32_t> framebuffer = framebuffers_.find(attachments, foreign);
    if (!framebuffer) {
        fail(framebuffer.status().code(), {framebuffer.status().message()});
        return false;
    }
    outFramebuffer = *framebuffer;
    state_.drawToFirst(false);
    return true;
}

// ---- draws ----

bool GlBackend::useProgram(const ProgramDesc* program)
{
    if (!program) {
        fail(base::Code::Internal, {"it draws without a program"});
        return false;
    }
    const uint32_t name = device_.program(*program, status_);
    if (name)
        state_.useProgram(name);
    return name != 0;
}

bool GlBackend::bindInputs(std::span<const TextureBinding> textures, std::span<const BufferBinding> buffers,
                           std::span<const std::byte> uniforms)
{
    for (const TextureBinding& binding : textures) {
        const uint32_t name = nameOrFail(binding.texture, true, "sampled");
        if (!name || !inRange(binding.unit, kTextureUnits, "texture unit"))
            return false;
        state_.bindTexture(binding.unit, name, binding.sampling);
    }
    for (const BufferBinding& binding : buffers) {
        const uint32_t name = nameOrFail(binding.buffer, false, "bound as storage");
        if (!name || !inRange(binding.binding, binding.isUniform ? kUniformBindings : kStorageBindings,
                              binding.isUniform ? "uniform binding" : "storage binding"))
            return false;
        const uint64_t held = graph_->resource(binding.buffer).bytes;
        const uint64_t bytes = binding.bytes ? binding.bytes : held - std::min(held, binding.offset);
        if (bytes == 0 || binding.offset > held || bytes > held - binding.offset) {
            fail(base::Code::Internal,
                 {"'", graph_->resource(binding.buffer).name, "' is bound beyond its end"});
            return false;
        }
        touchState(device_, binding.isUniform ? GlStateGroup::UniformBinding : GlStateGroup::StorageBinding,
                   binding.binding);
        device_.gl.BindBufferRange(binding.isUniform ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER,
                                   binding.binding, name, static_cast<GLintptr>(binding.offset),
                                   static_cast<GLsizeiptr>(bytes));
    }
    if (!uniforms.empty()) {
        if (base::Status status = uniforms_.bind(uniforms); !status) {
            fail(status.code(), {status.message()});
            return false;
        }
    }
    return true;
}

bool GlBackend::inRange(uint32_t index, uint32_t count, const char* what)
{
    if (index < count)
        return true;
    fail(base::Code::Internal,
         {what, " ", std::to_string(index), " is used, there are ", std::to_string(count)});
    return false;
}

bool GlBackend::writesAny(std::span<const BufferBinding> buffers) const
{
    return std::any_of(buffers.begin(), buffers.end(), [this](const BufferBinding& binding) {
        return graph_->passWrites(pass_, binding.buffer);
    });
}

void GlBackend::draw(const DrawCall& call)
{
    if (!usable() || call.vertices == 0 || call.instances == 0)
        return;
    uint32_t framebuffer = 0;
    if (!useProgram(call.program) || !findFramebuffer(call.targets, call.depthTarget, framebuffer) ||
        !bindInputs(call.textures, call.buffers, call.uniforms))
        return;
    const auto first = std::ranges::find_if(call.targets, [](ResourceId target) { return target.valid(); });
    const ResourceId sized = first == call.targets.end() ? call.depthTarget : *first;
    const FrameGraph::Resource& target = graph_->resource(sized);
    state_.bindFramebuffer(framebuffer,
                           {target.x, target.y, target.width, target.height, target.isHostTarget});
    state_.useTargets(uint32_t(call.targets.size()));
    state_.setBlend(call.blend);
    state_.setDepth(call.depthTarget.valid(), call.reversedDepth);
    if (call.indirect.valid()) {
        const uint32_t arguments = nameOrFail(call.indirect, false, "drawn by");
        if (!arguments)
            return;
        device_.gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, arguments);
        device_.gl.DrawArraysIndirect(GL_TRIANGLES, nullptr);
    } else {
        device_.gl.DrawArraysInstanced(GL_TRIANGLES, 0, static_cast<GLsizei>(call.vertices),
                                       static_cast<GLsizei>(call.instances));
    }
    ++drawCalls_;
    hasDrawn_ = !writesAny(call.buffers);
    if (!hasDrawn_)
        device_.gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

void GlBackend::dispatch(const DispatchCall& call)
{
    if (!usable() || call.groups[0] == 0 || call.groups[1] == 0 || call.groups[2] == 0)
        return;
    if (!useProgram(call.program) || !bindInputs(call.textures, call.buffers, call.uniforms))
        return;
    for (const ImageBinding& binding : call.images) {
        const uint32_t name = nameOrFail(binding.texture, true, "bound as image");
        if (!name || !inRange(binding.unit, kImageUnits, "image unit"))
            return;
        touchState(device_, GlStateGroup::ImageUnit, binding.unit);
        // layered: all of a texture of three dimensions; others have one layer
        device_.gl.BindImageTexture(binding.unit, name, 0, GL_TRUE, 0, GL_READ_WRITE,
                                    glInternalFormat(graph_->resource(binding.texture).format));
    }
    if (hasDrawn_ && writesAny(call.buffers)) // what earlier draws read must not change under them
        device_.gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    device_.gl.DispatchCompute(call.groups[0], call.groups[1], call.groups[2]);
    ++drawCalls_;
    hasDrawn_ = false;
    // Draws are ordered by GL; the writes of a dispatch become visible here.
    device_.gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
}

// ---- transfers ----

/// Through a framebuffer: it stays in order with draws, where glClearTexImage makes software renderers wait
/// for them.
void GlBackend::clear(ResourceId texture, const float (&rgba)[4])
{
    uint32_t framebuffer = 0;
    const bool isDepth =
        graph_ && graph_->contains(texture) && graph_->resource(texture).format == Format::Depth32F;
    const std::span<const ResourceId> colors(&texture, isDepth ? 0 : 1);
    if (!usable() || !findFramebuffer(colors, isDepth ? texture : ResourceId(), framebuffer))
        return;
    state_.openScissor();
    if (isDepth) {
        device_.gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, rgba);
        return;
    }
    const Format format = graph_->resource(texture).format;
    if (format == Format::R32UI || format == Format::RG32UI) {
        const GLuint value[4] = {static_cast<GLuint>(rgba[0]), 0, 0, 0};
        device_.gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 0, value);
    } else {
        device_.gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, rgba);
    }
}

void GlBackend::upload(ResourceId buffer, std::span<const std::byte> bytes)
{
    if (!usable() || bytes.empty())
        return;
    const uint32_t name = nameOrFail(buffer, false, "uploaded to");
    if (!name)
        return;
    const FrameGraph::Resource& resource = graph_->resource(buffer);
    if (bytes.size() > resource.bytes) {
        fail(base::Code::Internal, {"'", resource.name, "' holds ", std::to_string(resource.bytes),
                                    " bytes, ", std::to_string(bytes.size()), " are uploaded"});
        return;
    }
    if (!resource.imported)
        device_.gl.InvalidateBufferData(
            name); // the last frame may still read it: take fresh memory, do not wait
    // NVIDIA's driver (580) writes to a buffer that is bound nowhere without waiting for the draws and
    // dispatches that still use it, whatever barriers came before; to one that is bound, in order.
    touchState(device_, GlStateGroup::StorageBinding, 0);
    device_.gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, name, 0, static_cast<GLsizeiptr>(bytes.size()));
    device_.gl.NamedBufferSubData(name, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void GlBackend::copyTexture(ResourceId source, ResourceId destination)
{
    if (!usable())
        return;
    state_.openScissor();
    const int w = width(source);
    const int h = height(source);
    const auto isFramebuffer = [this](ResourceId id) {
        return graph_->contains(id) && graph_->resource(id).isFramebuffer;
    };
    if (isFramebuffer(source) || isFramebuffer(destination)) {
        uint32_t from = 0;
        uint32_t to = 0;
        if (findFramebuffer({&source, 1}, {}, from) && findFramebuffer({&destination, 1}, {}, to))
            device_.gl.BlitNamedFramebuffer(from, to, 0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT,
                                            GL_NEAREST);
        return;
    }
    const uint32_t from = nameOrFail(source, true, "copied");
    const uint32_t to = from ? nameOrFail(destination, true, "copied to") : 0;
    if (to)
        device_.gl.CopyImageSubData(from, GL_TEXTURE_2D, 0, 0, 0, 0, to, GL_TEXTURE_2D, 0, 0, 0, 0, w, h, 1);
}

} // namespace fx::render
