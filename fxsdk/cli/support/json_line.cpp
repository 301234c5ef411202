#include "fxsdk/cli/support/json_line.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

namespace fx::cli {

nlohmann::json withMachine(nlohmann::json object, const Machine& machine)
{
    object["version"] = FXSDK_VERSION;
    object["machine"] = toJson(machine);
    return object;
}

void printJsonLine(const nlohmann::json& object)
{
    const std::string text = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::printf("%s\n", text.c_str());
}

base::Status finishStandardOutput()
{
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
        return {};
    return {base::Code::Io, std::string("cannot write to standard output: ") + std::strerror(errno)};
}

} // namespace fx::cli
