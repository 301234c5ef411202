// A game of its own that opens the effect editor inside of itself: its context of OpenGL, its ImGui, its
// frames.
#include "fxsdk/editor/embed/game_editor.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr int kWidth = 1280, kHeight = 800; // [pixel]

void* findFunction(void*, const char* name)
{
    return reinterpret_cast<void*>(eglGetProcAddress(name));
}

bool startGl()
{
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
        return false;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    return context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 3 || !startGl())
        return 2;
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
        return 3;
    std::string error;
    const auto editor = fx::editor::GameEditor::open(argv[1], argv[2], findFunction, nullptr, error);
    if (!editor)
        return std::fprintf(stderr, "%s\n", error.c_str()), 4;
    GLuint texture = 0, framebuffer = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, kWidth, kHeight);
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    const auto frame = [&](auto&& draw) {
        ImGui::GetIO().DisplaySize = {float(kWidth), float(kHeight)};
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        draw();
        ImGui::Render();
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        const float black[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, black);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    };
    editor->scrub(2.0);
    for (int i = 0; i < 4; ++i)
        frame([&] {
            ImGui::GetBackgroundDrawList()->AddText({8.0f, 8.0f}, IM_COL32_WHITE, "the game");
            ImGui::SetNextWindowPos({0.0f, 0.0f}); // a window of the game with the name of a panel
            ImGui::SetNextWindowSize({70.0f, 50.0f});
            ImGui::Begin("Inspector");
            ImGui::End();
            editor->draw(1.0 / 60.0, 80.0f, 60.0f, 1200.0f, 740.0f); // the game shows in the rest
        });
    std::vector<unsigned char> pixels(size_t(kWidth) * kHeight * 4);
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(pixels.size()), pixels.data());
    // Rows begin at the bottom. The margin of the game stays black; bright fire is in the picture of the
    // editor, whose inspector is in its right third.
    size_t margin = 0, bright = 0, inspector = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const unsigned char* p = &pixels[(size_t(y) * kWidth + size_t(x)) * 4];
            margin += x < 80 && y < kHeight - 60 && p[0] + p[1] + p[2] > 0 ? 1 : 0;
            inspector += x > 1000 && x < 1270 && y > 20 && y < 600 && p[0] + p[1] + p[2] > 0 ? 1 : 0;
            bright += p[0] > 240 && p[1] > 170 && p[2] < 170 ? 1 : 0;
        }
    std::printf(
        "%u particles, %zu bright pixels, %zu pixels of the margin, %zu pixels of the inspector, error %u\n",
        editor->particles(), bright, margin, inspector, glGetError());
    const bool isDrawn = editor->particles() > 50 && bright > 200 && margin == 0 && inspector > 100000;

    // Two editors side by side: each has its own document, time and picture.
    const unsigned particles = editor->particles();
    const auto second = fx::editor::GameEditor::open("library:sparks", argv[2], findFunction, nullptr, error);
    if (!second)
        return std::fprintf(stderr, "%s\n", error.c_str()), 5;
    second->scrub(1.0);
    for (int i = 0; i < 4; ++i)
        frame([&] {
            editor->draw(1.0 / 60.0, 0.0f, 0.0f, 640.0f, float(kHeight));
            second->draw(1.0 / 60.0, 640.0f, 0.0f, 640.0f, float(kHeight));
        });
    glGetTextureImage(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(pixels.size()), pixels.data());
    size_t halves[2] = {};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const unsigned char* p = &pixels[(size_t(y) * kWidth + size_t(x)) * 4];
            halves[x / 640] += p[0] + p[1] + p[2] > 0 ? 1 : 0;
        }
    std::printf("two editors: %u and %u particles, %zu and %zu pixels, error %u\n", editor->particles(),
                second->particles(), halves[0], halves[1], glGetError());
    const bool areTwo = editor->particles() == particles && second->particles() > 50 &&
                        second->text() != editor->text() && halves[0] > 400000 && halves[1] > 400000;
    second->close();
    editor->close();
    return isDrawn && areTwo && !editor->isDirty() && !editor->text().empty() ? 0 : 6;
}
