// Which resources share memory, and that a steady frame takes none from the heap.
#include "graph_test.h"

#include <algorithm>
#include <map>
#include <random>

namespace fx::render {

using FrameGraphMemory = GraphTest;

namespace {

class CountingMemory final : public std::pmr::memory_resource
{
public:
    int allocations = 0;

private:
    void* do_allocate(size_t size, size_t alignment) override
    {
        ++allocations;
        return std::pmr::new_delete_resource()->allocate(size, alignment);
    }
    void do_deallocate(void* memory, size_t size, size_t alignment) override
    {
        std::pmr::new_delete_resource()->deallocate(memory, size, alignment);
    }
    bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

} // namespace

TEST_F(FrameGraphMemory, aChainOfFiltersNeedsTwoTextures)
{
    ResourceId last = source("0");
    for (const std::string_view name : {"1", "2", "3", "4", "5"})
        last = filter(name, {last});
    graph.keep(last);
    graph.compile();
    EXPECT_EQ(executed().size(), 6u);
    EXPECT_EQ(graph.physicalTextures().size(), 2u);
}

TEST_F(FrameGraphMemory, texturesOfDifferentSizeOrFormatAreNeverShared)
{
    const ResourceId a = source("a", 64, Format::RGBA16F);
    const ResourceId b = filter("b", {a}, 32, Format::RGBA16F);
    const ResourceId c = filter("c", {b}, 64, Format::RG32F); // as many bytes as a
    const ResourceId d = filter("d", {c}, 64, Format::RGBA16F);
    graph.keep(d);
    graph.compile();
    EXPECT_EQ(graph.physicalTextures().size(), 3u);
    EXPECT_EQ(graph.resource(d).physical, graph.resource(a).physical);
}

TEST_F(FrameGraphMemory, aKeptTextureIsNotTakenByLaterPasses)
{
    const ResourceId kept = source("kept");
    const ResourceId b = filter("b", {kept});
    const ResourceId c = filter("c", {b});
    graph.keep(kept);
    graph.keep(filter("d", {c}));
    graph.compile();
    for (const ResourceId other : {b, c})
        EXPECT_NE(graph.resource(other).physical, graph.resource(kept).physical);
    EXPECT_EQ(graph.physicalTextures().size(), 3u);
}

TEST_F(FrameGraphMemory, aCulledResourceGetsNoMemory)
{
    const ResourceId unused = source("unused");
    graph.keep(source("used"));
    graph.compile();
    EXPECT_EQ(graph.resource(unused).physical, ~0u);
    EXPECT_EQ(graph.physicalTextures().size(), 1u);
}

TEST_F(FrameGraphMemory, buffersAreSharedAndGrowToTheLargestUser)
{
    std::vector<ResourceId> buffers;
    for (const size_t bytes : {size_t(200), size_t(400), size_t(100)}) {
        addPass(
            graph, "pass",
            [&](FrameGraph::Builder& builder) {
                if (!buffers.empty())
                    builder.read(buffers.back());
                buffers.push_back(builder.write(builder.create(BufferDesc{"buffer", bytes})));
                builder.sideEffect();
            },
            [](Backend&) {});
    }
    graph.compile();
    ASSERT_EQ(graph.physicalBuffers().size(), 2u);
    EXPECT_EQ(graph.resource(buffers[0]).physical, graph.resource(buffers[2]).physical);
    EXPECT_EQ(graph.physicalBuffers()[graph.resource(buffers[0]).physical], 200u);
    EXPECT_EQ(graph.physicalBuffers()[graph.resource(buffers[1]).physical], 400u);
}

/// Lifetimes are measured here once more, from the declared accesses of executed passes.
TEST_F(FrameGraphMemory, sharedTexturesAreNeverAliveAtTheSameTimeInRandomGraphs)
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (int i = 0; i < 40; ++i)
            all.push_back("pass " + std::to_string(i));
        return all;
    }();
    std::mt19937 random(1);
    size_t shared = 0;
    for (int round = 0; round < 200; ++round) {
        graph.begin();
        std::vector<ResourceId> live;
        std::vector<ResourceId> all;
        for (const std::string& name : names) {
            std::vector<ResourceId> inputs;
            for (uint32_t i = 0; i < random() % 3 && !live.empty(); ++i)
                inputs.push_back(live[random() % live.size()]);
            if (random() % 4 == 0 && !live.empty()) {
                ResourceId& target = live[random() % live.size()];
                target = blend(name, target);
            } else {
                live.push_back(filter(name, inputs, 32 << (random() % 2)));
                all.push_back(live.back());
            }
        }
        const ResourceId kept = live[random() % live.size()];
        graph.keep(kept);
        graph.keep(live.back());
        graph.compile();
        ASSERT_TRUE(graph.status().ok()) << graph.status().message();

        std::map<uint32_t, std::vector<std::pair<size_t, size_t>>> users;
        for (const ResourceId id : all) {
            size_t first = ~size_t(0);
            size_t last = 0;
            for (size_t pass = 0; pass < graph.executedPasses().size(); ++pass) {
                if (graph.passReads(pass, id) || graph.passWrites(pass, id)) {
                    first = std::min(first, pass);
                    last = pass;
                }
            }
            const auto& resource = graph.resource(id);
            ASSERT_EQ(resource.physical != ~0u, first != ~size_t(0));
            if (resource.physical == ~0u)
                continue;
            if (&resource == &graph.resource(kept) || &resource == &graph.resource(live.back()))
                last = ~size_t(0);
            ASSERT_EQ(graph.physicalTextures()[resource.physical].width, resource.width);
            for (const auto& [otherFirst, otherLast] : users[resource.physical]) {
                ++shared;
                ASSERT_TRUE(last < otherFirst || otherLast < first) << "round " << round;
            }
            users[resource.physical].push_back({first, last});
        }
    }
    EXPECT_GT(shared, 100u) << "the random graphs must share, or the test shows nothing";
}

TEST(FrameGraphHeap, aFrameLikeTheOneBeforeAllocatesNothing)
{
    CountingMemory memory;
    FrameGraph graph(&memory);
    const auto frame = [&graph] {
        graph.begin();
        const ResourceId host = graph.importTexture({"host", 8, 8, Format::RGBA8}, 1);
        ResourceId last = host;
        for (int i = 0; i < 20; ++i) {
            addPass(
                graph, "filter",
                [&](FrameGraph::Builder& builder) {
                    builder.read(last);
                    last = builder.write(builder.create(TextureDesc{"texture", 8, 8, Format::RGBA8}));
                },
                [i](Backend& backend) { (void)backend.width({static_cast<uint32_t>(i)}); });
        }
        graph.keep(last);
        graph.compile();
        RecordingBackend backend(graph);
        graph.execute(backend);
    };
    frame();
    const int afterWarmUp = memory.allocations;
    EXPECT_GT(afterWarmUp, 0);
    frame();
    frame();
    EXPECT_EQ(memory.allocations, afterWarmUp);
}

} // namespace fx::render
