#include "gl_counts.h"

#include <epoxy/gl.h>

#include <cstring>
#include <map>

namespace host {

namespace {

GlCounts current;
FxGlLoader loader;
std::vector<std::string> uncounted;

struct Function
{
    void* counted;
    void** real;
};

/// The function that stands for the one at index `Index` of the list.
template <int Index, class F>
struct Counted;
template <int Index, class R, class... A>
struct Counted<Index, R(GLAPIENTRY*)(A...)>
{
    static inline void* real = nullptr;
    static inline bool isQuery = false;
    static R GLAPIENTRY call(A... arguments)
    {
        ++current.calls;
        current.queries += isQuery ? 1 : 0;
        return reinterpret_cast<R(GLAPIENTRY*)(A...)>(real)(arguments...);
    }
};

template <int Index, class F>
Function functionOf(const char* name)
{
    Counted<Index, F>::isQuery =
        (std::strncmp(name, "glGet", 5) == 0 && std::strcmp(name, "glGetGraphicsResetStatus") != 0) ||
        std::strncmp(name, "glIs", 4) == 0;
    return {reinterpret_cast<void*>(&Counted<Index, F>::call), &Counted<Index, F>::real};
}

/// All functions that the headers of epoxy declare, apart from extensions (host_functions.inl is made from
/// them by CMakeLists.txt).
const std::map<std::string, Function>& functions()
{
    static const std::map<std::string, Function> kFunctions = {
#define HOST_GL(name) {"gl" #name, functionOf<__COUNTER__, decltype(epoxy_gl##name)>("gl" #name)},
#include "host_functions.inl"
#undef HOST_GL
    };
    return kFunctions;
}

void* find(void*, const char* name)
{
    void* const real = loader.getProcAddress(loader.user, name);
    const auto found = functions().find(name);
    if (!real)
        return nullptr;
    if (found == functions().end()) {
        uncounted.push_back(name);
        return real;
    }
    *found->second.real = real;
    return found->second.counted;
}

} // namespace

FxGlLoader countedLoader(const FxGlLoader& real)
{
    loader = real;
    return {nullptr, &find};
}

GlCounts counts()
{
    return current;
}

void resetCounts()
{
    current = {};
}

const std::vector<std::string>& uncountedFunctions()
{
    return uncounted;
}

} // namespace host
