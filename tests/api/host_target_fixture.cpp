#include "tests/api/host_target_fixture.h"

#include <algorithm>
#include <cmath>

namespace fx::test {

namespace {

using Kind = ColorFormat::Kind;
constexpr double kNone = 0.0;

constexpr double codes(int bits)
{
    return 1.0 / double((1 << bits) - 1);
}

} // namespace

#define FX_FORMAT(name) GL_##name, "GL_" #name
const std::vector<ColorFormat> kColorFormats = {
    {FX_FORMAT(RGBA32F), Kind::Float, 0x1p-23, 0x1p-23},
    {FX_FORMAT(RGBA16F), Kind::Float, 0x1p-10, 0x1p-10},
    {FX_FORMAT(R11F_G11F_B10F), Kind::Float, 0x1p-5, kNone},
    {FX_FORMAT(RGB16F), Kind::Float, 0x1p-10, kNone},
    {FX_FORMAT(RGB32F), Kind::Float, 0x1p-23, kNone},
    {FX_FORMAT(RGBA16), Kind::Unorm, codes(16), codes(16)},
    {FX_FORMAT(RGBA12), Kind::Unorm, codes(12), codes(12)},
    {FX_FORMAT(RGB10_A2), Kind::Unorm, codes(10), codes(2)},
    {FX_FORMAT(RGBA8), Kind::Unorm, codes(8), codes(8)},
    {FX_FORMAT(RGB8), Kind::Unorm, codes(8), kNone},
    {FX_FORMAT(RGB16), Kind::Unorm, codes(16), kNone},
    {FX_FORMAT(RGB565), Kind::Unorm, codes(5), kNone},
    {FX_FORMAT(RGB5_A1), Kind::Unorm, codes(5), codes(1)},
    {FX_FORMAT(RGBA4), Kind::Unorm, codes(4), codes(4)},
    {FX_FORMAT(SRGB8_ALPHA8), Kind::Srgb, codes(8), codes(8)},
    {FX_FORMAT(SRGB8), Kind::Srgb, codes(8), kNone},
    {FX_FORMAT(RGBA8_SNORM), Kind::Snorm, codes(7), codes(7)},
    {FX_FORMAT(RGBA16_SNORM), Kind::Snorm, codes(15), codes(15)},
    {FX_FORMAT(RGB9_E5), Kind::Float, 0x1p-8, kNone},
    {FX_FORMAT(R8), Kind::Refused, 0, 0},
    {FX_FORMAT(R16F), Kind::Refused, 0, 0},
    {FX_FORMAT(R32F), Kind::Refused, 0, 0},
    {FX_FORMAT(RG8), Kind::Refused, 0, 0},
    {FX_FORMAT(RG16F), Kind::Refused, 0, 0},
    {FX_FORMAT(RG32F), Kind::Refused, 0, 0},
    {FX_FORMAT(RGBA8UI), Kind::Refused, 0, 0},
    {FX_FORMAT(RGBA8I), Kind::Refused, 0, 0},
    {FX_FORMAT(RGBA16UI), Kind::Refused, 0, 0},
    {FX_FORMAT(RGBA32I), Kind::Refused, 0, 0},
    {FX_FORMAT(RGB10_A2UI), Kind::Refused, 0, 0},
    {FX_FORMAT(R32UI), Kind::Refused, 0, 0},
    {FX_FORMAT(DEPTH_COMPONENT16), Kind::Refused, 0, 0},
    {FX_FORMAT(DEPTH_COMPONENT32F), Kind::Refused, 0, 0},
    {FX_FORMAT(DEPTH24_STENCIL8), Kind::Refused, 0, 0},
    {FX_FORMAT(STENCIL_INDEX8), Kind::Refused, 0, 0},
    {FX_FORMAT(COMPRESSED_RGBA_BPTC_UNORM), Kind::Refused, 0, 0},
    {FX_FORMAT(COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT), Kind::Refused, 0, 0},
    {FX_FORMAT(COMPRESSED_SRGB8_ALPHA8_ETC2_EAC), Kind::Refused, 0, 0},
};
#undef FX_FORMAT

double srgbDecoded(double code)
{
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double srgbEncoded(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

HostTargetTest::HostTargetTest() : textures_(gl_->loader())
{
    update(60);
    useSettings(true);
}

void HostTargetTest::useSettings(bool inPlace, bool toneMap)
{
    isBlended_ = inPlace;
    FxViewSettings settings = fxDefaultViewSettings();
    settings.toneMap = toneMap ? 1 : 0;
    if (inPlace) {
        settings.dazzle = 0;
        settings.shimmerStrength = 0;
    }
    ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
}

Outcome HostTargetTest::render(const FxFrameDef& def)
{
    FxFrameDef fresh = def;
    fresh.resetHistory = 1; // glare begins in each frame as in the one that it is compared with
    const FxResult result = fxView_Render(view_, &fresh);
    if (result == FX_OK)
        return {result, {}};
    const std::string message = fxGetLastErrorMessage();
    return {result, message.substr(message.find(' ') + 1)}; // behind the function's name
}

std::vector<float> HostTargetTest::gradient() const
{
    std::vector<float> rgba;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const float at = float(4 * x + y % 4) / 255.0f;
            rgba.insert(rgba.end(), {at, 1.0f - at, float(y) / 63.0f, float((x + y) % 4) / 3.0f});
        }
    }
    return rgba;
}

void HostTargetTest::write(GLuint texture, const std::vector<float>& rgba)
{
    textures_.gl.TextureSubImage2D(texture, 0, 0, 0, kSize, kSize, GL_RGBA, GL_FLOAT, rgba.data());
}

std::vector<float> HostTargetTest::read(GLuint texture)
{
    return render::readTexture(*host_, texture, kSize, kSize, 4);
}

std::vector<float> HostTargetTest::lightOf(const ColorFormat& format, std::vector<float> stored)
{
    for (size_t i = 0; i < stored.size(); ++i)
        if (format.kind == ColorFormat::Kind::Srgb && i % 4 != 3)
            stored[i] = float(srgbDecoded(double(stored[i])));
    return stored;
}

std::vector<float> HostTargetTest::reference(FxFrameDef def, const std::vector<float>& light)
{
    const GLuint texture = textures_.make2D(GL_RGBA32F, kSize);
    write(texture, light);
    def.target = FX_TARGET_TEXTURE;
    def.colorTexture = texture;
    const Outcome outcome = render(def);
    EXPECT_EQ(outcome.result, FX_OK) << outcome.words;
    return read(texture);
}

std::string HostTargetTest::faultOf(const ColorFormat& format, const std::vector<float>& stored,
                                    const std::vector<float>& expected) const
{
    for (size_t i = 0; i < stored.size(); ++i) {
        const bool isAlpha = i % 4 == 3;
        const double step = isAlpha ? format.alphaStep : format.step;
        if (step == 0.0)
            continue;
        double wanted = double(expected[i]);
        // Blending may round the light, the opacity and the result to the format, each by a step: of the
        // opacity, below 1, that is at most 2^-11 of the light behind.
        const bool isRounded = isBlended_ && step > 0x1p-23;
        double allowed = std::abs(wanted) * step * (isRounded ? 2.0 : 1.0) + (isRounded ? 0x1p-11 : 1e-5);
        if (format.kind != ColorFormat::Kind::Float) {
            wanted = std::clamp(wanted, 0.0, 1.0);
            if (format.kind == ColorFormat::Kind::Srgb && !isAlpha)
                wanted = srgbEncoded(wanted);
            allowed =
                1.5 * step; // fixed-function blending may round what it blends, and what comes out of it
        }
        if (format.kind == ColorFormat::Kind::Srgb)
            allowed = isBlended_ ? 2.75 * step : step; // NVIDIA blends with what it has decoded to few bits
        if (!(std::abs(double(stored[i]) - wanted) <= allowed))
            return "value " + std::to_string(i % 4) + " of pixel " + std::to_string(i / 4 % size_t(kSize)) +
                   ", " + std::to_string(i / 4 / size_t(kSize)) + " is " + std::to_string(stored[i]) +
                   ", not " + std::to_string(wanted) + ", step " + std::to_string(step);
    }
    return {};
}

float HostTargetTest::depthAt(double distance)
{
    const double nearPlane = 0.1, farPlane = 100.0; // of frame()
    const double clip =
        ((farPlane + nearPlane) * distance - 2 * farPlane * nearPlane) / ((farPlane - nearPlane) * distance);
    return float(0.5 * clip + 0.5);
}

void HostTargetTest::buildWall(GLuint depth, GLenum attachment)
{
    const GLuint framebuffer = textures_.makeFramebuffer(0);
    textures_.gl.NamedFramebufferTexture(framebuffer, attachment, depth, 0);
    const float far = 1.0f, wall = depthAt(3.0);
    textures_.gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far);
    textures_.gl.Enable(GL_SCISSOR_TEST);
    textures_.gl.Scissor(kSize / 2, 0, kSize / 2, kSize);
    textures_.gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &wall);
    textures_.gl.Disable(GL_SCISSOR_TEST);
}

} // namespace fx::test
