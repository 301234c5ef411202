#include "fxsdk/api/gl_loader.h"

#include "fxsdk/fx_context.h"

#include <dlfcn.h>

namespace {

/// A library that makes contexts current and finds the functions of OpenGL.
struct WindowSystem
{
    const char* library;
    const char* currentContext;
    const char* getProcAddress;
};

// The libraries that a program may use through another one stand first.
constexpr WindowSystem kWindowSystems[] = {
    {"libEGL.so.1", "eglGetCurrentContext", "eglGetProcAddress"},
    {"libGLX.so.0", "glXGetCurrentContext", "glXGetProcAddressARB"},
    {"libGL.so.1", "glXGetCurrentContext", "glXGetProcAddressARB"},
    {"libSDL2-2.0.so.0", "SDL_GL_GetCurrentContext", "SDL_GL_GetProcAddress"},
    {"libSDL3.so.0", "SDL_GL_GetCurrentContext", "SDL_GL_GetProcAddress"},
};

/// Only of libraries that the host has loaded, linked or not.
void* symbolOf(const char* library, const char* name)
{
    if (void* linked = dlsym(RTLD_DEFAULT, name))
        return linked;
    void* handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
    if (!handle)
        return nullptr;
    void* found = dlsym(handle, name);
    dlclose(handle); // the host's own handle keeps it
    return found;
}

/// The window system whose context is current on this thread; null: none.
const WindowSystem* currentSystem()
{
    for (const WindowSystem& system : kWindowSystems) {
        const auto current = reinterpret_cast<void* (*)()>(symbolOf(system.library, system.currentContext));
        if (current && current())
            return &system;
    }
    return nullptr;
}

} // namespace

bool fx::api::isGlContextCurrent()
{
    return currentSystem() != nullptr;
}

void* fxGetGlProcAddress(void*, const char* name)
{
    const WindowSystem* system = name ? currentSystem() : nullptr;
    if (!system)
        return nullptr;
    const auto find =
        reinterpret_cast<void* (*)(const char*)>(symbolOf(system->library, system->getProcAddress));
    return find ? find(name) : nullptr;
}
