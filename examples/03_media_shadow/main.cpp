// 03_media_shadow PRESET SECONDS OUTPUT.png
//
// A game's ground in the sun, darkened by the smoke above it. Shows: fxView_PrepareLights() before the level
// is drawn, fxView_GetMediaShadow(), its uniform block and its GLSL, fxView_Render() over the level.
#include "fxsdk/fxsdk.h"
#include "offscreen_gl.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kStep = 1.0 / 60.0; // [s]

constexpr const char* kVertex = R"(#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
)";

/// The ground 2 m below the frame's origin, and the sky. The text of fxGetMediaShadowGlsl() stands before it.
constexpr const char* kFragment = R"(
layout(std140, binding = 0) uniform Shadow { FxMediaShadow shadow; };
layout(binding = 0) uniform sampler2D planes;
layout(location = 0) out vec4 color;
void main()
{
    vec2 ndc = gl_FragCoord.xy / vec2(640.0, 480.0) * 2.0 - 1.0;
    vec3 d = vec3(ndc.x * 640.0 / 960.0, ndc.y * 0.5, -1.0);
    color = vec4(0.3, 0.38, 0.5, 1.0); // exposed values
    gl_FragDepth = 1.0;
    if (d.y >= -1e-3)
        return;
    float distanceAlongAxis = -2.0 / d.y;
    vec3 place = distanceAlongAxis * d; // relative to the frame's origin
    vec3 sun = vec3(0.35) * fxMediaTransmittance(planes, shadow, place);
    color.rgb = vec3(0.08) + sun;
    gl_FragDepth = 1.0 - 0.1 / distanceAlongAxis;
}
)";

void check(FxResult result)
{
    if (result != FX_OK)
        throw std::runtime_error(fxGetLastErrorMessage());
}

void attach(GLuint program, GLenum kind, const std::string& text)
{
    const GLuint shader = glCreateShader(kind);
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
}

/// What a game has of its own: a level, here the ground, and what it needs to draw it.
class Level
{
public:
    explicit Level(const example::Picture& picture)
    {
        program_ = glCreateProgram();
        attach(program_, GL_VERTEX_SHADER, kVertex);
        attach(program_, GL_FRAGMENT_SHADER,
               std::string("#version 450 core\n") + fxGetMediaShadowGlsl() + kFragment);
        glLinkProgram(program_);
        GLint linked = 0;
        glGetProgramiv(program_, GL_LINK_STATUS, &linked);
        if (!linked)
            throw std::runtime_error("the level's program does not link");
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, picture.color(), 0);
        glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, picture.depth(), 0);
        glCreateVertexArrays(1, &vertices_);
        glCreateBuffers(1, &shadow_);
        glNamedBufferData(shadow_, GLsizeiptr(sizeof(FxMediaShadow) - offsetof(FxMediaShadow, right)),
                          nullptr, GL_DYNAMIC_DRAW);
    }

    void draw(const FxMediaShadow& shadow) const
    {
        constexpr size_t kBegin = offsetof(FxMediaShadow, right);
        glNamedBufferSubData(shadow_, 0, GLsizeiptr(sizeof shadow - kBegin),
                             reinterpret_cast<const char*>(&shadow) + kBegin);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, shadow_);
        glBindTextureUnit(0, shadow.texture); // 0: all light passes, and nothing is read
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, kWidth, kHeight);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_ALWAYS);
        glUseProgram(program_);
        glBindVertexArray(vertices_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

private:
    GLuint program_ = 0, framebuffer_ = 0, vertices_ = 0, shadow_ = 0;
};

FxPresetId load(FxContext* context, const std::string& preset)
{
    FxPresetId id;
    check(preset.ends_with(".json") ? fxLoadPresetFile(context, preset.c_str(), &id)
                                    : fxLoadPresetLibrary(context, preset.c_str(), &id));
    return id;
}

FxViewSettings afternoon()
{
    FxViewSettings settings = fxDefaultViewSettings();
    for (float& illuminance : settings.sunIlluminance)
        illuminance = 60000.0f;
    for (float& luminance : settings.skyLuminance)
        luminance = 4000.0f;
    settings.toneMap = 1;
    return settings;
}

/// From 12 m away and 2 m up; the frame's origin is the eye.
FxFrameDef camera(FxContext* context, const example::Picture& picture)
{
    FxFrameDef frame = fxDefaultFrameDef();
    frame.colorTexture = picture.color();
    frame.depthTexture = picture.depth();
    frame.width = kWidth;
    frame.height = kHeight;
    const double eye[3] = {0.0, 2.0, 12.0}, target[3] = {0.0, 2.0, 0.0};
    check(fxSetFrameCamera(context, eye, target, 0.93f, 0.1f, &frame));
    return frame;
}

void run(const std::string& preset, double seconds, const std::string& output)
{
    const example::OffscreenGl gl;
    example::Picture picture(kWidth, kHeight);
    const Level level(picture);

    FxContextDef contextDef = fxDefaultContextDef();
    contextDef.gl.getProcAddress = example::findOffscreenFunction;
    FxContext* context = nullptr;
    check(fxCreateContext(&contextDef, &context));
    const FxSceneDef sceneDef = fxDefaultSceneDef();
    FxScene* scene = nullptr;
    check(fxCreateScene(context, &sceneDef, &scene));
    FxInstanceDef instance = fxDefaultInstanceDef();
    instance.preset = load(context, preset);
    FxInstanceId id;
    check(fxScene_CreateInstance(scene, &instance, &id));
    const FxViewSettings settings = afternoon();
    FxView* view = nullptr;
    check(fxCreateView(context, scene, &settings, &view));
    for (double time = 0.0; time < seconds; time += kStep)
        check(fxScene_Update(scene, kStep));

    const FxFrameDef frame = camera(context, picture);
    check(fxView_PrepareLights(view, &frame));
    FxMediaShadow shadow = {};
    shadow.structSize = sizeof shadow;
    check(fxView_GetMediaShadow(view, FX_LIGHT_SUN, 0, &shadow));
    level.draw(shadow);
    check(fxView_Render(view, &frame));
    picture.writePng(output);
    check(fxDestroyContext(context));
}

} // namespace

int main(int argumentCount, char** arguments)
{
    if (argumentCount != 4) {
        std::fprintf(stderr, "usage: 03_media_shadow PRESET SECONDS OUTPUT.png\n");
        return 2;
    }
    try {
        run(arguments[1], std::strtod(arguments[2], nullptr), arguments[3]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "03_media_shadow: %s\n", error.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
