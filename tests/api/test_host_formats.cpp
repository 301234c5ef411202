// Every target of every format is drawn rightly or refused in words, and the documents say which.
#include "tests/api/host_target_fixture.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace {

using fx::test::ColorFormat;
using fx::test::kColorFormats;
using fx::test::Outcome;

constexpr ColorFormat kLight = {GL_RGBA32F, "GL_RGBA32F", ColorFormat::Kind::Float, 1e-6, 1e-6};

class HostFormats : public fx::test::HostTargetTest
{
protected:
    void add(const char* member, const std::string& given, const std::string& result)
    {
        table_ << "| `" << member << "` | " << given << " | " << result << " |\n";
    }
    static std::string resultOf(const Outcome& outcome)
    {
        return outcome.result == FX_OK ? "right" : "refused: " + outcome.words;
    }
    FxFrameDef colorFrame(GLuint color) const
    {
        FxFrameDef def = frame();
        def.colorTexture = color;
        return def;
    }
    FxFrameDef depthFrame(GLuint depth) const
    {
        FxFrameDef def = frame();
        def.depthTexture = depth;
        return def;
    }
    FxFrameDef framebufferFrame(GLuint framebuffer, GLuint color = 0) const
    {
        FxFrameDef def = colorFrame(color);
        def.target = FX_TARGET_FRAMEBUFFER;
        def.framebuffer = framebuffer;
        return def;
    }

    /// Draws `def` into `target` of a format, which holds a gradient, and compares the picture.
    Outcome draw(const ColorFormat& format, GLuint target, const FxFrameDef& def)
    {
        if (format.kind != ColorFormat::Kind::Refused)
            write(target, gradient());
        const bool isReadable = format.kind != ColorFormat::Kind::Refused;
        const std::vector<float> before = isReadable ? read(target) : std::vector<float>();
        const Outcome outcome = render(def);
        if (outcome.result != FX_OK) {
            EXPECT_EQ(outcome.result, FX_ERROR_INVALID_ARGUMENT) << outcome.words;
            EXPECT_EQ(outcome.words.find("OpenGL error"), std::string::npos) << outcome.words;
            EXPECT_TRUE(!isReadable || read(target) == before) << format.name << " was drawn to";
        } else {
            EXPECT_TRUE(isReadable) << format.name << " was not refused";
            if (isReadable) {
                EXPECT_EQ(faultOf(format, read(target), reference(frame(), lightOf(format, before))), "")
                    << format.name;
            }
        }
        return outcome;
    }

    void addColorFormats();
    void addColorTextures();
    void addDepthFormats();
    void addDepthTextures();
    void addFramebuffers();
    void addUnread(const char* given, GLuint framebuffer);
    void addDepth(const std::string& given, GLuint depth, bool isWall = true);

    std::ostringstream table_;
};

void HostFormats::addColorFormats()
{
    for (const ColorFormat& format : kColorFormats) {
        const GLuint texture = textures_.make2D(format.format, kSize);
        useSettings(true);
        const Outcome inPlace = draw(format, texture, colorFrame(texture));
        useSettings(false);
        const Outcome presented = draw(format, texture, colorFrame(texture));
        EXPECT_EQ(inPlace.words, presented.words);
        add("colorTexture", format.name, resultOf(inPlace));
    }
    useSettings(true);
}

void HostFormats::addColorTextures()
{
    const auto addTarget = [this](GLenum target, const char* name) {
        const GLenum format = GL_RGBA16F;
        add("colorTexture", name, resultOf(render(colorFrame(textures_.make(target, format, kSize, kSize)))));
    };
    addTarget(GL_TEXTURE_2D_MULTISAMPLE, "GL_TEXTURE_2D_MULTISAMPLE");
    addTarget(GL_TEXTURE_2D_MULTISAMPLE_ARRAY, "GL_TEXTURE_2D_MULTISAMPLE_ARRAY");
    addTarget(GL_TEXTURE_2D_ARRAY, "GL_TEXTURE_2D_ARRAY");
    addTarget(GL_TEXTURE_RECTANGLE, "GL_TEXTURE_RECTANGLE");
    addTarget(GL_TEXTURE_CUBE_MAP, "GL_TEXTURE_CUBE_MAP");
    addTarget(GL_TEXTURE_CUBE_MAP_ARRAY, "GL_TEXTURE_CUBE_MAP_ARRAY");
    addTarget(GL_TEXTURE_BUFFER, "GL_TEXTURE_BUFFER");
    addTarget(GL_TEXTURE_1D, "GL_TEXTURE_1D");
    addTarget(GL_TEXTURE_1D_ARRAY, "GL_TEXTURE_1D_ARRAY");
    addTarget(GL_TEXTURE_3D, "GL_TEXTURE_3D");

    const auto addDrawn = [this](const char* given, GLuint texture) {
        add("colorTexture", given, resultOf(draw(kLight, texture, colorFrame(texture))));
    };
    auto& gl = textures_.gl;
    const GLuint array = textures_.make(GL_TEXTURE_2D_ARRAY, GL_RGBA32F, kSize, kSize);
    addDrawn("view of one layer of an array", textures_.makeView(array, GL_RGBA32F, 0, 1));
    const GLuint chain = textures_.make(GL_TEXTURE_2D, GL_RGBA32F, 2 * kSize, 2 * kSize, 2);
    addDrawn("view of level 1", textures_.makeView(chain, GL_RGBA32F, 1, 0));
    gl.TextureParameteri(chain, GL_TEXTURE_BASE_LEVEL, 1);
    add("colorTexture", "GL_TEXTURE_BASE_LEVEL is 1", resultOf(render(colorFrame(chain))));
    const GLuint swizzled = textures_.make2D(GL_RGBA32F, kSize);
    gl.TextureParameteri(swizzled, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    add("colorTexture", "GL_TEXTURE_SWIZZLE_R is GL_BLUE", resultOf(render(colorFrame(swizzled))));
    addDrawn("not immutable, no mipmaps, trilinear filter", textures_.makeMutable(GL_RGBA32F, kSize));
    add("colorTexture", "no image", resultOf(render(colorFrame(textures_.makeMutable(GL_RGBA32F, 0)))));
    FxFrameDef wide = colorFrame(textures_.make2D(GL_RGBA32F, kSize));
    wide.width = 2 * kSize;
    add("width", "beyond the texture", resultOf(render(wide)));
    FxFrameDef tall = colorFrame(textures_.make2D(GL_RGBA32F, kSize));
    tall.height = kSize + 1;
    add("height", "beyond the texture", resultOf(render(tall)));
}

/// The wall must hide as much of the flames as it does in the format that holds most.
void HostFormats::addDepth(const std::string& given, GLuint depth, bool isWall)
{
    const std::vector<float> light = gradient();
    const GLuint best = textures_.make2D(GL_DEPTH_COMPONENT32F, kSize);
    if (isWall)
        buildWall(best, GL_DEPTH_ATTACHMENT);
    const std::vector<float> wanted = reference(depthFrame(isWall ? best : 0), light);
    EXPECT_NE(wanted, reference(depthFrame(isWall ? 0 : best), light)); // it hides something
    const GLuint color = textures_.make2D(GL_RGBA32F, kSize);
    write(color, light);
    FxFrameDef def = depthFrame(depth);
    def.colorTexture = color;
    const Outcome outcome = render(def);
    if (outcome.result == FX_OK) {
        const std::vector<float> shown = read(color);
        for (size_t i = 0; i < shown.size(); ++i) // 16 bits of depth are 2 mm at the wall
            ASSERT_NEAR(shown[i], wanted[i], 0.02f * std::max(1.0f, wanted[i])) << given << " value " << i;
    } else {
        EXPECT_EQ(outcome.result, FX_ERROR_INVALID_ARGUMENT) << outcome.words;
        EXPECT_EQ(read(color), light) << given;
    }
    add("depthTexture", given, resultOf(outcome));
}

void HostFormats::addDepthFormats()
{
    struct DepthFormat
    {
        GLenum format;
        const char* name;
        GLenum attachment; ///< 0: color
    };
    const DepthFormat formats[] = {
        {GL_DEPTH_COMPONENT16, "GL_DEPTH_COMPONENT16", GL_DEPTH_ATTACHMENT},
        {GL_DEPTH_COMPONENT24, "GL_DEPTH_COMPONENT24", GL_DEPTH_ATTACHMENT},
        {GL_DEPTH_COMPONENT32, "GL_DEPTH_COMPONENT32", GL_DEPTH_ATTACHMENT},
        {GL_DEPTH_COMPONENT32F, "GL_DEPTH_COMPONENT32F", GL_DEPTH_ATTACHMENT},
        {GL_DEPTH24_STENCIL8, "GL_DEPTH24_STENCIL8", GL_DEPTH_STENCIL_ATTACHMENT},
        {GL_DEPTH32F_STENCIL8, "GL_DEPTH32F_STENCIL8", GL_DEPTH_STENCIL_ATTACHMENT},
        {GL_R32F, "GL_R32F", 0},
        {GL_R16F, "GL_R16F", 0},
        {GL_RGBA32F, "GL_RGBA32F", 0},
        {GL_R32UI, "GL_R32UI", 0},
        {GL_STENCIL_INDEX8, "GL_STENCIL_INDEX8", 0},
    };
    for (const DepthFormat& format : formats) {
        const GLuint depth = textures_.make2D(format.format, kSize);
        if (format.attachment != 0)
            buildWall(depth, format.attachment);
        if (format.format == GL_R32F) {
            const GLuint wall = textures_.make2D(GL_DEPTH_COMPONENT32F, kSize);
            buildWall(wall, GL_DEPTH_ATTACHMENT);
            const std::vector<float> values = fx::render::readDepthTexture(*host_, wall, kSize, kSize);
            textures_.gl.TextureSubImage2D(depth, 0, 0, 0, kSize, kSize, GL_RED, GL_FLOAT, values.data());
        }
        addDepth(format.name, depth);
    }
}

void HostFormats::addDepthTextures()
{
    auto& gl = textures_.gl;
    const auto wall = [this](int size, GLenum format = GL_DEPTH_COMPONENT32F) {
        const GLuint depth = textures_.make2D(format, size);
        buildWall(depth, format == GL_DEPTH24_STENCIL8 ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT);
        return depth;
    };
    const GLuint compared = wall(kSize);
    gl.TextureParameteri(compared, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl.TextureParameteri(compared, GL_TEXTURE_COMPARE_FUNC, GL_GREATER);
    addDepth("GL_TEXTURE_COMPARE_MODE is GL_COMPARE_REF_TO_TEXTURE", compared);
    const GLuint stencil = wall(kSize, GL_DEPTH24_STENCIL8);
    gl.TextureParameteri(stencil, GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX);
    addDepth("GL_DEPTH_STENCIL_TEXTURE_MODE is GL_STENCIL_INDEX", stencil);
    const GLuint swizzled = wall(kSize);
    gl.TextureParameteri(swizzled, GL_TEXTURE_SWIZZLE_R, GL_ONE);
    addDepth("GL_TEXTURE_SWIZZLE_R is GL_ONE", swizzled);
    addDepth("half of the frame's size", wall(kSize / 2));
    addDepth("twice the frame's size", wall(2 * kSize));
    addDepth("larger than the frame by a border", wall(kSize + 8));
    const auto make = [this](GLenum target) {
        return textures_.make(target, GL_DEPTH_COMPONENT24, kSize, kSize);
    };
    const GLuint samples = make(GL_TEXTURE_2D_MULTISAMPLE);
    buildWall(samples, GL_DEPTH_ATTACHMENT);
    addDepth("GL_TEXTURE_2D_MULTISAMPLE", samples);
    addDepth("GL_TEXTURE_2D_ARRAY", make(GL_TEXTURE_2D_ARRAY));
    addDepth("GL_TEXTURE_CUBE_MAP", make(GL_TEXTURE_CUBE_MAP));
    addDepth("GL_TEXTURE_RECTANGLE", make(GL_TEXTURE_RECTANGLE));
    addDepth("0", 0, false);
}

/// Of a framebuffer whose color attachment is no texture that could be read: it is copied into one.
void HostFormats::addUnread(const char* given, GLuint framebuffer)
{
    const auto& gl = textures_.gl;
    const GLuint copy = textures_.make2D(GL_RGBA32F, kSize);
    const GLuint picture = textures_.makeFramebuffer(copy);
    const float gray[4] = {0.25f, 0.25f, 0.25f, 1.0f};
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, gray);
    const Outcome outcome = render(framebufferFrame(framebuffer));
    gl.BlitNamedFramebuffer(framebuffer, picture, 0, 0, kSize, kSize, 0, 0, kSize, kSize, GL_COLOR_BUFFER_BIT,
                            GL_NEAREST);
    std::vector<float> background;
    for (int i = 0; i < kSize * kSize; ++i)
        background.insert(background.end(), gray, gray + 4);
    EXPECT_EQ(faultOf(kLight, read(copy), reference(frame(), background)), "") << given;
    add("framebuffer", given, resultOf(outcome));
}

void HostFormats::addFramebuffers()
{
    auto& gl = textures_.gl;
    for (const ColorFormat& format : kColorFormats) {
        const bool isColor = format.kind != ColorFormat::Kind::Refused;
        if (!isColor && format.format != GL_RGBA8UI && format.format != GL_RG16F && format.format != GL_R16F)
            continue;
        const GLuint texture = textures_.make2D(format.format, kSize);
        const GLuint framebuffer = textures_.makeFramebuffer(texture);
        add("framebuffer", format.name, resultOf(draw(format, texture, framebufferFrame(framebuffer))));
    }
    const GLuint several = textures_.make(GL_TEXTURE_2D_MULTISAMPLE, GL_RGBA32F, kSize, kSize);
    addUnread("four samples", textures_.makeFramebuffer(several));
    addUnread("renderbuffer of GL_RGBA32F", textures_.makeRenderbufferTarget(GL_RGBA32F, kSize));
    const auto addPlain = [this](const char* given, GLuint framebuffer) {
        add("framebuffer", given, resultOf(render(framebufferFrame(framebuffer))));
    };
    const GLuint array = textures_.make(GL_TEXTURE_2D_ARRAY, GL_RGBA32F, kSize, kSize);
    addPlain("layered", textures_.makeFramebuffer(array));
    const GLuint layer = textures_.makeFramebuffer(0);
    gl.NamedFramebufferTextureLayer(layer, GL_COLOR_ATTACHMENT0, array, 0, 1);
    addPlain("one layer of an array", layer);
    addPlain("nothing attached", textures_.makeFramebuffer(0));
    const GLuint shut = textures_.makeFramebuffer(textures_.make2D(GL_RGBA32F, kSize));
    gl.NamedFramebufferDrawBuffer(shut, GL_NONE);
    addPlain("draw buffer is GL_NONE", shut);
    addPlain("smaller than the frame", textures_.makeFramebuffer(textures_.make2D(GL_RGBA32F, kSize / 2)));
    addPlain("renderbuffer of GL_R16F", textures_.makeRenderbufferTarget(GL_R16F, kSize));
    addPlain("renderbuffer smaller than the frame", textures_.makeRenderbufferTarget(GL_RGBA16F, kSize / 2));
    addPlain("0 without a window", 0);
}

std::string documented()
{
    std::ifstream file(std::filesystem::path(FX_SOURCE_DIR) / "docs/howto/host-targets.md");
    std::ostringstream table;
    for (std::string line; std::getline(file, line);)
        if (line.rfind("| `", 0) == 0)
            table << line << "\n";
    return table.str();
}

} // namespace

TEST_F(HostFormats, everyTargetIsDrawnRightlyOrRefusedAndTheDocumentsSayWhich)
{
    addColorFormats();
    addColorTextures();
    addDepthFormats();
    addDepthTextures();
    addFramebuffers();
    const bool isDocumentedDriver = host_->limits().renderer.find("llvmpipe") != std::string::npos;
    if (!isDocumentedDriver)
        GTEST_SKIP() << "docs/howto/host-targets.md is about llvmpipe, this is " << host_->limits().renderer;
    const std::string made = FX_BINARY_DIR "/tests/host_targets.txt";
    std::ofstream(made) << table_.str();
    EXPECT_EQ(documented(), table_.str()) << "the wanted rows are in " << made;
}
