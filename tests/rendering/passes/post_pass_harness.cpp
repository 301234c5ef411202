#include "tests/rendering/passes/post_pass_harness.h"

#include "rendering/gl/gl_read_texture.h"

#include <algorithm>
#include <bit>

namespace fx::test {

using namespace render;

std::unique_ptr<GlContext> PostPass::context_;
std::unique_ptr<GlDevice> PostPass::device_;

Picture::Picture(int w, int h, std::array<float, 4> value)
    : width(w), height(h), texels(size_t(w) * size_t(h) * value.size())
{
    for (size_t i = 0; i < texels.size(); ++i)
        texels[i] = value[i % value.size()];
}

size_t differentBits(std::span<const float> a, std::span<const float> b)
{
    size_t count = a.size() == b.size() ? 0 : 1;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        count += std::bit_cast<uint32_t>(a[i]) != std::bit_cast<uint32_t>(b[i]) ? 1 : 0;
    return count;
}

void PostPass::SetUpTestSuite()
{
    GlContextOptions options;
    options.debug = true;
    auto context = createEglContext(options);
    ASSERT_TRUE(context.ok()) << context.status().message();
    context_ = std::move(*context);
    auto device = GlDevice::create(context_->loader(), std::pmr::new_delete_resource());
    ASSERT_TRUE(device.ok()) << device.status().message();
    device_ = std::move(*device);
}

void PostPass::TearDownTestSuite()
{
    device_.reset();
    context_.reset();
}

void PostPass::SetUp()
{
    ASSERT_TRUE(device_);
    messages_ = std::make_unique<GlMessages>(*device_);
    graph_ = std::make_unique<FrameGraph>(memory_);
    backend_ = std::make_unique<GlBackend>(*device_, memory_);
    graph_->begin();
}

void PostPass::TearDown()
{
    EXPECT_EQ(messages_->serious(), 0u) << messages_->first();
    backend_.reset();
    textures_.clear();
    buffers_.clear();
    messages_.reset();
}

ResourceId PostPass::importTexels(int width, int height, Format format, std::span<const float> texels)
{
    auto texture = GlTexture::create(*device_, width, height, glInternalFormat(format), "test input");
    EXPECT_TRUE(texture.ok()) << texture.status().message();
    textures_.push_back(std::move(*texture));
    const GLenum layout = format == Format::R32F ? GL_RED : format == Format::RG32F ? GL_RG : GL_RGBA;
    device_->gl.TextureSubImage2D(textures_.back().name(), 0, 0, 0, width, height, layout, GL_FLOAT,
                                  texels.data());
    return graph_->importTexture(TextureDesc{"test input", width, height, format}, textures_.back().name());
}

ResourceId PostPass::import(const Picture& picture)
{
    return importTexels(picture.width, picture.height, Format::RGBA32F, picture.texels);
}

ResourceId PostPass::importScalar(int width, int height, std::span<const float> texels)
{
    return importTexels(width, height, Format::R32F, texels);
}

ResourceId PostPass::importBytes(std::span<const std::byte> bytes)
{
    auto buffer = GlBuffer::create(*device_, bytes.size(), "test buffer");
    EXPECT_TRUE(buffer.ok()) << buffer.status().message();
    buffers_.push_back(std::move(*buffer));
    device_->gl.NamedBufferSubData(buffers_.back().name(), 0, GLsizeiptr(bytes.size()), bytes.data());
    return graph_->importBuffer(BufferDesc{"test buffer", bytes.size()}, buffers_.back().name());
}

void PostPass::execute(ResourceId kept)
{
    graph_->keep(kept);
    graph_->compile();
    base::Status status = backend_->beginFrame(*graph_);
    if (status.ok())
        graph_->execute(*backend_);
    status = backend_->endFrame();
    ASSERT_TRUE(status.ok()) << status.message();
}

std::vector<float> PostPass::read(ResourceId texture, int channels)
{
    const FrameGraph::Resource& resource = graph_->resource(texture);
    return readTexture(*device_, backend_->textureName(texture), resource.width, resource.height, channels);
}

} // namespace fx::test
