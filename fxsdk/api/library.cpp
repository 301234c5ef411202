// The shared library is fx_api and what it stands on, linked whole; this file only gives it a source of its
// own.
#include "fxsdk/fxsdk.h"

static_assert(sizeof(FxInstanceId) == 8, "ids are passed in one register");
