// Depth of several samples: media are drawn once for each pixel, with the depth of one sample.
#include "tests/api/encoded_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace {

/// A wall through the flames, seen at an angle of a few degrees to the pixels, so that its edge crosses many.
constexpr const char* kWall =
    "#version 450 core\n"
    "layout(location = 0) uniform float depth;\n"
    "void main() {\n"
    "    vec2 p = vec2(gl_VertexID == 1 ? 3.0 : 0.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "    if (gl_VertexID == 0) p = vec2(0.2, -1.0);\n"
    "    gl_Position = vec4(p, depth * 2.0 - 1.0, 1.0);\n"
    "}\n";
constexpr const char* kWhole =
    "#version 450 core\n"
    "void main() {\n"
    "    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0);\n"
    "}\n";
constexpr const char* kNothing = "#version 450 core\nvoid main() {}\n";
/// One sample, or the nearest or farthest of all.
constexpr const char* kPick = "#version 450 core\n"
                              "layout(binding = 0) uniform sampler2DMS depths;\n"
                              "layout(location = 0) uniform int which;\n"
                              "void main() {\n"
                              "    ivec2 p = ivec2(gl_FragCoord.xy);\n"
                              "    float d[4];\n"
                              "    for (int i = 0; i < 4; ++i) d[i] = texelFetch(depths, p, i).r;\n"
                              "    float low = min(min(d[0], d[1]), min(d[2], d[3]));\n"
                              "    float high = max(max(d[0], d[1]), max(d[2], d[3]));\n"
                              "    gl_FragDepth = which < 4 ? d[which] : which == 4 ? low : high;\n"
                              "}\n";
constexpr int kNearest = 4;
constexpr int kFarthest = 5;

} // namespace

class SampleDepth : public fx::test::EncodedTargetTest
{
protected:
    SampleDepth() : several_(textures_.make(GL_TEXTURE_2D_MULTISAMPLE, GL_DEPTH_COMPONENT32F, kSize, kSize))
    {
        const float far = 1.0f;
        const GLuint target = textures_.makeFramebuffer(0);
        textures_.gl.NamedFramebufferTexture(target, GL_DEPTH_ATTACHMENT, several_, 0);
        textures_.gl.ClearNamedFramebufferfv(target, GL_DEPTH, 0, &far);
        draw(target, kWall, kNothing, [&] { uniform<PFNGLUNIFORM1FPROC>("glUniform1f")(0, depthAt(3.0)); });
        for (int which = 0; which < 6; ++which) {
            const GLuint one = textures_.make2D(GL_DEPTH_COMPONENT32F, kSize);
            const GLuint picked = textures_.makeFramebuffer(0);
            textures_.gl.NamedFramebufferTexture(picked, GL_DEPTH_ATTACHMENT, one, 0);
            host_->gl.BindTextureUnit(0, several_);
            draw(picked, kWhole, kPick, [&] { uniform<PFNGLUNIFORM1IPROC>("glUniform1i")(0, which); });
            depths_.push_back(one);
        }
        host_->gl.BindTextureUnit(0, 0);
    }

    template <class Function>
    Function uniform(const char* name)
    {
        const fx::render::GlLoader loader = gl_->loader();
        return reinterpret_cast<Function>(loader.getProcAddress(loader.user, name));
    }

    template <class SetUniforms>
    void draw(GLuint framebuffer, const char* vertex, const char* fragment, SetUniforms&& setUniforms)
    {
        const auto& gl = host_->gl;
        const GLuint program = gl.CreateProgram();
        for (const auto& [stage, text] :
             {std::pair{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, fragment}}) {
            const GLuint shader = gl.CreateShader(GLenum(stage));
            gl.ShaderSource(shader, 1, &text, nullptr);
            gl.CompileShader(shader);
            gl.AttachShader(program, shader);
            gl.DeleteShader(shader);
        }
        gl.LinkProgram(program);
        GLuint vertexArray = 0;
        gl.CreateVertexArrays(1, &vertexArray);
        gl.BindVertexArray(vertexArray);
        gl.UseProgram(program);
        setUniforms();
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
        gl.ViewportIndexedf(0, 0, 0, float(kSize), float(kSize));
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(GL_ALWAYS);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
        gl.Disable(GL_DEPTH_TEST);
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
        gl.UseProgram(0);
        gl.BindVertexArray(0);
        gl.DeleteVertexArrays(1, &vertexArray);
        gl.DeleteProgram(program);
    }

    std::vector<float> pictureOf(GLuint depth)
    {
        FxFrameDef def = frame();
        def.depthTexture = depth;
        return reference(def, gradient());
    }

    GLuint several_;
    std::vector<GLuint> depths_; ///< samples 0 to 3, the nearest, the farthest
};

TEST_F(SampleDepth, ofOneSampleIsRightBesideEdgesAndWithinTheTwoSurfacesOnThem)
{
    const std::vector<float> near = pictureOf(depths_[kNearest]), far = pictureOf(depths_[kFarthest]);
    std::vector<float> mean(near.size(), 0.0f); // media drawn for each sample
    for (int sample = 0; sample < 4; ++sample) {
        const std::vector<float> one = pictureOf(depths_[size_t(sample)]);
        for (size_t i = 0; i < mean.size(); ++i)
            mean[i] += 0.25f * one[i];
    }
    const std::vector<float> shown = pictureOf(several_);
    std::vector<double> errors[3];
    for (size_t i = 0; i < mean.size(); ++i) {
        if (near[i] == far[i]) { // no edge
            ASSERT_EQ(shown[i], near[i]) << "value " << i;
            continue;
        }
        EXPECT_TRUE(shown[i] == near[i] || shown[i] == far[i]) << "value " << i;
        if (i % 4 == 3)
            continue;
        const float* const pictures[] = {&shown[i], &near[i], &far[i]};
        for (size_t k = 0; k < 3; ++k)
            errors[k].push_back(std::abs(double(*pictures[k]) - double(mean[i])));
    }
    ASSERT_GT(errors[0].size(), 20u);
    constexpr const char* kNames[] = {"one sample", "nearest sample", "farthest sample"};
    for (size_t k = 0; k < 3; ++k) {
        const double average =
            std::accumulate(errors[k].begin(), errors[k].end(), 0.0) / double(errors[k].size());
        std::printf("%s: mean error at %zu values of edges %.4f, largest %.4f\n", kNames[k], errors[k].size(),
                    average, *std::max_element(errors[k].begin(), errors[k].end()));
    }
    const auto sum = [&](size_t k) { return std::accumulate(errors[k].begin(), errors[k].end(), 0.0); };
    EXPECT_LE(sum(0), 1.05 * std::max(sum(1), sum(2)));
}

TEST_F(SampleDepth, samplesThatNoEffectTouchesKeepTheirBits)
{
    // one sample of each pixel is red, the others are blue
    for (const uint32_t encoding : {FX_TARGET_LINEAR, FX_TARGET_DISPLAY_SRGB})
        for (const bool inPlace : {true, false}) {
            useSettings(inPlace);
            const GLuint color = textures_.make(GL_TEXTURE_2D_MULTISAMPLE, GL_RGBA16F, kSize, kSize);
            const GLuint target = textures_.makeFramebuffer(color);
            const auto fill = [&](GLbitfield mask, const char* shader) {
                textures_.gl.Enable(GL_SAMPLE_MASK);
                uniform<PFNGLSAMPLEMASKIPROC>("glSampleMaski")(0, mask);
                draw(target, kWhole, shader, [] {});
                uniform<PFNGLSAMPLEMASKIPROC>("glSampleMaski")(0, ~0u);
                textures_.gl.Disable(GL_SAMPLE_MASK);
            };
            fill(1u, "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(0.9, 0.1, 0.0, 1.0); }\n");
            fill(14u, "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(0.1, 0.2, 0.8, 1.0); }\n");
            const auto sampleOf = [&](int sample) {
                const GLuint one = textures_.make2D(GL_RGBA32F, kSize);
                const std::string text =
                    "#version 450 core\nlayout(binding = 0) uniform sampler2DMS s;\nout vec4 c;\n"
                    "void main() { c = texelFetch(s, ivec2(gl_FragCoord.xy), " +
                    std::to_string(sample) + "); }\n";
                host_->gl.BindTextureUnit(0, color);
                draw(textures_.makeFramebuffer(one), kWhole, text.c_str(), [] {});
                host_->gl.BindTextureUnit(0, 0);
                return read(one);
            };
            std::vector<std::vector<float>> before;
            for (int sample = 0; sample < 4; ++sample)
                before.push_back(sampleOf(sample));
            ASSERT_NE(before[0], before[1]);
            const Media open = media();
            useSettings(inPlace);
            FxFrameDef def = frame();
            def.depthTexture = 0;
            def.colorTexture = color;
            def.targetEncoding = encoding;
            const fx::test::Outcome outcome = render(def);
            ASSERT_EQ(outcome.result, FX_OK) << outcome.words;
            for (int sample = 0; sample < 4; ++sample) {
                const std::vector<float> after = sampleOf(sample);
                EXPECT_NE(after, before[size_t(sample)]);
                for (size_t i = 0; i < after.size(); ++i)
                    if (!open.touches(i / 4) && inPlace) {
                        ASSERT_EQ(after[i], before[size_t(sample)][i])
                            << "sample " << sample << ", value " << i;
                    }
            }
        }
}
