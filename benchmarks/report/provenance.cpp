#include "benchmarks/report/provenance.h"

#include "embedded/fxsdk_commit.h"

namespace fx::cli {

const char* commitName()
{
    return kFxsdkCommit;
}

std::string provenance(const std::string& machine)
{
    return std::string("fx " FXSDK_VERSION " at ") + kFxsdkCommit + " on " + machine;
}

} // namespace fx::cli
