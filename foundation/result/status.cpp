#include "foundation/result/status.h"

namespace fx::base {

const char* codeName(Code code)
{
    switch (code) {
    case Code::Ok:
        return "ok";
    case Code::InvalidArgument:
        return "invalid-argument";
    case Code::StaleId:
        return "stale-id";
    case Code::WrongThread:
        return "wrong-thread";
    case Code::OutOfMemory:
        return "out-of-memory";
    case Code::Capacity:
        return "capacity";
    case Code::NotFound:
        return "not-found";
    case Code::TooLarge:
        return "too-large";
    case Code::Parse:
        return "parse";
    case Code::Schema:
        return "schema";
    case Code::Version:
        return "version";
    case Code::GlUnsupported:
        return "gl-unsupported";
    case Code::GlFailed:
        return "gl-failed";
    case Code::NoGl:
        return "no-gl";
    case Code::ReEntrant:
        return "re-entrant";
    case Code::Io:
        return "io";
    case Code::Interrupted:
        return "interrupted";
    case Code::HostAnswer:
        return "host-answer";
    case Code::GlLost:
        return "gl-lost";
    case Code::Internal:
        return "internal";
    }
    return "unknown";
}

} // namespace fx::base
