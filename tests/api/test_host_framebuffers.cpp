// Framebuffers of the host: which attachment is drawn to, how, and what becomes of the others.
#include "tests/api/host_target_fixture.h"

#include <algorithm>
#include <cmath>

using HostFramebuffers = fx::test::HostTargetTest;
using fx::test::ColorFormat;
using fx::test::Outcome;

namespace {

constexpr ColorFormat kLight = {GL_RGBA32F, "GL_RGBA32F", ColorFormat::Kind::Float, 1e-6, 1e-6};
constexpr ColorFormat kSrgb = {GL_SRGB8_ALPHA8, "GL_SRGB8_ALPHA8", ColorFormat::Kind::Srgb, 1.0 / 255,
                               1.0 / 255};

FxFrameDef into(GLuint framebuffer, FxFrameDef def, GLuint color = 0)
{
    def.target = FX_TARGET_FRAMEBUFFER;
    def.framebuffer = framebuffer;
    def.colorTexture = color;
    return def;
}

} // namespace

TEST_F(HostFramebuffers, anSrgbAttachmentIsEncodedWhateverTheHostsSwitchSays)
{
    for (const bool isOn : {false, true}) {
        isOn ? textures_.gl.Enable(GL_FRAMEBUFFER_SRGB) : textures_.gl.Disable(GL_FRAMEBUFFER_SRGB);
        const GLuint texture = textures_.make2D(GL_SRGB8_ALPHA8, kSize);
        write(texture, gradient());
        const std::vector<float> light = lightOf(kSrgb, read(texture));
        const Outcome blended = render(into(textures_.makeFramebuffer(texture), frame()));
        ASSERT_EQ(blended.result, FX_OK) << blended.words;
        EXPECT_EQ(faultOf(kSrgb, read(texture), reference(frame(), light)), "") << isOn;
        EXPECT_EQ(textures_.gl.IsEnabled(GL_FRAMEBUFFER_SRGB), isOn ? GL_TRUE : GL_FALSE);
    }
    textures_.gl.Disable(GL_FRAMEBUFFER_SRGB);
}

TEST_F(HostFramebuffers, aPictureFromATextureComesOutWholeInEveryFormatOfTheFramebuffer)
{
    for (const bool inPlace : {true, false}) {
        useSettings(inPlace);
        for (const ColorFormat& format : fx::test::kColorFormats) {
            if (format.kind == ColorFormat::Kind::Refused || format.format == GL_RGB9_E5)
                continue;
            const GLuint source = textures_.make2D(GL_RGBA16F, kSize);
            write(source, gradient());
            const GLuint target = textures_.make2D(format.format, kSize);
            const Outcome outcome = render(into(textures_.makeFramebuffer(target), frame(), source));
            if (outcome.result == FX_OK) {
                EXPECT_EQ(faultOf(format, read(target), reference(frame(), read(source))), "") << format.name;
            }
        }
    }
}

TEST_F(HostFramebuffers, aPictureIsReadFromFormatsThatCannotBeDrawnTo)
{
    const GLuint source = textures_.make2D(GL_RGB9_E5, kSize);
    textures_.gl.TextureSubImage2D(source, 0, 0, 0, kSize, kSize, GL_RGBA, GL_FLOAT, gradient().data());
    const GLuint target = textures_.make2D(GL_RGBA32F, kSize);
    const Outcome outcome = render(into(textures_.makeFramebuffer(target), frame(), source));
    ASSERT_EQ(outcome.result, FX_OK) << outcome.words;
    EXPECT_EQ(faultOf(kLight, read(target), reference(frame(), read(source))), "");
}

TEST_F(HostFramebuffers, attachmentsBesideTheFirstDrawBufferKeepTheirBits)
{
    const GLuint color = textures_.make2D(GL_RGBA32F, kSize), normals = textures_.make2D(GL_RGBA16F, kSize),
                 ids = textures_.make2D(GL_R32UI, kSize);
    write(color, gradient());
    write(normals, gradient());
    const std::vector<float> light = read(color), before = read(normals);
    const GLuint framebuffer = textures_.makeFramebuffer(color);
    textures_.gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT1, normals, 0);
    textures_.gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT2, ids, 0);
    const GLenum buffers[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
    textures_.gl.NamedFramebufferDrawBuffers(framebuffer, 3, buffers);
    const uint32_t id = 7;
    textures_.gl.ClearNamedFramebufferuiv(framebuffer, GL_COLOR, 2, &id);
    for (const bool inPlace : {true, false}) {
        useSettings(inPlace);
        const Outcome outcome = render(into(framebuffer, frame()));
        ASSERT_EQ(outcome.result, FX_OK) << outcome.words;
        EXPECT_EQ(read(normals), before);
        for (const uint32_t stored : fx::render::readUintTexture(*host_, ids, kSize, kSize))
            ASSERT_EQ(stored, id);
    }
    EXPECT_NE(read(color), light);
}

TEST_F(HostFramebuffers, drawBufferZeroSaysWhichAttachmentIsDrawnTo)
{
    const GLuint first = textures_.make2D(GL_RGBA32F, kSize), second = textures_.make2D(GL_RGBA32F, kSize);
    write(first, gradient());
    write(second, gradient());
    const std::vector<float> before = read(first);
    const GLuint framebuffer = textures_.makeFramebuffer(first);
    textures_.gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT1, second, 0);
    textures_.gl.NamedFramebufferDrawBuffer(framebuffer, GL_COLOR_ATTACHMENT1);
    ASSERT_EQ(render(into(framebuffer, frame())).result, FX_OK);
    EXPECT_EQ(read(first), before);
    EXPECT_EQ(faultOf(kLight, read(second), reference(frame(), before)), "");
}

TEST_F(HostFramebuffers, theBoundFramebufferIsTheHostsAfterwardsAlsoWhenTheFrameIsRefused)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.saveState = 0;
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK);
    const GLuint bound = textures_.makeFramebuffer(color_.name());
    const GLuint shut = textures_.makeFramebuffer(textures_.make2D(GL_RGBA16F, kSize));
    textures_.gl.NamedFramebufferDrawBuffer(shut, GL_NONE);
    textures_.gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, bound);
    EXPECT_EQ(render(into(shut, frame())).result, FX_ERROR_INVALID_ARGUMENT);
    GLint after = 0;
    textures_.gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &after);
    EXPECT_EQ(GLuint(after), bound);
    textures_.gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
}

TEST_F(HostFramebuffers, depthAttachedToTheFramebufferItselfHides)
{
    const GLuint color = textures_.make2D(GL_RGBA32F, kSize),
                 depth = textures_.make2D(GL_DEPTH_COMPONENT24, kSize);
    buildWall(depth, GL_DEPTH_ATTACHMENT);
    write(color, gradient());
    const GLuint framebuffer = textures_.makeFramebuffer(color);
    textures_.gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
    FxFrameDef def = frame();
    def.depthTexture = depth;
    const std::vector<float> light = read(color);
    const std::vector<float> stored = fx::render::readDepthTexture(*host_, depth, kSize, kSize);
    ASSERT_EQ(render(into(framebuffer, def)).result, FX_OK);
    EXPECT_EQ(faultOf(kLight, read(color), reference(def, light)), "");
    EXPECT_EQ(fx::render::readDepthTexture(*host_, depth, kSize, kSize), stored);
}
