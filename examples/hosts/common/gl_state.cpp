#include "gl_state.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdio>

namespace host {

namespace {

struct Named
{
    GLenum value;
    const char* name;
    int count = 1; ///< numbers that a query returns
};
#define HOST_NAMED(name)                                                                                     \
    {                                                                                                        \
        GL_##name, "GL_" #name                                                                               \
    }
#define HOST_VECTOR(name, count)                                                                             \
    {                                                                                                        \
        GL_##name, "GL_" #name, count                                                                        \
    }

constexpr Named kSwitches[] = {HOST_NAMED(CULL_FACE),
                               HOST_NAMED(DEPTH_TEST),
                               HOST_NAMED(STENCIL_TEST),
                               HOST_NAMED(DEPTH_CLAMP),
                               HOST_NAMED(FRAMEBUFFER_SRGB),
                               HOST_NAMED(RASTERIZER_DISCARD),
                               HOST_NAMED(COLOR_LOGIC_OP),
                               HOST_NAMED(DITHER),
                               HOST_NAMED(MULTISAMPLE),
                               HOST_NAMED(POLYGON_OFFSET_FILL),
                               HOST_NAMED(POLYGON_OFFSET_LINE),
                               HOST_NAMED(POLYGON_OFFSET_POINT),
                               HOST_NAMED(POLYGON_SMOOTH),
                               HOST_NAMED(LINE_SMOOTH),
                               HOST_NAMED(PRIMITIVE_RESTART),
                               HOST_NAMED(PRIMITIVE_RESTART_FIXED_INDEX),
                               HOST_NAMED(SAMPLE_MASK),
                               HOST_NAMED(SAMPLE_COVERAGE),
                               HOST_NAMED(SAMPLE_SHADING),
                               HOST_NAMED(SAMPLE_ALPHA_TO_COVERAGE),
                               HOST_NAMED(SAMPLE_ALPHA_TO_ONE),
                               HOST_NAMED(PROGRAM_POINT_SIZE),
                               HOST_NAMED(TEXTURE_CUBE_MAP_SEAMLESS),
                               HOST_NAMED(CLIP_DISTANCE0),
                               HOST_NAMED(CLIP_DISTANCE1)};

constexpr Named kValues[] = {HOST_NAMED(CURRENT_PROGRAM),
                             HOST_NAMED(PROGRAM_PIPELINE_BINDING),
                             HOST_NAMED(VERTEX_ARRAY_BINDING),
                             HOST_NAMED(DRAW_FRAMEBUFFER_BINDING),
                             HOST_NAMED(READ_FRAMEBUFFER_BINDING),
                             HOST_NAMED(RENDERBUFFER_BINDING),
                             HOST_NAMED(ARRAY_BUFFER_BINDING),
                             HOST_NAMED(COPY_READ_BUFFER_BINDING),
                             HOST_NAMED(COPY_WRITE_BUFFER_BINDING),
                             HOST_NAMED(PIXEL_PACK_BUFFER_BINDING),
                             HOST_NAMED(PIXEL_UNPACK_BUFFER_BINDING),
                             HOST_NAMED(DRAW_INDIRECT_BUFFER_BINDING),
                             HOST_NAMED(DISPATCH_INDIRECT_BUFFER_BINDING),
                             HOST_NAMED(UNIFORM_BUFFER_BINDING),
                             HOST_NAMED(SHADER_STORAGE_BUFFER_BINDING),
                             HOST_NAMED(ACTIVE_TEXTURE),
                             HOST_NAMED(DEPTH_FUNC),
                             HOST_NAMED(DEPTH_WRITEMASK),
                             HOST_NAMED(DEPTH_CLEAR_VALUE),
                             HOST_VECTOR(COLOR_CLEAR_VALUE, 4),
                             HOST_NAMED(STENCIL_CLEAR_VALUE),
                             HOST_NAMED(STENCIL_FUNC),
                             HOST_NAMED(STENCIL_REF),
                             HOST_NAMED(STENCIL_VALUE_MASK),
                             HOST_NAMED(STENCIL_WRITEMASK),
                             HOST_NAMED(STENCIL_FAIL),
                             HOST_NAMED(STENCIL_PASS_DEPTH_FAIL),
                             HOST_NAMED(STENCIL_PASS_DEPTH_PASS),
                             HOST_NAMED(STENCIL_BACK_FUNC),
                             HOST_NAMED(STENCIL_BACK_WRITEMASK),
                             HOST_VECTOR(BLEND_COLOR, 4),
                             HOST_NAMED(LOGIC_OP_MODE),
                             HOST_NAMED(CULL_FACE_MODE),
                             HOST_NAMED(FRONT_FACE),
                             HOST_NAMED(POLYGON_MODE),
                             HOST_NAMED(POLYGON_OFFSET_FACTOR),
                             HOST_NAMED(POLYGON_OFFSET_UNITS),
                             HOST_NAMED(LINE_WIDTH),
                             HOST_NAMED(POINT_SIZE),
                             HOST_NAMED(PROVOKING_VERTEX),
                             HOST_NAMED(PRIMITIVE_RESTART_INDEX),
                             HOST_NAMED(SAMPLE_COVERAGE_VALUE),
                             HOST_NAMED(SAMPLE_COVERAGE_INVERT),
                             HOST_NAMED(MIN_SAMPLE_SHADING_VALUE),
                             HOST_NAMED(CLIP_ORIGIN),
                             HOST_NAMED(CLIP_DEPTH_MODE),
                             HOST_NAMED(PATCH_VERTICES),
                             HOST_NAMED(PACK_ALIGNMENT),
                             HOST_NAMED(PACK_ROW_LENGTH),
                             HOST_NAMED(PACK_SKIP_ROWS),
                             HOST_NAMED(PACK_SKIP_PIXELS),
                             HOST_NAMED(UNPACK_ALIGNMENT),
                             HOST_NAMED(UNPACK_ROW_LENGTH),
                             HOST_NAMED(UNPACK_SKIP_ROWS),
                             HOST_NAMED(UNPACK_SKIP_PIXELS),
                             HOST_NAMED(DEBUG_GROUP_STACK_DEPTH)};

constexpr Named kOfDrawBuffers[] = {HOST_NAMED(BLEND_EQUATION_RGB), HOST_NAMED(BLEND_EQUATION_ALPHA),
                                    HOST_NAMED(BLEND_SRC_RGB),      HOST_NAMED(BLEND_DST_RGB),
                                    HOST_NAMED(BLEND_SRC_ALPHA),    HOST_NAMED(BLEND_DST_ALPHA),
                                    HOST_VECTOR(COLOR_WRITEMASK, 4)};
constexpr Named kOfViewports[] = {HOST_VECTOR(VIEWPORT, 4), HOST_VECTOR(SCISSOR_BOX, 4),
                                  HOST_VECTOR(DEPTH_RANGE, 2)};
constexpr Named kOfImages[] = {HOST_NAMED(IMAGE_BINDING_NAME), HOST_NAMED(IMAGE_BINDING_LEVEL),
                               HOST_NAMED(IMAGE_BINDING_ACCESS), HOST_NAMED(IMAGE_BINDING_FORMAT)};
constexpr Named kOfBuffers[] = {
    HOST_NAMED(UNIFORM_BUFFER_BINDING),      HOST_NAMED(UNIFORM_BUFFER_START),
    HOST_NAMED(UNIFORM_BUFFER_SIZE),         HOST_NAMED(SHADER_STORAGE_BUFFER_BINDING),
    HOST_NAMED(SHADER_STORAGE_BUFFER_START), HOST_NAMED(SHADER_STORAGE_BUFFER_SIZE)};
constexpr Named kOfUnits[] = {HOST_NAMED(TEXTURE_BINDING_1D),
                              HOST_NAMED(TEXTURE_BINDING_2D),
                              HOST_NAMED(TEXTURE_BINDING_3D),
                              HOST_NAMED(TEXTURE_BINDING_CUBE_MAP),
                              HOST_NAMED(TEXTURE_BINDING_2D_ARRAY),
                              HOST_NAMED(TEXTURE_BINDING_BUFFER),
                              HOST_NAMED(TEXTURE_BINDING_2D_MULTISAMPLE),
                              HOST_NAMED(SAMPLER_BINDING)};

constexpr GLuint kUnits = 16, kBindings = 8, kDrawBuffers = 8, kViewports = 2;

void put(GlState& state, const Named& what, int index, const double* values)
{
    const std::string name = what.name + (index < 0 ? "" : "[" + std::to_string(index) + "]");
    for (int i = 0; i < what.count; ++i)
        state[what.count == 1 ? name : name + "." + std::to_string(i)] = values[i];
}

} // namespace

GlState readGlState()
{
    GlState state;
    double values[16] = {};
    const auto readIndexed = [&](const Named& what, GLuint index) {
        GLint64 whole[16] = {};
        glGetInteger64i_v(what.value, index, whole);
        std::copy(whole, whole + 16, values);
        put(state, what, int(index), values);
    };
    for (const Named& what : kSwitches)
        state[what.name] = glIsEnabled(what.value);
    for (const Named& what : kValues) {
        glGetDoublev(what.value, values);
        put(state, what, -1, values);
    }
    for (GLuint i = 0; i < kDrawBuffers; ++i) {
        state["GL_BLEND[" + std::to_string(i) + "]"] = glIsEnabledi(GL_BLEND, i);
        for (const Named& what : kOfDrawBuffers)
            readIndexed(what, i);
    }
    for (GLuint i = 0; i < kViewports; ++i) {
        state["GL_SCISSOR_TEST[" + std::to_string(i) + "]"] = glIsEnabledi(GL_SCISSOR_TEST, i);
        for (const Named& what : kOfViewports) {
            glGetDoublei_v(what.value, i, values);
            put(state, what, int(i), values);
        }
    }
    for (GLuint i = 0; i < kBindings; ++i) {
        for (const Named& what : kOfImages)
            readIndexed(what, i);
        for (const Named& what : kOfBuffers)
            readIndexed(what, i);
    }
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint unit = 0; unit < kUnits; ++unit) {
        glActiveTexture(GL_TEXTURE0 + unit);
        for (const Named& what : kOfUnits) {
            glGetDoublev(what.value, values);
            put(state, what, int(unit), values);
        }
    }
    glActiveTexture(GLenum(active));
    return state;
}

int printDifferences(const GlState& before, const GlState& after)
{
    int differences = 0;
    for (const auto& [name, value] : before)
        if (const auto found = after.find(name); found == after.end() || found->second != value) {
            ++differences;
            std::fprintf(stderr, "GL state %s: %g became %g\n", name.c_str(), value,
                         found == after.end() ? 0.0 : found->second);
        }
    return differences;
}

} // namespace host
