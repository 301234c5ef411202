/// @file api_status.h
/// Results of the C API as statuses.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/fxsdk.h"

namespace fx::cli {

/// The result of a call together with the message it left. Codes are the same numbers on both sides.
inline base::Status toStatus(FxResult result)
{
    if (result == FX_OK)
        return {};
    return {static_cast<base::Code>(result), fxGetLastErrorMessage()};
}

} // namespace fx::cli
