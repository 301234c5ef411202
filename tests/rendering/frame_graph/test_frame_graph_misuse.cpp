// A graph that was declared wrongly says so, and executes nothing.
#include "graph_test.h"

namespace fx::render {

class FrameGraphMisuse : public GraphTest
{
protected:
    /// The graph refused itself with a message that holds `words`.
    void expectRefused(std::initializer_list<const char*> words)
    {
        graph.compile();
        EXPECT_FALSE(graph.status().ok());
        for (const char* word : words)
            EXPECT_NE(graph.status().message().find(word), std::string::npos)
                << "'" << word << "' in: " << graph.status().message();
        RecordingBackend backend(graph);
        graph.execute(backend);
        EXPECT_TRUE(backend.passes().empty());
    }
};

TEST_F(FrameGraphMisuse, readingAnOverwrittenVersionIsRefusedByName)
{
    const ResourceId old = source("picture");
    (void)blend("painter", old);
    graph.keep(filter("reader", {old}));
    expectRefused({"reader", "picture", "version 1", "painter"});
}

TEST_F(FrameGraphMisuse, writingAnOverwrittenVersionIsRefusedByName)
{
    const ResourceId old = source("picture");
    (void)blend("painter", old);
    graph.keep(blend("second painter", old));
    expectRefused({"second painter", "picture", "painter"});
}

TEST_F(FrameGraphMisuse, keepingAnOverwrittenVersionIsRefused)
{
    const ResourceId old = source("picture");
    (void)blend("painter", old);
    graph.keep(old);
    expectRefused({"keep", "picture"});
}

TEST_F(FrameGraphMisuse, aPassMayReadWhatItThenOverwrites)
{
    const ResourceId a = source("a");
    ResourceId out;
    addPass(
        graph, "read and write",
        [&](FrameGraph::Builder& builder) {
            out = builder.write(a);
            builder.read(a);
        },
        [](Backend&) {});
    graph.keep(out);
    graph.compile();
    EXPECT_TRUE(graph.status().ok()) << graph.status().message();
}

TEST_F(FrameGraphMisuse, readingWhatNobodyWroteIsRefused)
{
    ResourceId created;
    addPass(
        graph, "forgetful", [&](FrameGraph::Builder& builder) { created = builder.create(texture("empty")); },
        [](Backend&) {});
    graph.keep(filter("reader", {created}));
    expectRefused({"reader", "empty", "no pass has written"});
}

TEST_F(FrameGraphMisuse, readingAFramebufferIsRefused)
{
    const ResourceId window = graph.importFramebuffer(texture("window"), 0);
    graph.keep(filter("reader", {window}));
    expectRefused({"reader", "window", "framebuffer"});
}

TEST_F(FrameGraphMisuse, aHandleOfAnotherFrameIsRefused)
{
    for (int i = 0; i < 3; ++i)
        source("filler");
    const ResourceId foreign = source("foreign");
    graph.begin();
    graph.keep(filter("reader", {foreign}));
    expectRefused({"reader", "does not know"});
}

TEST_F(FrameGraphMisuse, theNullHandleIsRefused)
{
    graph.keep(ResourceId{});
    expectRefused({"keep", "does not know"});
}

TEST_F(FrameGraphMisuse, aTextureWithoutAreaIsRefused)
{
    graph.keep(source("nothing", 0));
    expectRefused({"nothing", "no size"});
}

TEST_F(FrameGraphMisuse, theNextFrameStartsClean)
{
    graph.keep(source("nothing", 0));
    graph.compile();
    ASSERT_FALSE(graph.status().ok());
    graph.begin();
    graph.keep(source("something"));
    graph.compile();
    EXPECT_TRUE(graph.status().ok());
    EXPECT_EQ(executed(), (Names{"something"}));
}

} // namespace fx::render
