#include "gl_host_state.h"

#define FX_LOAD(type, name) const auto name = load<PFNGL##type##PROC>("gl" #name)

namespace fx::render {

namespace {

struct Named
{
    GLenum value;
    const char* name;
};
#define FX_NAMED(x)                                                                                          \
    {                                                                                                        \
        GL_##x, "GL_" #x                                                                                     \
    }

constexpr Named kSwitches[] = {FX_NAMED(BLEND),
                               FX_NAMED(CULL_FACE),
                               FX_NAMED(DEPTH_TEST),
                               FX_NAMED(STENCIL_TEST),
                               FX_NAMED(SCISSOR_TEST),
                               FX_NAMED(DEPTH_CLAMP),
                               FX_NAMED(FRAMEBUFFER_SRGB),
                               FX_NAMED(RASTERIZER_DISCARD),
                               FX_NAMED(COLOR_LOGIC_OP),
                               FX_NAMED(DITHER),
                               FX_NAMED(MULTISAMPLE),
                               FX_NAMED(POLYGON_OFFSET_FILL),
                               FX_NAMED(POLYGON_OFFSET_LINE),
                               FX_NAMED(POLYGON_OFFSET_POINT),
                               FX_NAMED(POLYGON_SMOOTH),
                               FX_NAMED(LINE_SMOOTH),
                               FX_NAMED(PRIMITIVE_RESTART),
                               FX_NAMED(PRIMITIVE_RESTART_FIXED_INDEX),
                               FX_NAMED(SAMPLE_MASK),
                               FX_NAMED(SAMPLE_COVERAGE),
                               FX_NAMED(SAMPLE_SHADING),
                               FX_NAMED(SAMPLE_ALPHA_TO_COVERAGE),
                               FX_NAMED(SAMPLE_ALPHA_TO_ONE),
                               FX_NAMED(PROGRAM_POINT_SIZE),
                               FX_NAMED(TEXTURE_CUBE_MAP_SEAMLESS),
                               FX_NAMED(CLIP_DISTANCE0),
                               FX_NAMED(CLIP_DISTANCE1),
                               FX_NAMED(CLIP_DISTANCE2),
                               FX_NAMED(CLIP_DISTANCE3),
                               FX_NAMED(CLIP_DISTANCE4),
                               FX_NAMED(CLIP_DISTANCE5),
                               FX_NAMED(CLIP_DISTANCE6),
                               FX_NAMED(CLIP_DISTANCE7)};

/// States that one query tells, with the number of values.
struct Query
{
    GLenum value;
    const char* name;
    int count;
};
#define FX_QUERY(x, count)                                                                                   \
    {                                                                                                        \
        GL_##x, "GL_" #x, count                                                                              \
    }

constexpr Query kQueries[] = {FX_QUERY(CURRENT_PROGRAM, 1),
                              FX_QUERY(PROGRAM_PIPELINE_BINDING, 1),
                              FX_QUERY(VERTEX_ARRAY_BINDING, 1),
                              FX_QUERY(DRAW_FRAMEBUFFER_BINDING, 1),
                              FX_QUERY(READ_FRAMEBUFFER_BINDING, 1),
                              FX_QUERY(RENDERBUFFER_BINDING, 1),
                              FX_QUERY(ARRAY_BUFFER_BINDING, 1),
                              FX_QUERY(COPY_READ_BUFFER_BINDING, 1),
                              FX_QUERY(COPY_WRITE_BUFFER_BINDING, 1),
                              FX_QUERY(PIXEL_PACK_BUFFER_BINDING, 1),
                              FX_QUERY(PIXEL_UNPACK_BUFFER_BINDING, 1),
                              FX_QUERY(DRAW_INDIRECT_BUFFER_BINDING, 1),
                              FX_QUERY(DISPATCH_INDIRECT_BUFFER_BINDING, 1),
                              FX_QUERY(UNIFORM_BUFFER_BINDING, 1),
                              FX_QUERY(SHADER_STORAGE_BUFFER_BINDING, 1),
                              FX_QUERY(ATOMIC_COUNTER_BUFFER_BINDING, 1),
                              FX_QUERY(TRANSFORM_FEEDBACK_BUFFER_BINDING, 1),
                              FX_QUERY(ACTIVE_TEXTURE, 1),
                              FX_QUERY(DEPTH_FUNC, 1),
                              FX_QUERY(DEPTH_WRITEMASK, 1),
                              FX_QUERY(DEPTH_CLEAR_VALUE, 1),
                              FX_QUERY(COLOR_CLEAR_VALUE, 4),
                              FX_QUERY(STENCIL_CLEAR_VALUE, 1),
                              FX_QUERY(STENCIL_FUNC, 1),
                              FX_QUERY(STENCIL_REF, 1),
                              FX_QUERY(STENCIL_VALUE_MASK, 1),
                              FX_QUERY(STENCIL_WRITEMASK, 1),
                              FX_QUERY(STENCIL_FAIL, 1),
                              FX_QUERY(BLEND_COLOR, 4),
                              FX_QUERY(LOGIC_OP_MODE, 1),
                              FX_QUERY(CULL_FACE_MODE, 1),
                              FX_QUERY(FRONT_FACE, 1),
                              FX_QUERY(POLYGON_MODE, 1),
                              FX_QUERY(POLYGON_OFFSET_FACTOR, 1),
                              FX_QUERY(POLYGON_OFFSET_UNITS, 1),
                              FX_QUERY(LINE_WIDTH, 1),
                              FX_QUERY(POINT_SIZE, 1),
                              FX_QUERY(PROVOKING_VERTEX, 1),
                              FX_QUERY(PRIMITIVE_RESTART_INDEX, 1),
                              FX_QUERY(SAMPLE_COVERAGE_VALUE, 1),
                              FX_QUERY(SAMPLE_COVERAGE_INVERT, 1),
                              FX_QUERY(MIN_SAMPLE_SHADING_VALUE, 1),
                              FX_QUERY(CLIP_ORIGIN, 1),
                              FX_QUERY(CLIP_DEPTH_MODE, 1),
                              FX_QUERY(PACK_ALIGNMENT, 1),
                              FX_QUERY(PACK_ROW_LENGTH, 1),
                              FX_QUERY(PACK_SKIP_ROWS, 1),
                              FX_QUERY(PACK_SKIP_PIXELS, 1),
                              FX_QUERY(UNPACK_ALIGNMENT, 1),
                              FX_QUERY(UNPACK_ROW_LENGTH, 1),
                              FX_QUERY(UNPACK_SKIP_ROWS, 1),
                              FX_QUERY(UNPACK_SKIP_PIXELS, 1),
                              FX_QUERY(PATCH_VERTICES, 1),
                              FX_QUERY(DEBUG_GROUP_STACK_DEPTH, 1)};

constexpr Query kDrawBufferQueries[] = {FX_QUERY(BLEND_EQUATION_RGB, 1), FX_QUERY(BLEND_EQUATION_ALPHA, 1),
                                        FX_QUERY(BLEND_SRC_RGB, 1),      FX_QUERY(BLEND_DST_RGB, 1),
                                        FX_QUERY(BLEND_SRC_ALPHA, 1),    FX_QUERY(BLEND_DST_ALPHA, 1),
                                        FX_QUERY(COLOR_WRITEMASK, 4)};

constexpr Query kImageQueries[] = {FX_QUERY(IMAGE_BINDING_NAME, 1),    FX_QUERY(IMAGE_BINDING_LEVEL, 1),
                                   FX_QUERY(IMAGE_BINDING_LAYERED, 1), FX_QUERY(IMAGE_BINDING_LAYER, 1),
                                   FX_QUERY(IMAGE_BINDING_ACCESS, 1),  FX_QUERY(IMAGE_BINDING_FORMAT, 1)};

constexpr Query kBufferQueries[] = {
    FX_QUERY(UNIFORM_BUFFER_BINDING, 1),       FX_QUERY(UNIFORM_BUFFER_START, 1),
    FX_QUERY(UNIFORM_BUFFER_SIZE, 1),          FX_QUERY(SHADER_STORAGE_BUFFER_BINDING, 1),
    FX_QUERY(SHADER_STORAGE_BUFFER_START, 1),  FX_QUERY(SHADER_STORAGE_BUFFER_SIZE, 1),
    FX_QUERY(ATOMIC_COUNTER_BUFFER_BINDING, 1)};

constexpr Query kUnitQueries[] = {FX_QUERY(TEXTURE_BINDING_1D, 1),
                                  FX_QUERY(TEXTURE_BINDING_2D, 1),
                                  FX_QUERY(TEXTURE_BINDING_3D, 1),
                                  FX_QUERY(TEXTURE_BINDING_CUBE_MAP, 1),
                                  FX_QUERY(TEXTURE_BINDING_2D_ARRAY, 1),
                                  FX_QUERY(TEXTURE_BINDING_BUFFER, 1),
                                  FX_QUERY(TEXTURE_BINDING_2D_MULTISAMPLE, 1),
                                  FX_QUERY(TEXTURE_BINDING_RECTANGLE, 1),
                                  FX_QUERY(SAMPLER_BINDING, 1)};

constexpr GLuint kUnits = 16;
constexpr GLuint kBindings = 8;
constexpr GLuint kDrawBuffers = 8;
constexpr GLuint kViewports = 4;

std::string indexed(const char* name, GLuint index)
{
    return std::string(name) + "[" + std::to_string(index) + "]";
}

} // namespace

std::vector<std::string> differences(const GlProbe& before, const GlProbe& after)
{
    std::vector<std::string> lines;
    for (const auto& [name, values] : before) {
        const auto found = after.find(name);
        if (found == after.end() || found->second != values)
            lines.push_back(name + ": " + std::to_string(values.at(0)) + " became " +
                            (found == after.end() ? "unknown" : std::to_string(found->second.at(0))));
    }
    return lines;
}

GlProbe GlHost::probe()
{
    FX_LOAD(ISENABLED, IsEnabled);
    FX_LOAD(ISENABLEDI, IsEnabledi);
    FX_LOAD(GETDOUBLEV, GetDoublev);
    FX_LOAD(GETDOUBLEI_V, GetDoublei_v);
    FX_LOAD(GETINTEGERI_V, GetIntegeri_v);
    FX_LOAD(GETINTEGER64I_V, GetInteger64i_v);
    FX_LOAD(GETINTEGERV, GetIntegerv);
    FX_LOAD(ACTIVETEXTURE, ActiveTexture);
    GlProbe all;
    const auto read = [&](const Query& query, const std::string& name) {
        double values[16] = {};
        GetDoublev(query.value, values);
        all[name].assign(values, values + query.count);
    };
    for (const Named& what : kSwitches)
        all[what.name] = {double(IsEnabled(what.value))};
    for (const Query& query : kQueries)
        read(query, query.name);
    for (GLuint i = 0; i < kDrawBuffers; ++i) {
        all[indexed("GL_BLEND", i)] = {double(IsEnabledi(GL_BLEND, i))};
        for (const Query& query : kDrawBufferQueries) {
            GLint values[4] = {};
            GetIntegeri_v(query.value, i, values);
            all[indexed(query.name, i)].assign(values, values + query.count);
        }
    }
    for (GLuint i = 0; i < kViewports; ++i) {
        all[indexed("GL_SCISSOR_TEST", i)] = {double(IsEnabledi(GL_SCISSOR_TEST, i))};
        for (const Query& query :
             {Query FX_QUERY(VIEWPORT, 4), Query FX_QUERY(SCISSOR_BOX, 4), Query FX_QUERY(DEPTH_RANGE, 2)})
        {
            double values[4] = {};
            GetDoublei_v(query.value, i, values);
            all[indexed(query.name, i)].assign(values, values + query.count);
        }
    }
    for (GLuint i = 0; i < kBindings; ++i) {
        for (const Query& query : kImageQueries) {
            GLint value = 0;
            GetIntegeri_v(query.value, i, &value);
            all[indexed(query.name, i)] = {double(value)};
        }
        for (const Query& query : kBufferQueries) {
            GLint64 value = 0;
            GetInteger64i_v(query.value, i, &value);
            all[indexed(query.name, i)] = {double(value)};
        }
    }
    GLint active = 0;
    GetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < kUnits; ++unit) {
        ActiveTexture(GL_TEXTURE0 + unit);
        for (const Query& query : kUnitQueries)
            read(query, indexed(query.name, unit));
    }
    ActiveTexture(GLenum(active));
    return all;
}

void GlHost::makeHostile()
{
    makeObjects();
    setRaster();
    setFragments();
    bindTextures();
    bindBuffers();
}

void GlHost::setRaster()
{
    FX_LOAD(ENABLE, Enable);
    FX_LOAD(DISABLE, Disable);
    FX_LOAD(VIEWPORTINDEXEDF, ViewportIndexedf);
    FX_LOAD(SCISSORINDEXED, ScissorIndexed);
    FX_LOAD(DEPTHRANGEINDEXED, DepthRangeIndexed);
    for (const Named& what : kSwitches)
        Enable(what.value);
    Disable(GL_MULTISAMPLE);
    for (GLuint i = 0; i < kViewports; ++i) {
        const float f = float(i);
        ViewportIndexedf(i, 1.5f + f, 2.5f + f, 11.0f + f, 13.0f + f);
        ScissorIndexed(i, 1 + GLint(i), 2, 5, 6);
        DepthRangeIndexed(i, 0.75, 0.25);
    }
    load<PFNGLPOLYGONMODEPROC>("glPolygonMode")(GL_FRONT_AND_BACK, GL_LINE);
    load<PFNGLPOLYGONOFFSETPROC>("glPolygonOffset")(3, 4);
    load<PFNGLCULLFACEPROC>("glCullFace")(GL_FRONT_AND_BACK);
    load<PFNGLFRONTFACEPROC>("glFrontFace")(GL_CW);
    load<PFNGLPOINTSIZEPROC>("glPointSize")(3);
    load<PFNGLPROVOKINGVERTEXPROC>("glProvokingVertex")(GL_FIRST_VERTEX_CONVENTION);
    load<PFNGLPRIMITIVERESTARTINDEXPROC>("glPrimitiveRestartIndex")(0);
    load<PFNGLSAMPLECOVERAGEPROC>("glSampleCoverage")(0.5f, GL_TRUE);
    load<PFNGLMINSAMPLESHADINGPROC>("glMinSampleShading")(0.5f);
    load<PFNGLCLIPCONTROLPROC>("glClipControl")(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    load<PFNGLPATCHPARAMETERIPROC>("glPatchParameteri")(GL_PATCH_VERTICES, 5);
}

void GlHost::setFragments()
{
    FX_LOAD(BLENDEQUATIONSEPARATEI, BlendEquationSeparatei);
    FX_LOAD(BLENDFUNCSEPARATEI, BlendFuncSeparatei);
    FX_LOAD(COLORMASKI, ColorMaski);
    for (GLuint i = 0; i < kDrawBuffers; ++i) {
        BlendEquationSeparatei(i, GL_MAX, GL_FUNC_REVERSE_SUBTRACT);
        BlendFuncSeparatei(i, GL_DST_COLOR, GL_ZERO, GL_SRC_ALPHA, GL_CONSTANT_ALPHA);
        ColorMaski(i, GL_FALSE, i % 2 == 0, GL_FALSE, GL_FALSE);
    }
    load<PFNGLDISABLEIPROC>("glDisablei")(GL_BLEND, 1);
    load<PFNGLBLENDCOLORPROC>("glBlendColor")(0.1f, 0.2f, 0.3f, 0.4f);
    load<PFNGLLOGICOPPROC>("glLogicOp")(GL_XOR);
    load<PFNGLDEPTHFUNCPROC>("glDepthFunc")(GL_NEVER);
    load<PFNGLDEPTHMASKPROC>("glDepthMask")(GL_FALSE);
    load<PFNGLSTENCILFUNCPROC>("glStencilFunc")(GL_NEVER, 5, 0x3F);
    load<PFNGLSTENCILMASKPROC>("glStencilMask")(0x1F);
    load<PFNGLSTENCILOPPROC>("glStencilOp")(GL_INVERT, GL_INCR, GL_DECR);
    load<PFNGLCLEARCOLORPROC>("glClearColor")(0.5f, 0.25f, 0.75f, 0.125f);
    load<PFNGLCLEARDEPTHPROC>("glClearDepth")(0.25);
    load<PFNGLCLEARSTENCILPROC>("glClearStencil")(3);
    FX_LOAD(PIXELSTOREI, PixelStorei);
    for (const GLenum what : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
        PixelStorei(what, 2);
    for (const GLenum what : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
                              GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS})
        PixelStorei(what, 7);
}

void GlHost::makeObjects()
{
    FX_LOAD(CREATETEXTURES, CreateTextures);
    FX_LOAD(TEXTURESTORAGE2D, TextureStorage2D);
    FX_LOAD(NAMEDFRAMEBUFFERTEXTURE, NamedFramebufferTexture);
    const GLenum targets[] = {GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_2D_ARRAY,
                              GL_TEXTURE_2D, GL_TEXTURE_2D, GL_TEXTURE_3D};
    for (int i = 0; i < 7; ++i)
        CreateTextures(targets[i], 1, &textures_[i]);
    for (const int i : {0, 1, 2, 4})
        TextureStorage2D(textures_[i], 2, i == 4 ? GL_RGBA32F : GL_RGBA8, 16, 16);
    load<PFNGLTEXTURESTORAGE3DPROC>("glTextureStorage3D")(textures_[3], 2, GL_R32F, 16, 16, 3);
    load<PFNGLTEXTURESTORAGE3DPROC>("glTextureStorage3D")(textures_[6], 1, GL_R32F, 4, 4, 4);
    TextureStorage2D(textures_[5], 1, GL_R32F, 16, 16);
    load<PFNGLCREATESAMPLERSPROC>("glCreateSamplers")(2, samplers_);
    load<PFNGLCREATEBUFFERSPROC>("glCreateBuffers")(3, buffers_);
    for (const GLuint buffer : buffers_)
        load<PFNGLNAMEDBUFFERSTORAGEPROC>("glNamedBufferStorage")(buffer, 65536, nullptr,
                                                                  GL_DYNAMIC_STORAGE_BIT);
    load<PFNGLCREATEFRAMEBUFFERSPROC>("glCreateFramebuffers")(2, framebuffers_);
    for (int i = 0; i < 2; ++i)
        NamedFramebufferTexture(framebuffers_[i], GL_COLOR_ATTACHMENT0, textures_[i], 0);
    load<PFNGLCREATEVERTEXARRAYSPROC>("glCreateVertexArrays")(1, &vertexArray_);
    load<PFNGLCREATERENDERBUFFERSPROC>("glCreateRenderbuffers")(1, &renderbuffer_);
    load<PFNGLCREATEPROGRAMPIPELINESPROC>("glCreateProgramPipelines")(1, &pipeline_);

    FX_LOAD(CREATESHADER, CreateShader);
    FX_LOAD(SHADERSOURCE, ShaderSource);
    FX_LOAD(COMPILESHADER, CompileShader);
    FX_LOAD(ATTACHSHADER, AttachShader);
    program_ = load<PFNGLCREATEPROGRAMPROC>("glCreateProgram")();
    const char* sources[] = {
        "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n",
        "#version 450 core\nlayout(location = 0) out vec4 c;\nvoid main() { c = vec4(0.0); }\n"};
    const GLenum stages[] = {GL_VERTEX_SHADER, GL_FRAGMENT_SHADER};
    for (int i = 0; i < 2; ++i) {
        const GLuint shader = CreateShader(stages[i]);
        ShaderSource(shader, 1, &sources[i], nullptr);
        CompileShader(shader);
        AttachShader(program_, shader);
        load<PFNGLDELETESHADERPROC>("glDeleteShader")(shader);
    }
    load<PFNGLLINKPROGRAMPROC>("glLinkProgram")(program_);
}

void GlHost::bindTextures()
{
    FX_LOAD(ACTIVETEXTURE, ActiveTexture);
    FX_LOAD(BINDTEXTURE, BindTexture);
    FX_LOAD(BINDSAMPLER, BindSampler);
    FX_LOAD(BINDIMAGETEXTURE, BindImageTexture);
    for (GLuint unit = 0; unit < kUnits; ++unit) {
        ActiveTexture(GL_TEXTURE0 + unit);
        if (unit != 3) // nothing is also something to be restored
            BindTexture(GL_TEXTURE_2D, textures_[unit % 2]);
        BindTexture(GL_TEXTURE_CUBE_MAP, textures_[2]);
        BindTexture(GL_TEXTURE_2D_ARRAY, textures_[3]);
        if (unit != 4)
            BindTexture(GL_TEXTURE_3D, textures_[6]);
        if (unit != 5)
            BindSampler(unit, samplers_[unit % 2]);
    }
    ActiveTexture(GL_TEXTURE11);
    for (GLuint unit = 0; unit < kBindings; ++unit) {
        if (unit == 2)
            continue;
        if (unit % 2)
            BindImageTexture(unit, textures_[3], 1, GL_FALSE, 2, GL_WRITE_ONLY, GL_R32F);
        else
            BindImageTexture(unit, textures_[4], 0, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA32F);
    }
}

void GlHost::bindBuffers()
{
    FX_LOAD(BINDBUFFER, BindBuffer);
    FX_LOAD(BINDBUFFERRANGE, BindBufferRange);
    FX_LOAD(BINDBUFFERBASE, BindBufferBase);
    FX_LOAD(BINDFRAMEBUFFER, BindFramebuffer);
    for (GLuint i = 0; i < kBindings; ++i) {
        BindBufferRange(GL_UNIFORM_BUFFER, i, buffers_[0], 256 * (i + 1), 512);
        if (i == 1)
            BindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers_[1]);
        else if (i != 4)
            BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffers_[1], 256 * (i + 1), 768);
        BindBufferBase(GL_ATOMIC_COUNTER_BUFFER, i, buffers_[2]);
    }
    for (const GLenum target :
         {GL_ARRAY_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_PIXEL_PACK_BUFFER,
          GL_PIXEL_UNPACK_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_UNIFORM_BUFFER,
          GL_SHADER_STORAGE_BUFFER, GL_TRANSFORM_FEEDBACK_BUFFER})
        BindBuffer(target, buffers_[2]);
    BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[0]);
    BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    load<PFNGLBINDRENDERBUFFERPROC>("glBindRenderbuffer")(GL_RENDERBUFFER, renderbuffer_);
    load<PFNGLBINDVERTEXARRAYPROC>("glBindVertexArray")(vertexArray_);
    load<PFNGLUSEPROGRAMPROC>("glUseProgram")(program_);
    load<PFNGLBINDPROGRAMPIPELINEPROC>("glBindProgramPipeline")(pipeline_);
}

void GlHost::release()
{
    load<PFNGLDELETETEXTURESPROC>("glDeleteTextures")(7, textures_);
    load<PFNGLDELETESAMPLERSPROC>("glDeleteSamplers")(2, samplers_);
    load<PFNGLDELETEBUFFERSPROC>("glDeleteBuffers")(3, buffers_);
    load<PFNGLDELETEFRAMEBUFFERSPROC>("glDeleteFramebuffers")(2, framebuffers_);
    load<PFNGLDELETEVERTEXARRAYSPROC>("glDeleteVertexArrays")(1, &vertexArray_);
    load<PFNGLDELETERENDERBUFFERSPROC>("glDeleteRenderbuffers")(1, &renderbuffer_);
    load<PFNGLDELETEPROGRAMPIPELINESPROC>("glDeleteProgramPipelines")(1, &pipeline_);
    load<PFNGLDELETEPROGRAMPROC>("glDeleteProgram")(program_);
}

} // namespace fx::render
