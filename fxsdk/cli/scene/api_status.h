/// @file api_status.h
/// Converts results of the C API to statuses.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/fxsdk.h"

namespace fx::cli {

/// Converts the result of a call and its error message to a status. FxResult and base::Code have the same
/// numbers.
inline base::Status toStatus(FxResult result)
{
    if (result == FX_OK)
        return {};
    return {static_cast<base::Code>(result), fxGetLastErrorMessage()};
}

} // namespace fx::cli
