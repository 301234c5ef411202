// The functions of fx_base.h.
#include "fxsdk/api/guarded.h"

// One list of codes in two languages: they must agree number for number.
#define FX_SAME_CODE(c, cpp) static_assert(int(c) == int(fx::base::Code::cpp), #c)
FX_SAME_CODE(FX_OK, Ok);
FX_SAME_CODE(FX_ERROR_INVALID_ARGUMENT, InvalidArgument);
FX_SAME_CODE(FX_ERROR_STALE_ID, StaleId);
FX_SAME_CODE(FX_ERROR_WRONG_THREAD, WrongThread);
FX_SAME_CODE(FX_ERROR_OUT_OF_MEMORY, OutOfMemory);
FX_SAME_CODE(FX_ERROR_CAPACITY, Capacity);
FX_SAME_CODE(FX_ERROR_NOT_FOUND, NotFound);
FX_SAME_CODE(FX_ERROR_TOO_LARGE, TooLarge);
FX_SAME_CODE(FX_ERROR_PARSE, Parse);
FX_SAME_CODE(FX_ERROR_SCHEMA, Schema);
FX_SAME_CODE(FX_ERROR_VERSION, Version);
FX_SAME_CODE(FX_ERROR_GL_UNSUPPORTED, GlUnsupported);
FX_SAME_CODE(FX_ERROR_GL_FAILED, GlFailed);
FX_SAME_CODE(FX_ERROR_NO_GL, NoGl);
FX_SAME_CODE(FX_ERROR_RE_ENTRANT, ReEntrant);
FX_SAME_CODE(FX_ERROR_IO, Io);
FX_SAME_CODE(FX_ERROR_INTERRUPTED, Interrupted);
FX_SAME_CODE(FX_ERROR_HOST_ANSWER, HostAnswer);
FX_SAME_CODE(FX_ERROR_GL_LOST, GlLost);
FX_SAME_CODE(FX_ERROR_INTERNAL, Internal);
#undef FX_SAME_CODE

uint32_t fxGetVersion(void)
{
    return FX_VERSION;
}

const char* fxResultName(FxResult result)
{
    return fx::base::codeName(fx::base::Code(int(result)));
}

const char* fxGetLastErrorMessage(void)
{
    return fx::api::lastError();
}
