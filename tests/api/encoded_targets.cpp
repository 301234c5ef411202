#include "tests/api/encoded_targets.h"

#include "shaders/formulas/formula.h"

#include <algorithm>

namespace fx::test {

EncodedTargetTest::EncodedTargetTest()
{
    staging_ = textures_.make2D(GL_RGBA32F, kSize);
    stagingFramebuffer_ = textures_.makeFramebuffer(staging_);
    useSettings(true);
}

EncodedTargetTest::~EncodedTargetTest()
{
    textures_.gl.DeleteRenderbuffers(GLsizei(renderbuffers_.size()), renderbuffers_.data());
}

std::vector<EncodedTarget> EncodedTargetTest::targetsOf(GLenum format)
{
    const GLuint one = textures_.make2D(format, kSize), two = textures_.make2D(format, kSize);
    const auto several = [&] { return textures_.make(GL_TEXTURE_2D_MULTISAMPLE, format, kSize, kSize); };
    const GLuint samples = several();
    return {{"texture", one, textures_.makeFramebuffer(one)},
            {"framebuffer", 0, textures_.makeFramebuffer(two)},
            {"renderbuffer", 0, textures_.makeRenderbufferTarget(format, kSize)},
            {"texture, 4 samples", samples, textures_.makeFramebuffer(samples)},
            {"framebuffer, 4 samples", 0, textures_.makeFramebuffer(several())}};
}

std::vector<EncodedDepth> EncodedTargetTest::depthsOf(int samples)
{
    auto& gl = textures_.gl;
    const auto texture = [&](GLenum format, GLenum attachment, bool isAttached) {
        const GLuint name = isAttached && samples > 1
                                ? textures_.make(GL_TEXTURE_2D_MULTISAMPLE, format, kSize, kSize)
                                : textures_.make2D(format, kSize);
        buildWall(name, attachment);
        return name;
    };
    const auto renderbuffer = [&](GLenum format) {
        GLuint name = 0;
        gl.CreateRenderbuffers(1, &name);
        renderbuffers_.push_back(name);
        gl.NamedRenderbufferStorageMultisample(name, samples > 1 ? samples : 0, format, kSize, kSize);
        return name;
    };
    const GLuint severalSamples =
        textures_.make(GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT32F, kSize, kSize);
    buildWall(severalSamples, GL_DEPTH_ATTACHMENT);
    constexpr GLenum kDepth = GL_DEPTH_ATTACHMENT, kBoth = GL_DEPTH_STENCIL_ATTACHMENT;
    return {{"no depth", 0, 0, false, kDepth, 0},
            {"DEPTH_COMPONENT32F texture", texture(GL_DEPTH_COMPONENT32F, kDepth, false)},
            {"DEPTH_COMPONENT32F texture, 4 samples", severalSamples},
            {"attached DEPTH_COMPONENT24 texture", texture(GL_DEPTH_COMPONENT24, kDepth, true), 0, true,
             kDepth, GL_DEPTH_COMPONENT24},
            {"attached DEPTH24_STENCIL8 texture", texture(GL_DEPTH24_STENCIL8, kBoth, true), 0, true, kBoth,
             GL_DEPTH_COMPONENT24},
            {"DEPTH24_STENCIL8 renderbuffer", 0, renderbuffer(GL_DEPTH24_STENCIL8), true, kBoth,
             GL_DEPTH_COMPONENT24},
            {"DEPTH_COMPONENT16 renderbuffer", 0, renderbuffer(GL_DEPTH_COMPONENT16), true, kDepth,
             GL_DEPTH_COMPONENT16}};
}

void EncodedTargetTest::attach(const EncodedTarget& target, const EncodedDepth& depth)
{
    auto& gl = textures_.gl;
    gl.NamedFramebufferTexture(target.framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, 0, 0);
    if (!depth.fromFramebuffer)
        return;
    if (depth.renderbuffer == 0) {
        gl.NamedFramebufferTexture(target.framebuffer, depth.attachment, depth.texture, 0);
        return;
    }
    gl.NamedFramebufferRenderbuffer(target.framebuffer, depth.attachment, GL_RENDERBUFFER,
                                    depth.renderbuffer);
    const float far = 1.0f, wall = depthAt(3.0);
    gl.ClearNamedFramebufferfv(target.framebuffer, GL_DEPTH, 0, &far);
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(kSize / 2, 0, kSize / 2, kSize);
    gl.ClearNamedFramebufferfv(target.framebuffer, GL_DEPTH, 0, &wall);
    gl.Disable(GL_SCISSOR_TEST);
}

void EncodedTargetTest::store(const EncodedTarget& target, const std::vector<float>& codes)
{
    write(staging_, codes);
    textures_.gl.BlitNamedFramebuffer(stagingFramebuffer_, target.framebuffer, 0, 0, kSize, kSize, 0, 0,
                                      kSize, kSize, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

std::vector<float> EncodedTargetTest::stored(const EncodedTarget& target)
{
    textures_.gl.BlitNamedFramebuffer(target.framebuffer, stagingFramebuffer_, 0, 0, kSize, kSize, 0, 0,
                                      kSize, kSize, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return read(staging_);
}

FxFrameDef EncodedTargetTest::frameOf(const EncodedTarget& target, const EncodedDepth& depth,
                                      uint32_t encoding)
{
    FxFrameDef def = frame();
    def.target = target.texture != 0 ? FX_TARGET_TEXTURE : FX_TARGET_FRAMEBUFFER;
    def.colorTexture = target.texture;
    def.framebuffer = target.framebuffer;
    def.depthTexture = depth.fromFramebuffer ? 0 : depth.texture;
    def.depthFromFramebuffer = depth.fromFramebuffer ? 1 : 0;
    def.targetEncoding = encoding;
    def.displayWhite = 8.0f; // that of effects: codes are those of a linear picture
    return def;
}

bool EncodedTargetTest::Media::touches(size_t pixel) const
{
    for (size_t c = 0; c < 4; ++c)
        if (light[4 * pixel + c] != 0.0f || share[4 * pixel + c] != 1.0f)
            return true;
    return false;
}

EncodedTargetTest::Media EncodedTargetTest::media(GLenum precision)
{
    const bool hasWall = precision != 0;
    const GLuint depth = hasWall ? textures_.make2D(precision, kSize) : 0;
    FxFrameDef def = frame();
    def.depthTexture = depth;
    if (hasWall)
        buildWall(depth, GL_DEPTH_ATTACHMENT);
    const size_t values = size_t(kSize * kSize * 4);
    Media media{reference(def, std::vector<float>(values, 0.0f)),
                reference(def, std::vector<float>(values, 1.0f))};
    for (size_t i = 0; i < values; ++i)
        media.share[i] -= media.light[i];
    return media;
}

std::vector<double> EncodedTargetTest::byHand(const Media& media, const std::vector<float>& codes,
                                              uint32_t encoding, bool isSrgbFormat, double white) const
{
    namespace f = formula64;
    const bool isDisplay = encoding != FX_TARGET_LINEAR;
    const auto decoded = [&](double code) {
        if (!isDisplay)
            return isSrgbFormat ? srgbDecoded(code) : code;
        const double y = encoding == FX_TARGET_DISPLAY_SRGB ? f::fxSrgbDecode(code) : f::fxGammaDecode(code);
        return f::fxToneCurveInverse(y, white);
    };
    const auto encoded = [&](double light) {
        if (!isDisplay)
            return isSrgbFormat ? srgbEncoded(std::clamp(light, 0.0, 1.0)) : light;
        const double y = f::fxToneCurve(light, white);
        return encoding == FX_TARGET_DISPLAY_SRGB ? f::fxSrgbEncode(y) : f::fxGammaEncode(y);
    };
    std::vector<double> out(codes.size());
    for (size_t i = 0; i < codes.size(); i += 4) {
        const float* light = &media.light[i];
        double limited[3], mean = 0.0; // as tone mapping limits light before the crosstalk
        for (size_t c = 0; c < 3; ++c) {
            limited[c] = std::min(double(light[c]), white);
            mean += limited[c] / 3.0;
        }
        const double peak = std::max({limited[0], limited[1], limited[2]});
        const double mix = isDisplay ? f::fxFilmCrosstalk(peak, white) : 0.0;
        for (size_t c = 0; c < 3; ++c)
            out[i + c] = encoded(double(light[c]) + mix * (mean - limited[c]) +
                                 double(media.share[i + c]) * decoded(double(codes[i + c])));
        out[i + 3] = double(light[3]) + double(media.share[i + 3]) * double(codes[i + 3]);
    }
    return out;
}

} // namespace fx::test
