/// @file frame_graph.h
/// Graph of the passes of one frame, with their declared reads and writes. Unread results are not computed.
/// Resources with disjoint lifetimes share memory.
///
/// Use: begin(), import external resources, addPass() in order of execution, keep() the results, compile(),
/// execute(). Source of the idea: O'Donnell, "FrameGraph" (GDC 2017). After misuse, status() returns an
/// error and no pass is executed. Misuse is the use of an old version, a read of an unwritten resource, or
/// an empty size. A frame allocates nothing if an earlier frame was at least as large. Threads: one thread
/// at a time.
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame_graph/backend.h"

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace fx::render {

struct TextureDesc
{
    std::string_view name; ///< string literal
    int width = 0;         ///< [pixel] > 0
    int height = 0;        ///< [pixel] > 0
    Format format = Format::RGBA32F;
    int x = 0; ///< [pixel] left column of the frame in an imported target
    int y = 0; ///< [pixel] low row of the frame in an imported target
};

struct BufferDesc
{
    std::string_view name; ///< string literal
    size_t bytes = 0;      ///< > 0
};

/// A texture that a backend creates. One or more textures of the graph use it during a frame.
struct PhysicalTexture
{
    int width, height;
    Format format;
};

class FrameGraph
{
public:
    /// Argument of the setup function of a pass. The setup function declares the resources of the pass.
    class Builder
    {
    public:
        ResourceId create(const TextureDesc& desc);
        ResourceId create(const BufferDesc& desc);
        void read(ResourceId resource);
        /// Declares a write and returns the new version. Later passes must not read the old version. A write
        /// also counts as a read of the old version (blending, partial update), unless the same pass created
        /// the resource.
        [[nodiscard]] ResourceId write(ResourceId resource);
        /// Declares that the pass is executed even if its results are not read.
        void sideEffect();

    private:
        friend class FrameGraph;
        Builder(FrameGraph& graph, uint32_t pass) : graph_(graph), pass_(pass) {}
        FrameGraph& graph_;
        uint32_t pass_;
    };

    explicit FrameGraph(std::pmr::memory_resource* memory);

    /// Removes the passes and resources of the last frame. Allocated memory is kept.
    void begin();

    /// Adds a texture or buffer that exists outside of the graph. @param name GL name
    ResourceId importTexture(const TextureDesc& desc, uint32_t name);
    /// Adds a framebuffer of the host as a color target. Passes can draw to the framebuffer, but cannot
    /// sample it.
    ResourceId importFramebuffer(const TextureDesc& desc, uint32_t framebuffer);
    /// Adds a texture of the host as a color target, to which its scissor test may apply.
    ResourceId importTarget(const TextureDesc& desc, uint32_t name);
    ResourceId importBuffer(const BufferDesc& desc, uint32_t name);

    /// Adds a pass. `setup(Builder&)` is called at once and declares the resources of the pass. `setup` may
    /// capture by reference. `setup` returns a function `execute(Backend&)`, which FrameGraph::execute()
    /// calls later. The returned function captures data by value: at most kExecuteBytes of trivially
    /// copyable state.
    template <class Setup>
    void addPass(std::string_view name, Setup&& setup)
    {
        const uint32_t pass = newPass(name);
        Builder builder(*this, pass);
        auto execute = setup(builder);
        using Execute = decltype(execute);
        static_assert(sizeof(Execute) <= kExecuteBytes && std::is_trivially_copyable_v<Execute>);
        storeExecute(pass, &execute, sizeof execute,
                     [](void* state, Backend& backend) { (*static_cast<Execute*>(state))(backend); });
    }

    /// Marks a resource as a result of the frame. Passes that contribute to the resource are not culled.
    void keep(ResourceId resource);

    /// Culls passes, computes the lifetimes of resources and assigns physical textures. The remaining passes
    /// keep the order of their declaration.
    void compile();
    void execute(Backend& backend);

    /// Returns the error of the first misuse since begin(), or Ok. The error has the code Internal, and its
    /// message names pass and resource. compile() does not change the status.
    const base::Status& status() const { return status_; }

    // ---- results of compile(), for backends, statistics and tests ----
    struct Resource
    {
        std::string_view name;
        bool isTexture = true;
        bool imported = false;
        bool isFramebuffer = false;
        int width = 0, height = 0;
        Format format = Format::RGBA32F;
        int x = 0, y = 0;
        bool isHostTarget = false; ///< the host's scissor test may limit draws to it
        size_t bytes = 0;
        uint32_t importedName = 0;
        uint32_t physical = ~0u; ///< index of the physical texture or buffer; ~0 if imported or never used
    };
    /// Returns the resource to which a version belongs.
    const Resource& resource(ResourceId id) const { return resources_[versions_[id.index].resource]; }
    /// True if the id belongs to a resource of this frame.
    bool contains(ResourceId id) const { return id.index < versions_.size(); }
    std::span<const PhysicalTexture> physicalTextures() const { return physicalTextures_; }
    std::span<const size_t> physicalBuffers() const { return physicalBuffers_; } ///< [byte]
    /// Planned memory of the frame's transient resources, without imported resources.
    struct Memory
    {
        uint64_t unshared; ///< [byte] size of the resources if they did not share memory
        uint64_t shared;   ///< [byte] size with memory shared between resources of disjoint lifetimes
    };
    Memory memory() const;
    std::span<const std::string_view> executedPasses() const { return executed_; }
    uint32_t culledPasses() const { return static_cast<uint32_t>(passes_.size() - executed_.size()); }
    /// True if the executed pass with this index declared a read of any version of the resource.
    /// passWrites() tests for writes.
    bool passReads(size_t executedIndex, ResourceId id) const
    {
        return passAccesses(executedIndex, id, false);
    }
    bool passWrites(size_t executedIndex, ResourceId id) const
    {
        return passAccesses(executedIndex, id, true);
    }
    std::string toGraphviz() const; ///< the graph in the DOT language; culled passes are dashed

    static constexpr size_t kExecuteBytes = 512;

private:
    static constexpr uint32_t kNone = ~0u;

    /// The state of a resource between two writes.
    struct Version
    {
        uint32_t resource;
        uint32_t number;   ///< number of the version; 0 before the first write of this frame
        uint32_t writer;   ///< index of the pass that wrote the version; kNone for number 0
        uint32_t previous; ///< index of the version that the write replaced
        bool needed;       ///< true: an executed pass reads the version, or the version was passed to keep()
    };
    struct Access
    {
        uint32_t version;
        bool isWrite;
    };
    struct Pass
    {
        std::string_view name;
        uint32_t firstAccess;
        uint32_t lastAccess; ///< index of the last access + 1
        bool sideEffect;
        bool alive;
        void (*run)(void* state, Backend& backend);
        alignas(std::max_align_t) std::byte state[kExecuteBytes];
    };
    /// Lifetime of a resource, as indices of executed passes.
    struct Lifetime
    {
        uint32_t latest; ///< latest version of the resource
        uint32_t creator;
        uint32_t first;
        uint32_t last;
        bool kept;
    };

    uint32_t newPass(std::string_view name);
    void storeExecute(uint32_t pass, const void* state, size_t bytes, void (*run)(void*, Backend&));
    ResourceId addResource(const Resource& resource, uint32_t creator);
    void addAccess(uint32_t pass, uint32_t version, bool isWrite);
    bool checkCurrent(ResourceId id, std::string_view user, const char* verb, uint32_t pass);
    void misuse(std::string message);
    void cull();
    void measureLifetimes();
    void orderByFirstUse();
    void assignTextures();
    void assignBuffers();
    bool passAccesses(size_t executedIndex, ResourceId id, bool isWrite) const;
    std::span<const Access> accesses(const Pass& pass) const;
    std::string versionLabel(uint32_t index) const;

    base::Status status_;
    std::pmr::vector<Resource> resources_;
    std::pmr::vector<Lifetime> lifetimes_; ///< one per resource
    std::pmr::vector<Version> versions_;
    std::pmr::vector<Pass> passes_;
    std::pmr::vector<Access> accesses_;
    std::pmr::vector<uint32_t> executedIndex_; ///< for each executed pass: its index in passes_
    std::pmr::vector<std::string_view> executed_;
    std::pmr::vector<PhysicalTexture> physicalTextures_;
    std::pmr::vector<size_t> physicalBuffers_;
    std::pmr::vector<uint32_t> order_; ///< scratch: transient resources, sorted by first use
    /// Scratch: for each physical resource, index of the last pass that uses it.
    std::pmr::vector<uint32_t> busyUntil_;
};

} // namespace fx::render
