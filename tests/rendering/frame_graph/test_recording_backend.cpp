// The backend without graphics notes operations and breaches of what was declared.
#include "graph_test.h"

#include <array>
#include <cstring>

namespace fx::render {

namespace {

constexpr ProgramDesc kProgram = {"program", "vertex", "fragment", nullptr, nullptr};
constexpr ProgramDesc kCompute = {"compute", nullptr, nullptr, "compute", nullptr};

struct Block
{
    float value[4];
};

} // namespace

class RecordingBackendTest : public GraphTest
{
protected:
    /// Compiles, executes and gives what was recorded.
    RecordingBackend run()
    {
        graph.compile();
        EXPECT_TRUE(graph.status().ok()) << graph.status().message();
        RecordingBackend backend(graph);
        graph.execute(backend);
        return backend;
    }

    /// A side-effect pass that declares nothing and runs `execute`.
    template <class Execute>
    void undeclared(Execute execute)
    {
        addPass(
            graph, "sloppy", [](FrameGraph::Builder& builder) { builder.sideEffect(); }, execute);
    }
};

TEST_F(RecordingBackendTest, aDrawIsRecordedWithCopiesOfItsData)
{
    const ResourceId input = source("input");
    ResourceId target;
    addPass(
        graph, "draw",
        [&](FrameGraph::Builder& builder) {
            builder.read(input);
            target = builder.write(builder.create(texture("target")));
        },
        [input, &target](Backend& backend) {
            const Block block = {{1, 2, 3, 4}};
            const std::array textures = {TextureBinding{3, input, Sampling::Linear}};
            backend.clear(target, {0, 0, 0, 1});
            backend.draw({.program = &kProgram,
                          .targets = {&target, 1},
                          .textures = textures,
                          .uniforms = asUniforms(block),
                          .blend = Blend::Additive,
                          .vertices = 6,
                          .instances = 270});
        });
    graph.keep(target);
    const RecordingBackend backend = run();
    EXPECT_TRUE(backend.violations().empty()) << backend.violations().front();
    const auto operations = backend.operationsOf("draw");
    ASSERT_EQ(operations.size(), 2u);
    EXPECT_EQ(operations[0].kind, RecordingBackend::Kind::Clear);
    EXPECT_EQ(operations[0].color[3], 1.0f);
    const RecordingBackend::Operation& draw = operations[1];
    EXPECT_EQ(draw.kind, RecordingBackend::Kind::Draw);
    EXPECT_EQ(draw.program, &kProgram);
    EXPECT_EQ(draw.instances, 270u);
    EXPECT_EQ(draw.blend, Blend::Additive);
    ASSERT_EQ(draw.textures.size(), 1u);
    EXPECT_EQ(draw.textures[0].unit, 3u);
    ASSERT_EQ(draw.bytes.size(), sizeof(Block));
    float third = 0;
    std::memcpy(&third, draw.bytes.data() + 8, sizeof third);
    EXPECT_EQ(third, 3.0f);
    EXPECT_EQ(backend.count(RecordingBackend::Kind::Draw), 1u);
}

TEST_F(RecordingBackendTest, dispatchesUploadsAndCopiesAreRecordedAndDeclared)
{
    const ResourceId input = source("input");
    ResourceId buffer;
    ResourceId image;
    addPass(
        graph, "compute",
        [&](FrameGraph::Builder& builder) {
            builder.read(input);
            buffer = builder.write(builder.create(BufferDesc{"buffer", 16}));
            image = builder.write(builder.create(texture("image")));
        },
        [input, &buffer, &image](Backend& backend) {
            const Block block = {{1, 2, 3, 4}};
            backend.upload(buffer, asUniforms(block));
            const std::array images = {ImageBinding{0, image}};
            const std::array buffers = {BufferBinding{2, buffer}};
            backend.dispatch(
                {.program = &kCompute, .images = images, .buffers = buffers, .groups = {8, 4, 2}});
            backend.copyTexture(input, image);
        });
    graph.keep(image);
    const RecordingBackend backend = run();
    EXPECT_TRUE(backend.violations().empty()) << backend.violations().front();
    const auto operations = backend.operationsOf("compute");
    ASSERT_EQ(operations.size(), 3u);
    EXPECT_EQ(operations[0].bytes.size(), 16u);
    EXPECT_EQ(operations[1].groups[1], 4u);
    EXPECT_EQ(operations[1].buffers[0].binding, 2u);
    EXPECT_EQ(operations[2].copySource.index, input.index);
}

TEST_F(RecordingBackendTest, drawingToAnUndeclaredTargetIsAViolation)
{
    const ResourceId host = graph.importTexture(texture("host"), 1);
    undeclared([host](Backend& backend) { backend.draw({.program = &kProgram, .targets = {&host, 1}}); });
    const RecordingBackend backend = run();
    ASSERT_EQ(backend.violations().size(), 1u);
    EXPECT_EQ(backend.violations()[0], "sloppy writes without declaring it 'host'");
}

TEST_F(RecordingBackendTest, samplingAnUndeclaredTextureIsAViolation)
{
    const ResourceId host = graph.importTexture(texture("host"), 1);
    undeclared([host](Backend& backend) {
        const std::array textures = {TextureBinding{0, host}};
        backend.dispatch({.program = &kCompute, .textures = textures});
    });
    const RecordingBackend backend = run();
    ASSERT_EQ(backend.violations().size(), 1u);
    EXPECT_EQ(backend.violations()[0], "sloppy reads without declaring it 'host'");
}

TEST_F(RecordingBackendTest, samplingWhatIsDrawnToIsAViolation)
{
    const ResourceId host = graph.importTexture(texture("host"), 1);
    ResourceId target;
    addPass(
        graph, "feedback",
        [&](FrameGraph::Builder& builder) {
            builder.read(host);
            target = builder.write(host);
        },
        [host, &target](Backend& backend) {
            const std::array textures = {TextureBinding{0, host}};
            backend.draw({.program = &kProgram, .targets = {&target, 1}, .textures = textures});
        });
    graph.keep(target);
    const RecordingBackend backend = run();
    ASSERT_EQ(backend.violations().size(), 1u);
    EXPECT_NE(backend.violations()[0].find("samples what it draws to"), std::string::npos);
}

TEST_F(RecordingBackendTest, unequalTargetsAndMissingProgramsAreViolations)
{
    std::array<ResourceId, 2> targets;
    addPass(
        graph, "draw",
        [&](FrameGraph::Builder& builder) {
            targets[0] = builder.write(builder.create(texture("large", 64)));
            targets[1] = builder.write(builder.create(texture("small", 32)));
        },
        [&targets](Backend& backend) { backend.draw({.targets = targets}); });
    graph.keep(targets[0]);
    const RecordingBackend backend = run();
    ASSERT_EQ(backend.violations().size(), 2u);
    EXPECT_NE(backend.violations()[0].find("without a program"), std::string::npos);
    EXPECT_NE(backend.violations()[1].find("unequal size: 'small'"), std::string::npos);
}

TEST_F(RecordingBackendTest, anUploadThatDoesNotFitIsAViolation)
{
    ResourceId buffer;
    addPass(
        graph, "upload",
        [&](FrameGraph::Builder& builder) {
            buffer = builder.write(builder.create(BufferDesc{"buffer", 15}));
        },
        [&buffer](Backend& backend) { backend.upload(buffer, asUniforms(Block{})); });
    graph.keep(buffer);
    const RecordingBackend backend = run();
    ASSERT_EQ(backend.violations().size(), 1u);
    EXPECT_NE(backend.violations()[0].find("more than fits"), std::string::npos);
}

} // namespace fx::render
