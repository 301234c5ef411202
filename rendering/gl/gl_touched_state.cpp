#include "rendering/gl/gl_touched_state.h"

#include <algorithm>
#include <iterator>

namespace fx::render {

namespace {

using Gl = GlFunctions;
using Saved = GlSavedState;

GLint integer(const Gl& gl, GLenum what)
{
    GLint value = 0;
    gl.GetIntegerv(what, &value);
    return value;
}

GLint integerAt(const Gl& gl, GLenum what, uint32_t index)
{
    GLint value = 0;
    gl.GetIntegeri_v(what, index, &value);
    return value;
}

GLenum asEnum(GLint64 value)
{
    return static_cast<GLenum>(value);
}
GLuint asName(GLint64 value)
{
    return static_cast<GLuint>(value);
}

/// Any state that one glGetIntegerv tells.
void saveInteger(const Gl& gl, GLenum what, uint32_t, Saved& out)
{
    out.integers[0] = integer(gl, what);
}

// ---- switches ----

void saveSwitch(const Gl& gl, GLenum what, uint32_t index, Saved& out)
{
    out.integers[0] = gl.IsEnabled(what + index);
}

void restoreSwitch(const Gl& gl, GLenum what, uint32_t index, const Saved& saved)
{
    saved.integers[0] ? gl.Enable(what + index) : gl.Disable(what + index);
}

void saveIndexedSwitch(const Gl& gl, GLenum what, uint32_t index, Saved& out)
{
    out.integers[0] = gl.IsEnabledi(what, index);
}

void restoreIndexedSwitch(const Gl& gl, GLenum what, uint32_t index, const Saved& saved)
{
    saved.integers[0] ? gl.Enablei(what, index) : gl.Disablei(what, index);
}

// ---- per-fragment and raster state ----

void saveBlendEquation(const Gl& gl, GLenum, uint32_t index, Saved& out)
{
    out.integers[0] = integerAt(gl, GL_BLEND_EQUATION_RGB, index);
    out.integers[1] = integerAt(gl, GL_BLEND_EQUATION_ALPHA, index);
}

void restoreBlendEquation(const Gl& gl, GLenum, uint32_t index, const Saved& saved)
{
    gl.BlendEquationSeparatei(index, asEnum(saved.integers[0]), asEnum(saved.integers[1]));
}

void saveBlendFunction(const Gl& gl, GLenum, uint32_t index, Saved& out)
{
    out.integers[0] = integerAt(gl, GL_BLEND_SRC_RGB, index);
    out.integers[1] = integerAt(gl, GL_BLEND_DST_RGB, index);
    out.integers[2] = integerAt(gl, GL_BLEND_SRC_ALPHA, index);
    out.integers[3] = integerAt(gl, GL_BLEND_DST_ALPHA, index);
}

void restoreBlendFunction(const Gl& gl, GLenum, uint32_t index, const Saved& saved)
{
    gl.BlendFuncSeparatei(index, asEnum(saved.integers[0]), asEnum(saved.integers[1]),
                          asEnum(saved.integers[2]), asEnum(saved.integers[3]));
}

void saveColorMask(const Gl& gl, GLenum, uint32_t index, Saved& out)
{
    GLboolean mask[4] = {};
    gl.GetBooleani_v(GL_COLOR_WRITEMASK, index, mask);
    std::copy(std::begin(mask), std::end(mask), out.integers);
}

void restoreColorMask(const Gl& gl, GLenum, uint32_t index, const Saved& saved)
{
    gl.ColorMaski(index, saved.integers[0] != 0, saved.integers[1] != 0, saved.integers[2] != 0,
                  saved.integers[3] != 0);
}

void restoreDepthFunction(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.DepthFunc(asEnum(saved.integers[0]));
}

void restoreDepthMask(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.DepthMask(saved.integers[0] != 0);
}

void savePolygonMode(const Gl& gl, GLenum, uint32_t, Saved& out)
{
    GLint modes[2] = {}; // drivers write one or two
    gl.GetIntegerv(GL_POLYGON_MODE, modes);
    out.integers[0] = modes[0];
}

void restorePolygonMode(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.PolygonMode(GL_FRONT_AND_BACK, asEnum(saved.integers[0]));
}

void restoreProvokingVertex(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.ProvokingVertex(asEnum(saved.integers[0]));
}

void saveViewport(const Gl& gl, GLenum, uint32_t index, Saved& out)
{
    GLfloat box[4] = {};
    gl.GetFloati_v(GL_VIEWPORT, index, box);
    std::copy(std::begin(box), std::end(box), out.reals);
}

void restoreViewport(const Gl& gl, GLenum, uint32_t index, const Saved& saved)
{
    gl.ViewportIndexedf(index, static_cast<GLfloat>(saved.reals[0]), static_cast<GLfloat>(saved.reals[1]),
                        static_cast<GLfloat>(saved.reals[2]), static_cast<GLfloat>(saved.reals[3]));
}

void saveDepthRange(const Gl& gl, GLenum, uint32_t index, Saved& out)
{
    gl.GetDoublei_v(GL_DEPTH_RANGE, index, out.reals);
}

void restoreDepthRange(const Gl& gl, GLenum, uint32_t index, const Saved& saved)
{
    gl.DepthRangeIndexed(index, saved.reals[0], saved.reals[1]);
}

// ---- bindings ----

void restoreProgram(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.UseProgram(asName(saved.integers[0]));
}

void restoreVertexArray(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.BindVertexArray(asName(saved.integers[0]));
}

void restoreDrawFramebuffer(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, asName(saved.integers[0]));
}

void restoreActiveTexture(const Gl& gl, GLenum, uint32_t, const Saved& saved)
{
    gl.ActiveTexture(asEnum(saved.integers[0]));
}

/// Only the unit's bindings of 2-D textures, arrays of them and 3-D textures are ours:
/// glBindTextureUnit(unit, 0) would also drop the host's cube map.
constexpr struct
{
    GLenum target, binding;
} kUnitBindings[] = {{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
                     {GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
                     {GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D}};

void saveUnit(const Gl& gl, GLenum, uint32_t unit, Saved& out)
{
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    for (size_t i = 0; i < std::size(kUnitBindings); ++i)
        out.integers[i] = integer(gl, kUnitBindings[i].binding);
    out.integers[3] = integer(gl, GL_SAMPLER_BINDING);
}

void restoreUnit(const Gl& gl, GLenum, uint32_t unit, const Saved& saved)
{
    gl.ActiveTexture(GL_TEXTURE0 + unit);
    for (size_t i = 0; i < std::size(kUnitBindings); ++i)
        gl.BindTexture(kUnitBindings[i].target, asName(saved.integers[i]));
    gl.BindSampler(unit, asName(saved.integers[3]));
}

void saveImage(const Gl& gl, GLenum, uint32_t unit, Saved& out)
{
    constexpr GLenum kParts[] = {GL_IMAGE_BINDING_NAME,  GL_IMAGE_BINDING_LEVEL,  GL_IMAGE_BINDING_LAYERED,
                                 GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT};
    for (size_t i = 0; i < std::size(kParts); ++i)
        out.integers[i] = integerAt(gl, kParts[i], unit);
}

void restoreImage(const Gl& gl, GLenum, uint32_t unit, const Saved& saved)
{
    const GLint64* part = saved.integers;
    gl.BindImageTexture(unit, asName(part[0]), static_cast<GLint>(part[1]), part[2] != 0,
                        static_cast<GLint>(part[3]), asEnum(part[4]), asEnum(part[5]));
}

void restoreGenericBuffer(const Gl& gl, GLenum what, uint32_t, const Saved& saved)
{
    const GLenum target = what == GL_UNIFORM_BUFFER_BINDING         ? GL_UNIFORM_BUFFER
                          : what == GL_DRAW_INDIRECT_BUFFER_BINDING ? GL_DRAW_INDIRECT_BUFFER
                                                                    : GL_SHADER_STORAGE_BUFFER;
    gl.BindBuffer(target, asName(saved.integers[0]));
}

void saveIndexedBuffer(const Gl& gl, GLenum target, uint32_t index, Saved& out)
{
    const bool uniform = target == GL_UNIFORM_BUFFER;
    out.integers[0] =
        integerAt(gl, uniform ? GL_UNIFORM_BUFFER_BINDING : GL_SHADER_STORAGE_BUFFER_BINDING, index);
    gl.GetInteger64i_v(uniform ? GL_UNIFORM_BUFFER_START : GL_SHADER_STORAGE_BUFFER_START, index,
                       &out.integers[1]);
    gl.GetInteger64i_v(uniform ? GL_UNIFORM_BUFFER_SIZE : GL_SHADER_STORAGE_BUFFER_SIZE, index,
                       &out.integers[2]);
}

void restoreIndexedBuffer(const Gl& gl, GLenum target, uint32_t index, const Saved& saved)
{
    const GLuint buffer = asName(saved.integers[0]);
    if (buffer && saved.integers[2] > 0) // size 0 says that the whole buffer was bound
        gl.BindBufferRange(target, index, buffer, static_cast<GLintptr>(saved.integers[1]),
                           static_cast<GLsizeiptr>(saved.integers[2]));
    else
        gl.BindBufferBase(target, index, buffer);
}

constexpr GlTouchedState kTable[] = {
    // First, because saving and restoring the entries below disturbs them, and drawing disturbs the generic
    // bindings.
    {"GL_ACTIVE_TEXTURE", GL_ACTIVE_TEXTURE, 1, saveInteger, restoreActiveTexture},
    {"GL_UNIFORM_BUFFER_BINDING", GL_UNIFORM_BUFFER_BINDING, 1, saveInteger, restoreGenericBuffer},
    {"GL_SHADER_STORAGE_BUFFER_BINDING", GL_SHADER_STORAGE_BUFFER_BINDING, 1, saveInteger,
     restoreGenericBuffer},
    {"GL_DRAW_INDIRECT_BUFFER_BINDING", GL_DRAW_INDIRECT_BUFFER_BINDING, 1, saveInteger,
     restoreGenericBuffer},

    {"GL_CULL_FACE", GL_CULL_FACE, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_DEPTH_TEST", GL_DEPTH_TEST, 1, saveSwitch, restoreSwitch},
    {"GL_STENCIL_TEST", GL_STENCIL_TEST, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_DEPTH_CLAMP", GL_DEPTH_CLAMP, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_FRAMEBUFFER_SRGB", GL_FRAMEBUFFER_SRGB, 1, saveSwitch, restoreSwitch},
    {"GL_RASTERIZER_DISCARD", GL_RASTERIZER_DISCARD, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_PRIMITIVE_RESTART", GL_PRIMITIVE_RESTART, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_PRIMITIVE_RESTART_FIXED_INDEX", GL_PRIMITIVE_RESTART_FIXED_INDEX, 1, saveSwitch, restoreSwitch,
     GlStateGroup::Off},
    {"GL_COLOR_LOGIC_OP", GL_COLOR_LOGIC_OP, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_DITHER", GL_DITHER, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_POLYGON_OFFSET_FILL", GL_POLYGON_OFFSET_FILL, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_POLYGON_SMOOTH", GL_POLYGON_SMOOTH, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_SAMPLE_MASK", GL_SAMPLE_MASK, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_SAMPLE_ALPHA_TO_COVERAGE", GL_SAMPLE_ALPHA_TO_COVERAGE, 1, saveSwitch, restoreSwitch,
     GlStateGroup::Off},
    {"GL_SAMPLE_ALPHA_TO_ONE", GL_SAMPLE_ALPHA_TO_ONE, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_SAMPLE_COVERAGE", GL_SAMPLE_COVERAGE, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_SAMPLE_SHADING", GL_SAMPLE_SHADING, 1, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_CLIP_DISTANCE0 to 7", GL_CLIP_DISTANCE0, 8, saveSwitch, restoreSwitch, GlStateGroup::Off},
    {"GL_BLEND (draw buffers 0 to 7)", GL_BLEND, 8, saveIndexedSwitch, restoreIndexedSwitch,
     GlStateGroup::DrawBuffer},
    {"GL_SCISSOR_TEST (viewport 0)", GL_SCISSOR_TEST, 1, saveIndexedSwitch, restoreIndexedSwitch},

    {"GL_BLEND_EQUATION_RGB, _ALPHA (draw buffers 0 to 7)", 0, 8, saveBlendEquation, restoreBlendEquation,
     GlStateGroup::DrawBuffer},
    {"GL_BLEND_SRC_RGB, _DST_RGB, _SRC_ALPHA, _DST_ALPHA (draw buffers 0 to 7)", 0, 8, saveBlendFunction,
     restoreBlendFunction, GlStateGroup::DrawBuffer},
    {"GL_COLOR_WRITEMASK (draw buffers 0 to 7)", 0, 8, saveColorMask, restoreColorMask,
     GlStateGroup::ColorMask},
    {"GL_DEPTH_FUNC", GL_DEPTH_FUNC, 1, saveInteger, restoreDepthFunction},
    {"GL_DEPTH_WRITEMASK", GL_DEPTH_WRITEMASK, 1, saveInteger, restoreDepthMask},
    {"GL_POLYGON_MODE", GL_POLYGON_MODE, 1, savePolygonMode, restorePolygonMode},
    {"GL_PROVOKING_VERTEX", GL_PROVOKING_VERTEX, 1, saveInteger, restoreProvokingVertex},
    {"GL_VIEWPORT (viewport 0)", 0, 1, saveViewport, restoreViewport},
    {"GL_DEPTH_RANGE (viewport 0)", 0, 1, saveDepthRange, restoreDepthRange},

    {"GL_CURRENT_PROGRAM", GL_CURRENT_PROGRAM, 1, saveInteger, restoreProgram},
    {"GL_VERTEX_ARRAY_BINDING", GL_VERTEX_ARRAY_BINDING, 1, saveInteger, restoreVertexArray},
    {"GL_DRAW_FRAMEBUFFER_BINDING", GL_DRAW_FRAMEBUFFER_BINDING, 1, saveInteger, restoreDrawFramebuffer},
    {"GL_TEXTURE_BINDING_2D, _2D_ARRAY, _3D and GL_SAMPLER_BINDING (units 0 to 12)", 0, 13, saveUnit,
     restoreUnit, GlStateGroup::TextureUnit},
    {"GL_IMAGE_BINDING_* (units 0 to 6)", 0, 7, saveImage, restoreImage, GlStateGroup::ImageUnit},
    {"GL_UNIFORM_BUFFER_BINDING, _START, _SIZE (bindings 0 and 1)", GL_UNIFORM_BUFFER, 2, saveIndexedBuffer,
     restoreIndexedBuffer, GlStateGroup::UniformBinding},
    {"GL_SHADER_STORAGE_BUFFER_BINDING, _START, _SIZE (bindings 0 to 7)", GL_SHADER_STORAGE_BUFFER, 8,
     saveIndexedBuffer, restoreIndexedBuffer, GlStateGroup::StorageBinding},
};

constexpr uint32_t sumOfCounts()
{
    uint32_t sum = 0;
    for (const GlTouchedState& state : kTable)
        sum += state.count;
    return sum;
}
static_assert(sumOfCounts() == kGlSavedStates && std::size(kTable) == kGlTouchedStates);

} // namespace

std::span<const GlTouchedState> glTouchedStates()
{
    return kTable;
}

} // namespace fx::render
