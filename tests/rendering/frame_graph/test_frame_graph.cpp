// What is executed, and in which order.
#include "graph_test.h"

namespace fx::render {

using FrameGraphTest = GraphTest;

TEST_F(FrameGraphTest, anEmptyGraphExecutesNothing)
{
    graph.compile();
    RecordingBackend backend(graph);
    graph.execute(backend);
    EXPECT_TRUE(graph.status().ok());
    EXPECT_TRUE(backend.passes().empty());
    EXPECT_EQ(graph.culledPasses(), 0u);
}

TEST_F(FrameGraphTest, nothingIsExecutedWhenNothingIsKept)
{
    filter("b", {source("a")});
    graph.compile();
    EXPECT_TRUE(executed().empty());
    EXPECT_EQ(graph.culledPasses(), 2u);
    EXPECT_TRUE(graph.physicalTextures().empty());
}

TEST_F(FrameGraphTest, keepingAResultExecutesWhatLeadsToItInDeclarationOrder)
{
    const ResourceId a = source("a");
    const ResourceId b = source("b");
    source("unused");
    const ResourceId c = filter("c", {b, a});
    filter("also unused", {c});
    graph.keep(c);
    graph.compile();
    EXPECT_EQ(executed(), (Names{"a", "b", "c"}));
    EXPECT_EQ(graph.culledPasses(), 2u);
}

TEST_F(FrameGraphTest, aPassThatBlendsOverATextureNeedsThePassThatFilledIt)
{
    const ResourceId filled = source("fill");
    graph.keep(blend("blend", filled));
    graph.compile();
    EXPECT_EQ(executed(), (Names{"fill", "blend"}));
}

TEST_F(FrameGraphTest, blendingAfterTheLastReaderIsCulledWithoutItsTarget)
{
    const ResourceId filled = source("fill");
    const ResourceId read = filter("read", {filled});
    (void)blend("too late", filled);
    graph.keep(read);
    graph.compile();
    EXPECT_EQ(executed(), (Names{"fill", "read"}));
}

TEST_F(FrameGraphTest, aSideEffectKeepsAPassAndItsInputs)
{
    const ResourceId a = source("a");
    addPass(
        graph, "readback",
        [&](FrameGraph::Builder& builder) {
            builder.read(a);
            builder.sideEffect();
        },
        [](Backend&) {});
    graph.compile();
    EXPECT_EQ(executed(), (Names{"a", "readback"}));
}

TEST_F(FrameGraphTest, writingAnImportedTextureIsNotEnoughToBeExecuted)
{
    const ResourceId host = graph.importTexture(texture("host"), 7);
    (void)blend("draw", host);
    graph.compile();
    EXPECT_TRUE(executed().empty());
}

TEST_F(FrameGraphTest, everyVersionOfAResourceIsTheSameTexture)
{
    const ResourceId first = source("target");
    const ResourceId second = blend("over", first);
    graph.keep(second);
    graph.compile();
    EXPECT_NE(first.index, second.index);
    EXPECT_EQ(&graph.resource(first), &graph.resource(second));
    EXPECT_EQ(graph.resource(second).name, "target");
    EXPECT_EQ(graph.physicalTextures().size(), 1u);
}

TEST_F(FrameGraphTest, importedResourcesKeepTheirNameAndGetNoMemory)
{
    const ResourceId host = graph.importTexture(texture("host", 16, Format::RGBA8), 7);
    const ResourceId window = graph.importFramebuffer(texture("window", 32), 0);
    const ResourceId data = graph.importBuffer({"data", 48}, 9);
    graph.keep(blend("draw", host));
    graph.keep(blend("present", window));
    graph.compile();
    EXPECT_TRUE(graph.physicalTextures().empty());
    EXPECT_EQ(graph.resource(host).importedName, 7u);
    EXPECT_EQ(graph.resource(host).width, 16);
    EXPECT_FALSE(graph.resource(host).isFramebuffer);
    EXPECT_TRUE(graph.resource(window).isFramebuffer);
    EXPECT_EQ(graph.resource(data).bytes, 48u);
    EXPECT_FALSE(graph.resource(data).isTexture);
}

TEST_F(FrameGraphTest, executionHandsEachPassTheStateItCaptured)
{
    int counts[2] = {0, 0};
    for (int i = 0; i < 2; ++i) {
        addPass(
            graph, i == 0 ? "first" : "second", [](FrameGraph::Builder& builder) { builder.sideEffect(); },
            [count = &counts[i], i](Backend&) { *count += 10 + i; });
    }
    graph.compile();
    RecordingBackend backend(graph);
    graph.execute(backend);
    EXPECT_EQ(counts[0], 10);
    EXPECT_EQ(counts[1], 11);
    EXPECT_EQ(backend.passes(), (Names{"first", "second"}));
}

TEST_F(FrameGraphTest, declaredAccessesCanBeAskedForByExecutedPass)
{
    source("culled");
    const ResourceId a = source("a");
    const ResourceId b = filter("b", {a});
    graph.keep(b);
    graph.compile();
    EXPECT_TRUE(graph.passWrites(0, a));
    EXPECT_FALSE(graph.passReads(0, a));
    EXPECT_TRUE(graph.passReads(1, a));
    EXPECT_TRUE(graph.passWrites(1, b));
    EXPECT_FALSE(graph.passWrites(2, b));
}

TEST_F(FrameGraphTest, beginForgetsTheFrameBefore)
{
    graph.keep(source("a"));
    graph.compile();
    graph.begin();
    graph.compile();
    EXPECT_TRUE(executed().empty());
    EXPECT_TRUE(graph.physicalTextures().empty());
}

TEST_F(FrameGraphTest, theDrawingForPeopleShowsVersionsAndDashesCulledPasses)
{
    const ResourceId a = source("a");
    source("unused");
    graph.keep(blend("over", a));
    graph.compile();
    EXPECT_EQ(graph.toGraphviz(), "digraph frame {\n"
                                  "  rankdir=LR;\n"
                                  "  pass0 [shape=box label=\"a\"];\n"
                                  "  pass0 -> \"a #0 v1\";\n"
                                  "  pass1 [shape=box label=\"unused\" style=dashed];\n"
                                  "  pass1 -> \"unused #1 v1\";\n"
                                  "  pass2 [shape=box label=\"over\"];\n"
                                  "  pass2 -> \"a #0 v2\";\n"
                                  "  \"a #0 v1\" -> pass2;\n"
                                  "}\n");
}

} // namespace fx::render
