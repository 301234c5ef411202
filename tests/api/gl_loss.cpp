#include "tests/api/gl_loss.h"

#include <map>

namespace fx::test {

namespace {

GlLoss* losing = nullptr;

struct Function
{
    void* replacement;
    void** real;
};

} // namespace

struct LosingGl
{
    static bool loses(const char* name) { return losing->loses(name); }
    static bool reportsReset() { return losing->reportsReset_; }

    /// The replacement of one function. `Name` differs for each.
    template <class Name, class F>
    struct Replaced;
    template <class Name, class R, class... A>
    struct Replaced<Name, R(APIENTRY*)(A...)>
    {
        static inline void* real = nullptr;
        static R APIENTRY call(A... arguments)
        {
            if (loses(Name::text()))
                return lost<R>(Name::text());
            return reinterpret_cast<R(APIENTRY*)(A...)>(real)(arguments...);
        }
    };

    template <class R>
    static R lost(const char* name)
    {
        if constexpr (std::is_same_v<R, GLenum>) {
            if (std::string(name) == "glGetError")
                return GL_CONTEXT_LOST;
            if (std::string(name) == "glGetGraphicsResetStatus")
                return GL_UNKNOWN_CONTEXT_RESET;
        }
        return R();
    }

    static void APIENTRY getInteger(GLenum what, GLint* out)
    {
        if (loses("glGetIntegerv"))
            return;
        reinterpret_cast<PFNGLGETINTEGERVPROC>(realGetInteger)(what, out);
        if (what == GL_RESET_NOTIFICATION_STRATEGY)
            *out = reportsReset() ? GL_LOSE_CONTEXT_ON_RESET : GL_NO_RESET_NOTIFICATION;
    }
    static inline void* realGetInteger = nullptr;

    static const std::map<std::string, Function>& functions()
    {
#define FX_GL(type, name)                                                                                    \
    struct Name##name                                                                                        \
    {                                                                                                        \
        static const char* text() { return "gl" #name; }                                                     \
    };
#include "rendering/gl/gl_functions.inl"
#undef FX_GL
        static const std::map<std::string, Function> kFunctions = [] {
            std::map<std::string, Function> all;
#define FX_GL(type, name)                                                                                    \
    all["gl" #name] = {reinterpret_cast<void*>(&Replaced<Name##name, PFNGL##type##PROC>::call),              \
                       &Replaced<Name##name, PFNGL##type##PROC>::real};
#include "rendering/gl/gl_functions.inl"
#undef FX_GL
            all["glGetIntegerv"] = {reinterpret_cast<void*>(&getInteger), &realGetInteger};
            return all;
        }();
        return kFunctions;
    }
};

GlLoss::GlLoss(const render::GlLoader& real) : real_(real)
{
    losing = this;
}

GlLoss::~GlLoss()
{
    losing = nullptr;
}

void GlLoss::loseAt(uint64_t n)
{
    losing_ = n;
    calls_ = polls_ = 0;
    isLost_ = false;
    lostIn_.clear();
}

bool GlLoss::loses(const char* name)
{
    polls_ += std::string(name) == "glGetGraphicsResetStatus" ? 1 : 0;
    if (++calls_ == losing_) {
        isLost_ = true;
        lostIn_ = name;
    }
    return isLost_;
}

void* GlLoss::find(void* user, const char* name)
{
    const GlLoss& self = *static_cast<GlLoss*>(user);
    void* const real = self.real_.getProcAddress(self.real_.user, name);
    const auto found = LosingGl::functions().find(name);
    if (found == LosingGl::functions().end())
        return real;
    *found->second.real = real;
    return found->second.replacement;
}

} // namespace fx::test
