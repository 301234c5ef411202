// The picture does not depend on any state of OpenGL that the host has set, and each of them is afterwards
// what it was.
#include "tests/api/view_fixture.h"
#include "tests/rendering/gl/gl_host_state.h"

#include <functional>

using fx::render::differences;
using fx::render::GlHost;
using fx::render::GlProbe;
using fx::test::loadText;

#define FX_CALL(type, name) gl.load<PFNGL##type##PROC>("gl" #name)

namespace {

/// The host's own function pointers.
struct HostGl
{
    fx::render::GlLoader loader;

    template <class Function>
    Function load(const char* name) const
    {
        return reinterpret_cast<Function>(loader.getProcAddress(loader.user, name));
    }
};

/// A state of the context and a value of it other than GL's default.
struct HostState
{
    std::string name;
    std::function<void(const HostGl& gl)> set;
    std::function<void(const HostGl& gl)> reset; ///< to GL's default
};

void addSwitches(std::vector<HostState>& states)
{
    const std::pair<const char*, GLenum> kOn[] = {
        {"GL_BLEND", GL_BLEND},
        {"GL_CULL_FACE", GL_CULL_FACE},
        {"GL_DEPTH_TEST", GL_DEPTH_TEST},
        {"GL_STENCIL_TEST", GL_STENCIL_TEST},
        {"GL_SCISSOR_TEST", GL_SCISSOR_TEST},
        {"GL_DEPTH_CLAMP", GL_DEPTH_CLAMP},
        {"GL_FRAMEBUFFER_SRGB", GL_FRAMEBUFFER_SRGB},
        {"GL_RASTERIZER_DISCARD", GL_RASTERIZER_DISCARD},
        {"GL_COLOR_LOGIC_OP", GL_COLOR_LOGIC_OP},
        {"GL_POLYGON_OFFSET_FILL", GL_POLYGON_OFFSET_FILL},
        {"GL_POLYGON_OFFSET_LINE", GL_POLYGON_OFFSET_LINE},
        {"GL_POLYGON_OFFSET_POINT", GL_POLYGON_OFFSET_POINT},
        {"GL_POLYGON_SMOOTH", GL_POLYGON_SMOOTH},
        {"GL_LINE_SMOOTH", GL_LINE_SMOOTH},
        {"GL_PRIMITIVE_RESTART", GL_PRIMITIVE_RESTART},
        {"GL_PRIMITIVE_RESTART_FIXED_INDEX", GL_PRIMITIVE_RESTART_FIXED_INDEX},
        {"GL_SAMPLE_MASK", GL_SAMPLE_MASK},
        {"GL_SAMPLE_COVERAGE", GL_SAMPLE_COVERAGE},
        {"GL_SAMPLE_SHADING", GL_SAMPLE_SHADING},
        {"GL_SAMPLE_ALPHA_TO_COVERAGE", GL_SAMPLE_ALPHA_TO_COVERAGE},
        {"GL_SAMPLE_ALPHA_TO_ONE", GL_SAMPLE_ALPHA_TO_ONE},
        {"GL_PROGRAM_POINT_SIZE", GL_PROGRAM_POINT_SIZE},
        {"GL_TEXTURE_CUBE_MAP_SEAMLESS", GL_TEXTURE_CUBE_MAP_SEAMLESS},
        {"GL_CLIP_DISTANCE0", GL_CLIP_DISTANCE0},
        {"GL_CLIP_DISTANCE7", GL_CLIP_DISTANCE7}};
    for (const auto& [name, what] : kOn)
        states.push_back({name,
                          [what = what](const HostGl& gl) {
                              FX_CALL(ENABLE, Enable)
                              (what);
                          },
                          [what = what](const HostGl& gl) {
                              FX_CALL(DISABLE, Disable)
                              (what);
                          }});
    for (const auto& [name, what] :
         {std::pair("GL_DITHER off", GL_DITHER), std::pair("GL_MULTISAMPLE off", GL_MULTISAMPLE)})
        states.push_back({name,
                          [what = what](const HostGl& gl) {
                              FX_CALL(DISABLE, Disable)
                              (GLenum(what));
                          },
                          [what = what](const HostGl& gl) {
                              FX_CALL(ENABLE, Enable)
                              (GLenum(what));
                          }});
}

void addRaster(std::vector<HostState>& states)
{
    const auto add = [&](const char* name, auto set, auto reset) { states.push_back({name, set, reset}); };
    add(
        "glProvokingVertex",
        [](const HostGl& gl) {
            FX_CALL(PROVOKINGVERTEX, ProvokingVertex)
            (GL_FIRST_VERTEX_CONVENTION);
        },
        [](const HostGl& gl) {
            FX_CALL(PROVOKINGVERTEX, ProvokingVertex)
            (GL_LAST_VERTEX_CONVENTION);
        });
    add(
        "glPolygonMode",
        [](const HostGl& gl) {
            FX_CALL(POLYGONMODE, PolygonMode)
            (GL_FRONT_AND_BACK, GL_LINE);
        },
        [](const HostGl& gl) {
            FX_CALL(POLYGONMODE, PolygonMode)
            (GL_FRONT_AND_BACK, GL_FILL);
        });
    add(
        "glPolygonOffset",
        [](const HostGl& gl) {
            FX_CALL(POLYGONOFFSET, PolygonOffset)(3, 4);
            FX_CALL(ENABLE, Enable)(GL_POLYGON_OFFSET_FILL);
        },
        [](const HostGl& gl) {
            FX_CALL(POLYGONOFFSET, PolygonOffset)(0, 0);
            FX_CALL(DISABLE, Disable)(GL_POLYGON_OFFSET_FILL);
        });
    add(
        "glCullFace with GL_CULL_FACE",
        [](const HostGl& gl) {
            FX_CALL(CULLFACE, CullFace)(GL_FRONT_AND_BACK);
            FX_CALL(ENABLE, Enable)(GL_CULL_FACE);
        },
        [](const HostGl& gl) {
            FX_CALL(CULLFACE, CullFace)(GL_BACK);
            FX_CALL(DISABLE, Disable)(GL_CULL_FACE);
        });
    add(
        "glFrontFace",
        [](const HostGl& gl) {
            FX_CALL(FRONTFACE, FrontFace)
            (GL_CW);
        },
        [](const HostGl& gl) {
            FX_CALL(FRONTFACE, FrontFace)
            (GL_CCW);
        });
    add(
        "glPointSize",
        [](const HostGl& gl) {
            FX_CALL(POINTSIZE, PointSize)
            (5);
        },
        [](const HostGl& gl) {
            FX_CALL(POINTSIZE, PointSize)
            (1);
        });
    add(
        "glLineWidth",
        [](const HostGl& gl) {
            FX_CALL(LINEWIDTH, LineWidth)
            (1);
        },
        [](const HostGl& gl) {
            FX_CALL(LINEWIDTH, LineWidth)
            (1);
        });
    for (GLuint i = 0; i < 2; ++i) {
        states.push_back({"glViewportIndexedf of " + std::to_string(i),
                          [i](const HostGl& gl) {
                              FX_CALL(VIEWPORTINDEXEDF, ViewportIndexedf)(i, 1.5f, 2.5f, 11.0f, 13.0f);
                          },
                          [i](const HostGl& gl) {
                              FX_CALL(VIEWPORTINDEXEDF, ViewportIndexedf)(i, 0, 0, 64, 64);
                          }});
        states.push_back({"glScissorIndexed of " + std::to_string(i),
                          [i](const HostGl& gl) {
                              FX_CALL(SCISSORINDEXED, ScissorIndexed)(i, 1, 2, 5, 6);
                              FX_CALL(ENABLEI, Enablei)(GL_SCISSOR_TEST, i);
                          },
                          [i](const HostGl& gl) {
                              FX_CALL(SCISSORINDEXED, ScissorIndexed)(i, 0, 0, 64, 64);
                              FX_CALL(DISABLEI, Disablei)(GL_SCISSOR_TEST, i);
                          }});
        states.push_back({"glDepthRangeIndexed of " + std::to_string(i),
                          [i](const HostGl& gl) {
                              FX_CALL(DEPTHRANGEINDEXED, DepthRangeIndexed)
                              (i, 0.75, 0.25);
                          },
                          [i](const HostGl& gl) {
                              FX_CALL(DEPTHRANGEINDEXED, DepthRangeIndexed)
                              (i, 0.0, 1.0);
                          }});
    }
    add(
        "glPrimitiveRestartIndex with GL_PRIMITIVE_RESTART",
        [](const HostGl& gl) {
            FX_CALL(PRIMITIVERESTARTINDEX, PrimitiveRestartIndex)(1);
            FX_CALL(ENABLE, Enable)(GL_PRIMITIVE_RESTART);
        },
        [](const HostGl& gl) {
            FX_CALL(PRIMITIVERESTARTINDEX, PrimitiveRestartIndex)(0);
            FX_CALL(DISABLE, Disable)(GL_PRIMITIVE_RESTART);
        });
    add(
        "glPatchParameteri",
        [](const HostGl& gl) {
            FX_CALL(PATCHPARAMETERI, PatchParameteri)
            (GL_PATCH_VERTICES, 5);
        },
        [](const HostGl& gl) {
            FX_CALL(PATCHPARAMETERI, PatchParameteri)
            (GL_PATCH_VERTICES, 3);
        });
    for (const GLenum what : {GL_LINE_SMOOTH_HINT, GL_POLYGON_SMOOTH_HINT, GL_TEXTURE_COMPRESSION_HINT,
                              GL_FRAGMENT_SHADER_DERIVATIVE_HINT})
        states.push_back({"glHint " + std::to_string(what),
                          [what](const HostGl& gl) {
                              FX_CALL(HINT, Hint)
                              (what, GL_FASTEST);
                          },
                          [what](const HostGl& gl) {
                              FX_CALL(HINT, Hint)
                              (what, GL_DONT_CARE);
                          }});
}

void addFragments(std::vector<HostState>& states)
{
    const auto add = [&](const char* name, auto set, auto reset) { states.push_back({name, set, reset}); };
    for (GLuint i = 0; i < 8; ++i) {
        states.push_back({"blending of draw buffer " + std::to_string(i),
                          [i](const HostGl& gl) {
                              FX_CALL(ENABLEI, Enablei)(GL_BLEND, i);
                              FX_CALL(BLENDEQUATIONSEPARATEI, BlendEquationSeparatei)
                              (i, GL_MAX, GL_FUNC_REVERSE_SUBTRACT);
                              FX_CALL(BLENDFUNCSEPARATEI, BlendFuncSeparatei)
                              (i, GL_DST_COLOR, GL_ZERO, GL_SRC_ALPHA, GL_CONSTANT_ALPHA);
                          },
                          [i](const HostGl& gl) {
                              FX_CALL(DISABLEI, Disablei)(GL_BLEND, i);
                              FX_CALL(BLENDEQUATIONSEPARATEI, BlendEquationSeparatei)
                              (i, GL_FUNC_ADD, GL_FUNC_ADD);
                              FX_CALL(BLENDFUNCSEPARATEI, BlendFuncSeparatei)
                              (i, GL_ONE, GL_ZERO, GL_ONE, GL_ZERO);
                          }});
        states.push_back({"color mask of draw buffer " + std::to_string(i),
                          [i](const HostGl& gl) {
                              FX_CALL(COLORMASKI, ColorMaski)(i, GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
                          },
                          [i](const HostGl& gl) {
                              FX_CALL(COLORMASKI, ColorMaski)(i, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
                          }});
    }
    add(
        "glBlendColor",
        [](const HostGl& gl) {
            FX_CALL(BLENDCOLOR, BlendColor)
            (0.1f, 0.2f, 0.3f, 0.4f);
        },
        [](const HostGl& gl) {
            FX_CALL(BLENDCOLOR, BlendColor)
            (0, 0, 0, 0);
        });
    add(
        "glLogicOp with GL_COLOR_LOGIC_OP",
        [](const HostGl& gl) {
            FX_CALL(LOGICOP, LogicOp)(GL_XOR);
            FX_CALL(ENABLE, Enable)(GL_COLOR_LOGIC_OP);
        },
        [](const HostGl& gl) {
            FX_CALL(LOGICOP, LogicOp)(GL_COPY);
            FX_CALL(DISABLE, Disable)(GL_COLOR_LOGIC_OP);
        });
    add(
        "glDepthFunc with GL_DEPTH_TEST",
        [](const HostGl& gl) {
            FX_CALL(DEPTHFUNC, DepthFunc)(GL_NEVER);
            FX_CALL(ENABLE, Enable)(GL_DEPTH_TEST);
        },
        [](const HostGl& gl) {
            FX_CALL(DEPTHFUNC, DepthFunc)(GL_LESS);
            FX_CALL(DISABLE, Disable)(GL_DEPTH_TEST);
        });
    add(
        "glDepthMask",
        [](const HostGl& gl) {
            FX_CALL(DEPTHMASK, DepthMask)
            (GL_FALSE);
        },
        [](const HostGl& gl) {
            FX_CALL(DEPTHMASK, DepthMask)
            (GL_TRUE);
        });
    add(
        "stencil",
        [](const HostGl& gl) {
            FX_CALL(STENCILFUNC, StencilFunc)(GL_NEVER, 5, 0x3F);
            FX_CALL(STENCILMASK, StencilMask)(0x1F);
            FX_CALL(STENCILOP, StencilOp)(GL_INVERT, GL_INCR, GL_DECR);
            FX_CALL(ENABLE, Enable)(GL_STENCIL_TEST);
        },
        [](const HostGl& gl) {
            FX_CALL(STENCILFUNC, StencilFunc)(GL_ALWAYS, 0, ~0u);
            FX_CALL(STENCILMASK, StencilMask)(~0u);
            FX_CALL(STENCILOP, StencilOp)(GL_KEEP, GL_KEEP, GL_KEEP);
            FX_CALL(DISABLE, Disable)(GL_STENCIL_TEST);
        });
    add(
        "glSampleMaski with GL_SAMPLE_MASK",
        [](const HostGl& gl) {
            FX_CALL(SAMPLEMASKI, SampleMaski)(0, 0);
            FX_CALL(ENABLE, Enable)(GL_SAMPLE_MASK);
        },
        [](const HostGl& gl) {
            FX_CALL(SAMPLEMASKI, SampleMaski)(0, ~0u);
            FX_CALL(DISABLE, Disable)(GL_SAMPLE_MASK);
        });
    add(
        "glSampleCoverage with GL_SAMPLE_COVERAGE",
        [](const HostGl& gl) {
            FX_CALL(SAMPLECOVERAGE, SampleCoverage)(0.0f, GL_FALSE);
            FX_CALL(ENABLE, Enable)(GL_SAMPLE_COVERAGE);
        },
        [](const HostGl& gl) {
            FX_CALL(SAMPLECOVERAGE, SampleCoverage)(1.0f, GL_FALSE);
            FX_CALL(DISABLE, Disable)(GL_SAMPLE_COVERAGE);
        });
    add(
        "glMinSampleShading with GL_SAMPLE_SHADING",
        [](const HostGl& gl) {
            FX_CALL(MINSAMPLESHADING, MinSampleShading)(1.0f);
            FX_CALL(ENABLE, Enable)(GL_SAMPLE_SHADING);
        },
        [](const HostGl& gl) {
            FX_CALL(MINSAMPLESHADING, MinSampleShading)(0.0f);
            FX_CALL(DISABLE, Disable)(GL_SAMPLE_SHADING);
        });
    add(
        "clear values",
        [](const HostGl& gl) {
            FX_CALL(CLEARCOLOR, ClearColor)(0.5f, 0.25f, 0.75f, 0.125f);
            FX_CALL(CLEARDEPTH, ClearDepth)(0.25);
            FX_CALL(CLEARSTENCIL, ClearStencil)(3);
        },
        [](const HostGl& gl) {
            FX_CALL(CLEARCOLOR, ClearColor)(0, 0, 0, 0);
            FX_CALL(CLEARDEPTH, ClearDepth)(1.0);
            FX_CALL(CLEARSTENCIL, ClearStencil)(0);
        });
    add(
        "glClampColor",
        [](const HostGl& gl) {
            FX_CALL(CLAMPCOLOR, ClampColor)
            (GL_CLAMP_READ_COLOR, GL_TRUE);
        },
        [](const HostGl& gl) {
            FX_CALL(CLAMPCOLOR, ClampColor)
            (GL_CLAMP_READ_COLOR, GL_FIXED_ONLY);
        });
}

void addTransfers(std::vector<HostState>& states)
{
    for (const GLenum what :
         {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_IMAGE_HEIGHT,
          GL_PACK_SKIP_IMAGES, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
          GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES})
        states.push_back({"glPixelStorei " + std::to_string(what),
                          [what](const HostGl& gl) {
                              FX_CALL(PIXELSTOREI, PixelStorei)
                              (what, 7);
                          },
                          [what](const HostGl& gl) {
                              FX_CALL(PIXELSTOREI, PixelStorei)
                              (what, 0);
                          }});
    for (const GLenum what :
         {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
        states.push_back({"glPixelStorei " + std::to_string(what),
                          [what](const HostGl& gl) {
                              FX_CALL(PIXELSTOREI, PixelStorei)
                              (what, GL_TRUE);
                          },
                          [what](const HostGl& gl) {
                              FX_CALL(PIXELSTOREI, PixelStorei)
                              (what, GL_FALSE);
                          }});
    for (const GLenum what : {GL_PACK_ALIGNMENT, GL_UNPACK_ALIGNMENT})
        states.push_back({"glPixelStorei " + std::to_string(what),
                          [what](const HostGl& gl) {
                              FX_CALL(PIXELSTOREI, PixelStorei)
                              (what, 8);
                          },
                          [what](const HostGl& gl) {
                              FX_CALL(PIXELSTOREI, PixelStorei)
                              (what, 4);
                          }});
}

/// All state of a context that is no object and no binding of one (those are GlHost's).
std::vector<HostState> hostStates()
{
    std::vector<HostState> states;
    addSwitches(states);
    addRaster(states);
    addFragments(states);
    addTransfers(states);
    return states;
}

/// Everything that is drawn in a way of its own: media, sprites with textures, ribbons, meshes, solid ones.
constexpr const char* kEverything = R"({"version": 1, "name": "everything", "ground": false, "emitters": [
    {"layer": "smoke", "shape": "sphere", "size": 0.7, "emission": {"rate": 40}, "lifetime": 1, "radius": 0.3,
     "temperature": 900, "heat": 1, "detailAmount": 0.5, "forces": {"gravity": 0}},
    {"shape": "sphere", "size": 0.7, "speed": 1, "emission": {"rate": 60}, "lifetime": 1, "radius": 0.2,
     "forces": {"gravity": 0}, "appearance": {"kind": "sprite", "texture": "library:spark.png"}},
    {"shape": "sphere", "size": 0.5, "speed": 1, "emission": {"rate": 20}, "lifetime": 1, "radius": 0.05,
     "trail": {"lifetime": 0.7, "width": 0.1, "texture": "library:streak.png"},
     "appearance": {"kind": "sprite"}},
    {"shape": "sphere", "size": 0.9, "speed": 1, "emission": {"rate": 20}, "lifetime": 1, "radius": 0.15,
     "forces": {"gravity": 0}, "appearance": {"kind": "mesh", "mesh": "library:debris-chunk.obj"}},
    {"shape": "sphere", "size": 0.9, "speed": 1, "emission": {"rate": 20}, "lifetime": 1, "radius": 0.15,
     "forces": {"gravity": 0}, "appearance": {"kind": "mesh", "mesh": "library:debris-slab.obj",
     "blend": "opaque", "angleDegrees": {"min": 0, "max": 360}}}]})";

class ViewHostState : public fx::test::ViewApiTest
{
protected:
    ViewHostState() : gl{gl_->loader()} {}

    /// A view that has drawn nothing yet draws the scene.
    std::vector<float> draw()
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.activationOverlay = 1;
        settings.layerScale = 0.5f;
        FxView* view = nullptr;
        EXPECT_EQ(fxCreateView(context_, scene_, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        const FxFrameDef def = frame();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        return read();
    }
    /// The picture, read under GL's own states, and a new one.
    std::vector<float> read()
    {
        std::vector<float> texels = picture();
        fillPicture();
        return texels;
    }

    HostGl gl;
};

} // namespace

TEST_F(ViewHostState, changesNeitherThePictureNorIsItChanged)
{
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = loadText(context_, kEverything);
    FxInstanceId id{};
    ASSERT_EQ(fxScene_CreateInstance(scene_, &instance, &id), FX_OK) << fxGetLastErrorMessage();
    update(60);
    const std::vector<float> wanted = draw();
    ASSERT_EQ(draw(), wanted);
    GlHost probe(gl_->loader());
    for (const HostState& state : hostStates()) {
        SCOPED_TRACE(state.name);
        state.set(gl);
        ASSERT_EQ(host_->gl.GetError(), GLenum(GL_NO_ERROR)) << "the host itself is wrong";
        const GlProbe before = probe.probe();
        const std::vector<float> texels = draw();
        EXPECT_EQ(differences(before, probe.probe()), std::vector<std::string>());
        state.reset(gl);
        EXPECT_TRUE(texels == wanted) << "the picture is another";
    }
}

TEST_F(ViewHostState, changesNothingAlsoWhereAllOfItIsUnusual)
{
    update(60);
    const std::vector<float> wanted = draw();
    GlHost host(gl_->loader());
    host.makeHostile();
    // Clip control is the frame's business, see FxFrameDef.
    FX_CALL(CLIPCONTROL, ClipControl)(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    const GlProbe before = host.probe();
    EXPECT_TRUE(draw() == wanted);
    EXPECT_EQ(differences(before, host.probe()), std::vector<std::string>());
    host.release();
}
