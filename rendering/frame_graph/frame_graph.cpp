#include "rendering/frame_graph/frame_graph.h"

#include <cstring>

namespace fx::render {

FrameGraph::FrameGraph(std::pmr::memory_resource* memory)
    : resources_(memory), lifetimes_(memory), versions_(memory), passes_(memory), accesses_(memory),
      executedIndex_(memory), executed_(memory), physicalTextures_(memory), physicalBuffers_(memory),
      order_(memory), busyUntil_(memory)
{}

void FrameGraph::begin()
{
    status_ = {};
    resources_.clear();
    lifetimes_.clear();
    versions_.clear();
    passes_.clear();
    accesses_.clear();
    executedIndex_.clear();
    executed_.clear();
    physicalTextures_.clear();
    physicalBuffers_.clear();
}

void FrameGraph::misuse(std::string message)
{
    if (status_.ok())
        status_ = {base::Code::Internal, std::move(message)};
}

// ---- declaration ----

ResourceId FrameGraph::addResource(const Resource& resource, uint32_t creator)
{
    const bool hasSize = resource.isTexture ? resource.width > 0 && resource.height > 0 : resource.bytes > 0;
    if (!hasSize)
        misuse("frame graph: '" + std::string(resource.name) + "' has no size");
    const auto index = static_cast<uint32_t>(resources_.size());
    const auto version = static_cast<uint32_t>(versions_.size());
    resources_.push_back(resource);
    lifetimes_.push_back({version, creator, kNone, 0, false});
    versions_.push_back({index, 0, kNone, kNone, false});
    return {version};
}

ResourceId FrameGraph::importTexture(const TextureDesc& desc, uint32_t name)
{
    return addResource({.name = desc.name,
                        .imported = true,
                        .width = desc.width,
                        .height = desc.height,
                        .format = desc.format,
                        .x = desc.x,
                        .y = desc.y,
                        .importedName = name},
                       kNone);
}

ResourceId FrameGraph::importTarget(const TextureDesc& desc, uint32_t name)
{
    const ResourceId id = importTexture(desc, name);
    resources_.back().isHostTarget = true;
    return id;
}

ResourceId FrameGraph::importFramebuffer(const TextureDesc& desc, uint32_t framebuffer)
{
    const ResourceId id = importTexture(desc, framebuffer);
    resources_.back().isFramebuffer = resources_.back().isHostTarget = true;
    return id;
}

ResourceId FrameGraph::importBuffer(const BufferDesc& desc, uint32_t name)
{
    return addResource(
        {.name = desc.name, .isTexture = false, .imported = true, .bytes = desc.bytes, .importedName = name},
        kNone);
}

ResourceId FrameGraph::Builder::create(const TextureDesc& desc)
{
    return graph_.addResource(
        {.name = desc.name, .width = desc.width, .height = desc.height, .format = desc.format}, pass_);
}

ResourceId FrameGraph::Builder::create(const BufferDesc& desc)
{
    return graph_.addResource({.name = desc.name, .isTexture = false, .bytes = desc.bytes}, pass_);
}

/// Whether `id` is the newest version and holds something; remembers misuse otherwise.
bool FrameGraph::checkCurrent(ResourceId id, std::string_view user, const char* verb, uint32_t pass)
{

    if (!contains(id)) {
        misuse(
            std::string(user).append(" ").append(verb).append(" a resource that this frame does not know"));
        return false;
    }
    const Version& version = versions_[id.index];
    const Lifetime& lifetime = lifetimes_[version.resource];
    const Version& latest = versions_[lifetime.latest];
    const bool ownWrite = latest.previous == id.index && latest.writer == pass && pass != kNone;
    if (lifetime.latest != id.index && !ownWrite) {
        misuse(std::string(user)
                   .append(" ")
                   .append(verb)
                   .append(" version ")
                   .append(std::to_string(version.number))
                   .append(" of '")
                   .append(resources_[version.resource].name)
                   .append("', which '")
                   .append(passes_[latest.writer].name)
                   .append("' has overwritten"));
        return false;
    }
    return true;
}

void FrameGraph::addAccess(uint32_t pass, uint32_t version, bool isWrite)
{
    accesses_.push_back({version, isWrite});
    passes_[pass].lastAccess = static_cast<uint32_t>(accesses_.size());
}

void FrameGraph::Builder::read(ResourceId resource)
{
    const std::string_view name = graph_.passes_[pass_].name;
    if (!graph_.checkCurrent(resource, name, "reads", pass_))
        return;
    const Version& version = graph_.versions_[resource.index];
    const Resource& described = graph_.resource(resource);
    if (version.writer == kNone && !described.imported)
        graph_.misuse(std::string(name) + " reads '" + std::string(described.name) +
                      "', which no pass has written");
    if (described.isFramebuffer)
        graph_.misuse(std::string(name) + " reads '" + std::string(described.name) + "', a framebuffer");
    graph_.addAccess(pass_, resource.index, false);
}

ResourceId FrameGraph::Builder::write(ResourceId resource)
{
    if (!graph_.checkCurrent(resource, graph_.passes_[pass_].name, "writes", kNone))
        return resource;
    const Version before = graph_.versions_[resource.index];
    const auto index = static_cast<uint32_t>(graph_.versions_.size());
    graph_.versions_.push_back({before.resource, before.number + 1, pass_, resource.index, false});
    graph_.lifetimes_[before.resource].latest = index;
    graph_.addAccess(pass_, index, true);
    return {index};
}

void FrameGraph::Builder::sideEffect()
{
    graph_.passes_[pass_].sideEffect = true;
}

uint32_t FrameGraph::newPass(std::string_view name)
{
    const auto accessCount = static_cast<uint32_t>(accesses_.size());
    Pass& pass = passes_.emplace_back();
    pass.name = name;
    pass.firstAccess = pass.lastAccess = accessCount;
    pass.sideEffect = pass.alive = false;
    pass.run = nullptr;
    return static_cast<uint32_t>(passes_.size() - 1);
}

void FrameGraph::storeExecute(uint32_t pass, const void* state, size_t bytes, void (*run)(void*, Backend&))
{
    std::memcpy(passes_[pass].state, state, bytes);
    passes_[pass].run = run;
}

void FrameGraph::keep(ResourceId resource)
{
    if (!checkCurrent(resource, "keep()", "names", kNone))
        return;
    versions_[resource.index].needed = true;
    lifetimes_[versions_[resource.index].resource].kept = true;
}

// ---- execution and inspection ----

std::span<const FrameGraph::Access> FrameGraph::accesses(const Pass& pass) const
{
    return std::span(accesses_).subspan(pass.firstAccess, pass.lastAccess - pass.firstAccess);
}

void FrameGraph::execute(Backend& backend)
{
    for (const uint32_t index : executedIndex_) {
        Pass& pass = passes_[index];
        backend.beginPass(pass.name);
        pass.run(pass.state, backend);
        backend.endPass();
    }
}

bool FrameGraph::passAccesses(size_t executedIndex, ResourceId id, bool isWrite) const
{
    if (executedIndex >= executedIndex_.size() || !contains(id))
        return false;
    const uint32_t resource = versions_[id.index].resource;
    for (const Access& access : accesses(passes_[executedIndex_[executedIndex]])) {
        if (access.isWrite == isWrite && versions_[access.version].resource == resource)
            return true;
    }
    return false;
}

} // namespace fx::render
