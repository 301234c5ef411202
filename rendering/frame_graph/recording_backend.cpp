#include "rendering/frame_graph/recording_backend.h"

#include <algorithm>
#include <iterator>

namespace fx::render {

std::vector<RecordingBackend::Operation> RecordingBackend::operationsOf(std::string_view pass) const
{
    std::vector<Operation> found;
    std::copy_if(operations_.begin(), operations_.end(), std::back_inserter(found),
                 [&](const Operation& operation) { return operation.pass == pass; });
    return found;
}

size_t RecordingBackend::count(Kind kind) const
{
    return static_cast<size_t>(
        std::count_if(operations_.begin(), operations_.end(),
                      [&](const Operation& operation) { return operation.kind == kind; }));
}

RecordingBackend::Operation& RecordingBackend::add(Kind kind)
{
    Operation& operation = operations_.emplace_back();
    operation.kind = kind;
    operation.pass = passes_.empty() ? std::string_view("(outside of a pass)") : passes_.back();
    return operation;
}

void RecordingBackend::violation(std::string_view what, ResourceId id)
{
    const std::string_view name = graph_.contains(id) ? graph_.resource(id).name : "(an unknown resource)";
    violations_.push_back(std::string(operations_.back().pass) + " " + std::string(what) + " '" +
                          std::string(name) + "'");
}

void RecordingBackend::needRead(ResourceId id)
{
    if (passes_.empty() || !graph_.passReads(passes_.size() - 1, id))
        violation("reads without declaring it", id);
}

void RecordingBackend::needWrite(ResourceId id)
{
    if (passes_.empty() || !graph_.passWrites(passes_.size() - 1, id))
        violation("writes without declaring it", id);
}

void RecordingBackend::checkFeedback(const Operation& operation)
{
    for (const TextureBinding& binding : operation.textures) {
        for (const ResourceId target : operation.targets) {
            if (graph_.contains(target) && graph_.contains(binding.texture) &&
                &graph_.resource(target) == &graph_.resource(binding.texture))
                violation("samples what it draws to:", target);
        }
    }
}

void RecordingBackend::beginPass(std::string_view name)
{
    passes_.push_back(name);
}

void RecordingBackend::endPass() {}

void RecordingBackend::clear(ResourceId texture, const float (&rgba)[4])
{
    Operation& operation = add(Kind::Clear);
    operation.targets = {texture};
    std::copy(std::begin(rgba), std::end(rgba), operation.color);
    needWrite(texture);
}

void RecordingBackend::draw(const DrawCall& call)
{
    Operation& operation = add(Kind::Draw);
    operation.program = call.program;
    operation.targets.assign(call.targets.begin(), call.targets.end());
    operation.textures.assign(call.textures.begin(), call.textures.end());
    operation.buffers.assign(call.buffers.begin(), call.buffers.end());
    operation.bytes.assign(call.uniforms.begin(), call.uniforms.end());
    operation.blend = call.blend;
    operation.vertices = call.vertices;
    operation.instances = call.instances;
    operation.depthTarget = call.depthTarget;
    operation.reversedDepth = call.reversedDepth;
    if (call.indirect.valid())
        needRead(call.indirect);

    if (!call.program)
        violation("draws without a program into", call.targets.empty() ? ResourceId{} : call.targets[0]);
    ResourceId first;
    for (const ResourceId target : call.targets) {
        if (!target.valid() && call.targets.size() > 1)
            continue;
        needWrite(target);
        if (!first.valid())
            first = target;
        if (graph_.contains(target) && graph_.contains(first) &&
            (width(target) != width(first) || height(target) != height(first)))
            violation("draws to targets of unequal size:", target);
    }
    if (call.depthTarget.valid())
        needWrite(call.depthTarget);
    for (const TextureBinding& binding : call.textures)
        needRead(binding.texture);
    for (const BufferBinding& binding : call.buffers) {
        if (!graph_.passWrites(passes_.size() - 1, binding.buffer))
            needRead(binding.buffer);
    }
    checkFeedback(operation);
}

void RecordingBackend::dispatch(const DispatchCall& call)
{
    Operation& operation = add(Kind::Dispatch);
    operation.program = call.program;
    operation.textures.assign(call.textures.begin(), call.textures.end());
    operation.images.assign(call.images.begin(), call.images.end());
    operation.buffers.assign(call.buffers.begin(), call.buffers.end());
    operation.bytes.assign(call.uniforms.begin(), call.uniforms.end());
    std::copy(std::begin(call.groups), std::end(call.groups), operation.groups);

    if (!call.program)
        violation("dispatches without a program", {});
    for (const TextureBinding& binding : call.textures)
        needRead(binding.texture);
    for (const ImageBinding& binding : call.images)
        needWrite(binding.texture);
    for (const BufferBinding& binding : call.buffers) {
        if (!graph_.passWrites(passes_.size() - 1, binding.buffer))
            needRead(binding.buffer);
    }
}

void RecordingBackend::upload(ResourceId buffer, std::span<const std::byte> bytes)
{
    Operation& operation = add(Kind::Upload);
    operation.targets = {buffer};
    operation.bytes.assign(bytes.begin(), bytes.end());
    needWrite(buffer);
    if (graph_.contains(buffer) && bytes.size() > graph_.resource(buffer).bytes)
        violation("uploads more than fits into", buffer);
}

void RecordingBackend::copyTexture(ResourceId source, ResourceId destination)
{
    Operation& operation = add(Kind::Copy);
    operation.targets = {destination};
    operation.copySource = source;
    needRead(source);
    needWrite(destination);
}

} // namespace fx::render
