/* host_glfw_c [--headless FILE.png] [--frames N] [--size WxH]
 *
 * A GLFW window in C99. The scene is drawn into GL_RGBA16F with a depth texture of 24 bits; effects come over
 * it; a curve of the host makes the picture for the window. Shows: a loader of functions by GLFW, a camera,
 * depth from near to far, where in the frame fxView_Render() stands. */
#include "host_effects.h"
#include "host_options.h"
#include "host_report.h"
#include "host_scene.h"
#include "host_window.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <stdio.h>
#include <string.h>

static const char* const kSurface = "in vec3 normal;\n"
                                    "in vec3 albedo;\n"
                                    "out vec4 color;\n"
                                    "void main() { color = vec4(hostShade(albedo, normal), 1.0); }\n";
static const char* const kDisplay =
    "layout(binding = 0) uniform sampler2D light;\n"
    "out vec4 color;\n"
    "void main() { color = vec4(hostToneMap(texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }\n";

typedef struct Game
{
    HostEffects effects;
    int width, height;
    GLuint color, depth, sceneFramebuffer;    /* GL_RGBA16F, GL_DEPTH_COMPONENT24 */
    GLuint displayBuffer, displayFramebuffer; /* GL_RGBA8, what the window shows */
    GLuint surfaceProgram, displayProgram, mesh, noVertices;
    int vertexCount;
} Game;

/* GLFW's function has no argument for the user, and returns a pointer to a function. */
static void* findFunction(void* user, const char* name)
{
    const GLFWglproc function = glfwGetProcAddress(name);
    void* address;
    (void)user;
    memcpy(&address, &function, sizeof address);
    return address;
}

/* The framebuffer of a window has more pixels than the window is large on displays that scale. */
static GLFWwindow* openWindow(HostOptions* ioOptions)
{
    GLFWwindow* window = NULL;
    if (glfwInit()) {
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_RESIZABLE, GLFW_FALSE);
        window = glfwCreateWindow(ioOptions->width, ioOptions->height, "fxsdk: GLFW", NULL, NULL);
    }
    if (!window) {
        fprintf(stderr, "no window with OpenGL 4.5; use --headless FILE.png\n");
        return NULL;
    }
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1); /* one frame for each refresh of the display */
    glfwGetFramebufferSize(window, &ioOptions->width, &ioOptions->height);
    return window;
}

static int makeTargets(Game* game)
{
    glCreateTextures(GL_TEXTURE_2D, 1, &game->color);
    glTextureStorage2D(game->color, 1, GL_RGBA16F, game->width, game->height);
    glCreateTextures(GL_TEXTURE_2D, 1, &game->depth);
    glTextureStorage2D(game->depth, 1, GL_DEPTH_COMPONENT24, game->width, game->height);
    glCreateFramebuffers(1, &game->sceneFramebuffer);
    glNamedFramebufferTexture(game->sceneFramebuffer, GL_COLOR_ATTACHMENT0, game->color, 0);
    glNamedFramebufferTexture(game->sceneFramebuffer, GL_DEPTH_ATTACHMENT, game->depth, 0);
    glCreateRenderbuffers(1, &game->displayBuffer);
    glNamedRenderbufferStorage(game->displayBuffer, GL_RGBA8, game->width, game->height);
    glCreateFramebuffers(1, &game->displayFramebuffer);
    glNamedFramebufferRenderbuffer(game->displayFramebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   game->displayBuffer);
    game->surfaceProgram = hostMakeProgram(kHostVertexGlsl, kHostShadeGlsl, kSurface);
    game->displayProgram = hostMakeProgram(kHostFullScreenGlsl, kHostToneMapGlsl, kDisplay);
    game->mesh = hostMakeMesh(&game->vertexCount);
    glCreateVertexArrays(1, &game->noVertices);
    return game->surfaceProgram && game->displayProgram;
}

static void drawScene(const Game* game, const float view[16], const float projection[16])
{
    const float sky[4] = {kHostSky[0], kHostSky[1], kHostSky[2], 1.0f}, farthest = 1.0f;
    float camera[16];
    hostMultiply(projection, view, camera);
    glBindFramebuffer(GL_FRAMEBUFFER, game->sceneFramebuffer);
    glViewport(0, 0, game->width, game->height);
    glDepthMask(GL_TRUE);
    glClearBufferfv(GL_COLOR, 0, sky);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glUseProgram(game->surfaceProgram);
    glUniformMatrix4fv(0, 1, GL_FALSE, camera);
    glBindVertexArray(game->mesh);
    glDrawArrays(GL_TRIANGLES, 0, game->vertexCount);
}

/* The effects over the opaque scene. OpenGL is afterwards as before. */
static int drawEffects(const Game* game, const float view[16], const float projection[16])
{
    FxFrameDef frame = fxDefaultFrameDef();
    FxResult result;
    memcpy(frame.view, view, sizeof frame.view);
    memcpy(frame.projection, projection, sizeof frame.projection);
    frame.colorTexture = game->color;
    frame.depthTexture = game->depth;
    frame.width = game->width;
    frame.height = game->height;
    hostBeforeEffects(); /* measures; a game leaves this out */
    result = fxView_Render(game->effects.view, &frame);
    hostAfterEffects(&frame);
    return result == FX_OK;
}

static void toneMap(const Game* game)
{
    glBindFramebuffer(GL_FRAMEBUFFER, game->displayFramebuffer);
    glDisable(GL_DEPTH_TEST);
    glUseProgram(game->displayProgram);
    glBindTextureUnit(0, game->color);
    glBindVertexArray(game->noVertices);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

static int draw(void* host, int withEffects)
{
    const Game* game = host;
    float view[16], projection[16];
    hostCamera((float)game->width / (float)game->height, 0, view, projection);
    drawScene(game, view, projection);
    if (withEffects && !drawEffects(game, view, projection))
        return 0;
    toneMap(game);
    return 1;
}

static int play(Game* game, const HostOptions* options, GLFWwindow* window)
{
    for (int frame = 0; hostPlays(options, frame) && !(window && glfwWindowShouldClose(window)); ++frame) {
        if (fxScene_Update(game->effects.scene, hostStep(options)) != FX_OK)
            return 0;
        if (hostDraws(options, frame) && !draw(game, 1))
            return 0;
        if (window) {
            glBlitNamedFramebuffer(game->displayFramebuffer, 0, 0, 0, game->width, game->height, 0, 0,
                                   game->width, game->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
            glfwSwapBuffers(window);
            glfwPollEvents();
        }
    }
    return 1;
}

static int run(const HostOptions* options, GLFWwindow* window)
{
    Game game;
    FxGlLoader loader = {NULL,
                         window ? findFunction : fxGetGlProcAddress}; /* without a window: that of EGL */
    const FxGlLoader counted = hostCountCalls(&loader);               /* measures; a game passes its loader */
    const FxViewSettings settings = hostLight();
    HostReport report = {
        "glfw_c", "GL_RGBA16F, linear", "GL_DEPTH_COMPONENT24, near to far", 1, draw, NULL, 0, 0, 0};
    int isRight;
    memset(&game, 0, sizeof game);
    game.width = options->width;
    game.height = options->height;
    isRight = makeTargets(&game) && hostOpenEffects(&game.effects, &counted, &settings) &&
              play(&game, options, window);
    if (!isRight)
        fprintf(stderr, "glfw_c: %s\n", fxGetLastErrorMessage());
    report.host = &game;
    report.targetFramebuffer = game.sceneFramebuffer;
    report.displayFramebuffer = game.displayFramebuffer;
    isRight = isRight && (!options->output || hostReport(&report, options, &game.effects));
    hostCloseEffects(&game.effects);
    return isRight;
}

int main(int argumentCount, char** arguments)
{
    HostOptions options;
    GLFWwindow* window = NULL;
    int isRight = 0;
    if (!hostParse(argumentCount, arguments, &options))
        return 2;
    if (options.output ? hostOpenOffscreen() : (window = openWindow(&options)) != NULL)
        isRight = run(&options, window);
    if (options.output)
        hostCloseOffscreen();
    else
        glfwTerminate();
    return isRight ? 0 : 1;
}
